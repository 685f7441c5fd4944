// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/rain.h>

namespace scree
{
  using namespace dealii;

  void RainParameters::check(const std::vector<double> &gravity,
                             const bool has_own_points,
                             const double air_entry,
                             const unsigned int n_bodies) const
  {
    if (!is_set())
      return;
    require_entry(has_own_points && n_bodies > 0,
                  { "Rain", "Rate", rate },
                  "rain needs soil, and water with points of its own. Add a subsection Water (\"Region = 0\": no water "
                  "at the start) with \"Point sets = double\".");
    require_entry(air_entry == 0.,
                  { "Water", "Air entry pressure", air_entry },
                  "rain does not enter soil with suction yet. Remove this entry, or subsection Rain.");
    const long dim = long(gravity.size());
    require_entry(gravity.back() < 0 && std::count(gravity.begin(), gravity.end(), 0.) + 1 == dim,
                  { "Rain", "Rate", rate },
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


  template class Rain<2>;
  template class Rain<3>;
} // namespace scree
