// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/rain.h>
#include <scree/input/input_error.h>
#include <scree/particles/cell_places.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace scree
{
  using namespace dealii;

  void RainParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Rain");
    prm.add_parameter("Rate",
                      rate,
                      "m/s; rain on the surface of the soil, not negative: volume per time and horizontal area, an "
                      "expression of t such as if(t < 60, 1e-4, 0). 50 mm/h are 1.39e-5 m/s. What does not enter runs "
                      "off. Empty: no rain.",
                      Patterns::Anything());
    prm.leave_subsection();
  }


  void RainParameters::check(const std::vector<double> &gravity,
                             const bool has_own_points,
                             const double air_entry,
                             const unsigned int n_bodies) const
  {
    if (!is_set())
      return;
    require_entry(has_own_points && n_bodies > 0,
                  "Rain",
                  "Rate",
                  rate,
                  "rain needs soil, and water with points of its own. Add a subsection Water (\"Region = 0\": no water "
                  "at the start) with \"Point sets = double\".");
    require_entry(air_entry == 0.,
                  "Water",
                  "Air entry pressure",
                  air_entry,
                  "rain does not enter soil with suction yet. Remove this entry, or subsection Rain.");
    const long dim = long(gravity.size());
    require_entry(gravity.back() < 0 && std::count(gravity.begin(), gravity.end(), 0.) + 1 == dim,
                  "Rain",
                  "Rate",
                  rate,
                  std::string("rain needs gravity along -") + "xyz"[dim - 1] +
                      ", but entry \"Gravity\" = " + number_text(gravity) + ". Change it, or remove the rain.");
    parse_expression<1>(entry_name("Rain", "Rate"), rate, 1);
  }


  template <int dim>
  Rain<dim>::Rain(const RainParameters &parameters,
                  const BackgroundGrid<dim> &grid,
                  const double spacing,
                  const RainedSoil &soil)
      : grid(grid)
      , spacing(spacing)
      , soil(soil)
      , depth(soil.porosity * spacing)
      , rate(parse_expression<1>(entry_name("Rain", "Rate"), parameters.rate, 1))
      , n_slots(std::lround(0.5 * grid.cell_size() / spacing) + 1)
  {
    unsigned int n_columns = 1;
    for (unsigned int a = 0; a + 1 < dim; ++a)
      n_columns *= n[a] = std::lround((grid.upper_corner()[a] - grid.lower_corner()[a]) / spacing);
    constexpr double golden = 0.6180339887498949;
    for (unsigned int column = 0; column < n_columns; ++column)
      {
        due.push_back(depth * std::fmod(golden * (column + 1), 1.)); // in turns, and right in the mean
        books.waiting -= due.back() * std::pow(spacing, dim - 1);
      }
    reinit();
  }


  template <int dim>
  void Rain<dim>::reinit()
  {
    own_cells.clear();
    for (const auto &cell : grid.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && holds_nodes(cell))
        own_cells.emplace(grid.fine_cells().box().place_of_corner(cell->vertex(0)), cell);
  }


  template <int dim>
  Point<dim> Rain<dim>::foot(const unsigned int column) const
  {
    Point<dim> x      = grid.lower_corner();
    unsigned int rest = column;
    for (unsigned int a = 0; a + 1 < dim; ++a, rest /= n[a - 1])
      x[a] += (rest % n[a] + 0.5) * spacing;
    return x;
  }


  template <int dim>
  double Rain<dim>::area() const
  {
    return due.size() * std::pow(spacing, dim - 1);
  }


  template <int dim>
  bool Rain<dim>::count(const double time, const double time_step)
  {
    const double away = 0.5 * time_step / std::sqrt(3.), middle = time + 0.5 * time_step; // Gauss
    const double first = rate->value(Point<1>(middle - away)), second = rate->value(Point<1>(middle + away));
    AssertThrow(first >= 0. && second >= 0.,
                ExcMessage("subsection Rain, entry \"Rate\": it is below 0 at t = " + number_text(time) + " s."));
    const double fallen = 0.5 * time_step * (first + second);
    bool is_due         = false;
    for (unsigned int column = 0; column < due.size(); ++column)
      is_due = (due[column] += fallen) >= depth || is_due;
    books.fell += fallen * area();
    return is_due && fallen > 0.;
  }


  template <int dim>
  typename Rain<dim>::Columns Rain<dim>::no_columns() const
  {
    const std::vector<double> nowhere(due.size(), -std::numeric_limits<double>::infinity());
    const std::size_t n = due.size() * n_slots;
    return { nowhere, nowhere, std::vector<int>(n, 0), std::vector<double>(n, 0.) };
  }


  template <int dim>
  template <typename Function>
  void Rain<dim>::for_columns_near(const Point<dim> &x, const double reach, const Function &act) const
  {
    std::array<int, dim - 1> first, last;
    for (unsigned int a = 0; a + 1 < dim; ++a)
      {
        const double at = (x[a] - grid.lower_corner()[a]) / spacing - 0.5;
        first[a]        = std::max(0, int(std::ceil(at - reach / spacing)));
        last[a]         = std::min(int(n[a]) - 1, int(std::floor(at + reach / spacing)));
      }
    for (int i = first[0]; i <= last[0]; ++i)
      if constexpr (dim == 2)
        act(i);
      else
        for (int j = first[1]; j <= last[1]; ++j)
          act(i + int(n[0]) * j);
  }


  template <int dim>
  void Rain<dim>::find_top(const Point<dim> &x, std::vector<double> &heights) const
  {
    // No column between two points misses both.
    for_columns_near(x, 0.75 * std::max(soil.spacing, spacing), [&](const unsigned int column) {
      heights[column] = std::max(heights[column], x[dim - 1]);
    });
  }


  template <int dim>
  double Rain<dim>::surface(const unsigned int column, const Columns &columns) const
  {
    return columns.soil[column] + 0.5 * soil.spacing;
  }


  template <int dim>
  void Rain<dim>::fill_with_soil(const Point<dim> &x, Columns &columns) const
  {
    for_columns_near(x, 0.75 * std::max(soil.spacing, spacing), [&](const unsigned int column) {
      const double below = (surface(column, columns) - x[dim - 1]) / spacing;
      const double reach = 0.75 * std::max(soil.spacing / spacing, 1.);
      const int last     = std::min(int(n_slots) - 1, int(std::floor(below + reach - 0.5)));
      for (int slot = std::max(0, int(std::ceil(below - reach - 0.5))); slot <= last; ++slot)
        columns.has_soil[column * n_slots + slot] = 1;
    });
  }


  template <int dim>
  void Rain<dim>::fill_with_water(const Point<dim> &x, const double volume, Columns &columns) const
  {
    for_columns_near(x, 0.5 * spacing, [&](const unsigned int column) {
      const double below = (surface(column, columns) - x[dim - 1]) / spacing;
      if (below >= 0. && below < n_slots)
        columns.filled[column * n_slots + int(below)] += volume / this->volume();
    });
  }


  template <int dim>
  bool Rain<dim>::has_room(const unsigned int column, const Columns &columns) const
  {
    if (columns.has_soil[column * n_slots] == 0 || columns.filled[column * n_slots] > 0.)
      return false;
    double pores = 0., filled = 0.;
    for_columns_near(foot(column), (0.5 + 1e-9) * grid.cell_size(), [&](const unsigned int other) {
      for (unsigned int slot = other * n_slots; slot < (other + 1) * n_slots; ++slot)
        {
          pores += columns.has_soil[slot];
          filled += columns.filled[slot];
        }
    });
    return filled + 0.5 < pores;
  }


  template <int dim>
  double Rain<dim>::height_of_drop(const unsigned int column, const Columns &columns) const
  {
    const double top = surface(column, columns);
    return has_room(column, columns) ? top - 0.5 * spacing
                                     : std::max(top, columns.water[column] + 0.5 * spacing) + 0.5 * spacing;
  }


  template <int dim>
  void Rain<dim>::take(const unsigned int column, const double taken, double &volume)
  {
    due[column] -= taken;
    volume += taken * std::pow(spacing, dim - 1);
  }


  template <int dim>
  RainBooks Rain<dim>::account() const
  {
    RainBooks result = books;
    result.waiting += std::accumulate(due.begin(), due.end(), 0.) * std::pow(spacing, dim - 1);
    return result;
  }


  template <int dim>
  std::vector<typename Rain<dim>::Drop> Rain<dim>::drops(const Columns &columns)
  {
    std::vector<Drop> result;
    for (unsigned int column = 0; column < due.size(); ++column)
      if (due[column] >= depth)
        {
          Point<dim> x = foot(column);
          x[dim - 1]   = std::min(height_of_drop(column, columns), grid.upper_corner()[dim - 1] - 0.5 * spacing);
          if (!std::isfinite(columns.soil[column]))
            take(column, depth, books.beside_soil);
          else
            {
              take(column, depth, books.entered);
              result.push_back({ column, x });
            }
        }
    return result;
  }


  template <int dim>
  const typename Rain<dim>::CellIterator *Rain<dim>::cell_at(const Point<dim> &x) const
  {
    const auto entry = own_cells.find(grid.fine_cells().box().place_near(x));
    return entry == own_cells.end() ? nullptr : &entry->second;
  }

  template class Rain<2>;
  template class Rain<3>;
} // namespace scree
