// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/expression.h>
#include <scree/input/input_error.h>
#include <scree/particles/region.h>
#include <scree/momentum/surface_load.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::string point_text(const Point<dim> &x)
    {
      return number_text(x);
    }

    /// The markers' places on one axis of a cell and the width each stands for, m.
    std::vector<std::pair<double, double>> places_on_axis(const double cell_lower,
                                                          const double cell_size,
                                                          const unsigned int markers_per_cell,
                                                          const double lower,
                                                          const double upper)
    {
      std::vector<std::pair<double, double>> places;
      const double width = cell_size / markers_per_cell;
      for (unsigned int i = 0; i < markers_per_cell; ++i)
        {
          const double begin = std::max(lower, cell_lower + i * width);
          const double end   = std::min(upper, cell_lower + (i + 1) * width);
          if (end - begin > 1e-9 * width) // rounding leaves slivers
            places.emplace_back(0.5 * (begin + end), end - begin);
        }
      return places;
    }
  } // namespace


  void SurfaceLoadParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Surface load");
    prm.add_parameter(
        "Lower corner",
        lower_corner,
        "m; lower corner of a flat patch of the soil surface. The two corners share exactly one coordinate.",
        Patterns::List(Patterns::Double(), 2, 3));
    prm.add_parameter(
        "Upper corner", upper_corner, "m; opposite corner of the patch.", Patterns::List(Patterns::Double(), 2, 3));
    prm.add_parameter("Traction",
                      traction,
                      "Pa; force per initial area of the patch: one expression of x, y (z) and t per axis, separated "
                      "by semicolons, such as 0; -1e4. Empty: no load.",
                      Patterns::Anything());
    prm.leave_subsection();
  }


  bool SurfaceLoadParameters::changes_with_time() const
  {
    return std::regex_search(traction, std::regex("\\bt\\b"));
  }


  unsigned int SurfaceLoadParameters::normal_axis(const unsigned int dim) const
  {
    unsigned int axis = 0;
    while (axis < dim && lower_corner[axis] != upper_corner[axis])
      ++axis;
    return axis;
  }


  double SurfaceLoadParameters::layer_below(const unsigned int axis, const double lower, const double cell_size) const
  {
    // Cells below the plane; 0 if the plane is the lower face of the box.
    const double cells_below = (lower_corner[axis] - lower) / cell_size;
    return lower + cell_size * std::max(0., std::ceil(cells_below - 1e-9) - 1);
  }


  bool
  SurfaceLoadParameters::touches_cell(const double *corner, const GridParameters &grid, const unsigned int dim) const
  {
    const unsigned int normal = normal_axis(dim);
    bool touches              = is_set();
    for (unsigned int a = 0; a < dim && touches; ++a)
      touches = a == normal
                    ? std::abs(corner[a] - layer_below(a, grid.lower_corner[a], grid.cell_size)) < 0.5 * grid.cell_size
                    : corner[a] < upper_corner[a] && corner[a] + grid.cell_size > lower_corner[a];
    return touches;
  }


  void SurfaceLoadParameters::check(const GridParameters &grid, const unsigned int dim) const
  {
    const std::string subsection = "Surface load";
    const auto corners           = { std::make_pair("Lower corner", lower_corner), { "Upper corner", upper_corner } };
    if (!is_set())
      {
        for (const auto &[name, corner] : corners)
          require_entry(corner == SurfaceLoadParameters().lower_corner,
                        { subsection, name, number_text(corner) },
                        "this entry has no effect. Remove it, or write a \"Traction\", in Pa.");
        return;
      }
    check_expression(dim, entry_name(subsection, "Traction"), traction, dim, true);

    for (const auto &[name, corner] : corners)
      {
        require_entry(corner.size() == dim,
                      { subsection, name, number_text(corner) },
                      "entry \"Dimension\" is " + std::to_string(dim) + ". Write " + std::to_string(dim) +
                          " coordinates in m, separated by commas.");
        for (unsigned int a = 0; a < dim; ++a)
          require_entry(corner[a] >= grid.lower_corner[a] && corner[a] <= grid.upper_corner[a],
                        { subsection, name, number_text(corner) },
                        "it lies outside the box of subsection Mesh, from " + number_text(grid.lower_corner) + " to " +
                            number_text(grid.upper_corner) + ". Move it, or a corner of the box.");
      }
    unsigned int n_equal = 0;
    for (unsigned int a = 0; a < dim; ++a)
      {
        n_equal += lower_corner[a] == upper_corner[a];
        require_entry(lower_corner[a] <= upper_corner[a],
                      { subsection, "Upper corner", number_text(upper_corner) },
                      "it lies below \"Lower corner\" = " + number_text(lower_corner) + " along " +
                          std::string(1, "xyz"[a]) + ". Exchange the two coordinates.");
      }
    require_entry(n_equal == 1,
                  { subsection, "Upper corner", number_text(upper_corner) },
                  "it shares " + std::to_string(n_equal) + " coordinates with \"Lower corner\" = " +
                      number_text(lower_corner) + ". Those of a flat patch across an axis share exactly one.");
  }


  template <int dim>
  SurfaceLoad<dim>::SurfaceLoad(const BackgroundGrid<dim> &grid,
                                const SurfaceLoadParameters &parameters,
                                const unsigned int markers_per_cell)
      : corner(parameters.lower_corner)
      , normal(parameters.normal_axis(dim))
      , markers(grid.triangulation(), grid.mapping(), 1)
      , function(
            parse_expression<dim>(entry_name("Surface load", "Traction"), parameters.traction, dim, /*with_time*/ true))
  {
    const double cell_size   = grid.cell_size();
    const double layer_lower = parameters.layer_below(normal, grid.lower_corner()[normal], cell_size);
    // A hair inside the layer: rounding must not put a marker on a face into the next cell, which holds no soil.
    const double hair = 1e-9 * cell_size;
    const double plane =
        std::clamp(parameters.lower_corner[normal], layer_lower + hair, layer_lower + cell_size - hair);

    std::vector<Seed<dim>> seeds;
    for (const auto &cell : grid.triangulation().active_cell_iterators())
      {
        const Point<dim> lower = cell->vertex(0);
        if (!cell->is_locally_owned() || !holds_nodes(cell) || std::abs(lower[normal] - layer_lower) > 0.5 * cell_size)
          continue;
        std::array<std::vector<std::pair<double, double>>, dim> places;
        unsigned int n = 1;
        for (unsigned int a = 0; a < dim; ++a)
          {
            places[a] = a == normal ? std::vector<std::pair<double, double>>{ { plane, 1. } }
                                    : places_on_axis(lower[a],
                                                     cell_size,
                                                     markers_per_cell,
                                                     parameters.lower_corner[a],
                                                     parameters.upper_corner[a]);
            n *= places[a].size();
          }
        for (unsigned int i = 0; i < n; ++i)
          {
            Seed<dim> seed{ cell, {}, 1. };
            for (unsigned int a = 0, rest = i; a < dim; ++a)
              {
                const auto &[place, width] = places[a][rest % places[a].size()];
                rest /= places[a].size();
                seed.location[a] = place;
                seed.volume *= width;
              }
            seeds.push_back(seed);
          }
      }
    insert_points<dim>(
        markers, seeds, cell_size, grid.communicator(), [](const Seed<dim> &seed, std::vector<double> &properties) {
          properties[area] = seed.volume;
        });
  }


  template <int dim>
  Tensor<1, dim> SurfaceLoad<dim>::traction(const Point<dim> &x, const double time) const
  {
    function->set_time(time);
    Tensor<1, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      result[a] = function->value(x, a);
    return result;
  }

  template <int dim>
  void SurfaceLoad<dim>::require_soil(const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator) const
  {
    std::set<unsigned int> cells_with_soil;
    for (const auto &body : bodies)
      for (const auto &cell : body.points.cells())
        cells_with_soil.insert(cell.cell);
    std::string fault;
    for (const auto &cell : markers.cells())
      if (fault.empty() && cells_with_soil.count(cell.cell) == 0)
        fault = entry_message({ "Surface load", "Lower corner", number_text(corner) },
                              "the patch must lie on soil, and around " + point_text(cell.location_of(0)) +
                                  " there is none. Move it to the surface of a body.");
    throw_on_all_ranks(fault, communicator);
  }

  template class SurfaceLoad<2>;
  template class SurfaceLoad<3>;
} // namespace scree
