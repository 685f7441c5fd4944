// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/expression.h>
#include <scree/input/input_error.h>
#include <scree/particles/region.h>
#include <scree/mixture/mixture.h>
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
    check_expression(dim, entry_name(subsection, "Traction"), traction, dim, "t");

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
      : grid(grid)
      , corner(parameters.lower_corner)
      , normal(parameters.normal_axis(dim))
      , markers(grid.triangulation(), grid.mapping(), 1)
      , nodes(grid.numbering())
      , function(parse_expression<dim>(entry_name("Surface load", "Traction"), parameters.traction, dim, "t"))
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
  template <typename Marker>
  Tensor<1, dim> SurfaceLoad<dim>::force_on(const Marker &marker, const double time) const
  {
    function->set_time(time);
    Tensor<1, dim> traction; // of initial area, Pa
    for (unsigned int a = 0; a < dim; ++a)
      traction[a] = function->value(marker.location, a);
    return marker.properties[area] * traction;
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
                              "the patch must lie on soil, and around " + number_text(cell.location_of(0)) +
                                  " there is none. Move it to the surface of a body.");
    throw_on_all_ranks(fault, communicator);
  }


  template <int dim>
  std::array<Point<dim>, 2> SurfaceLoad<dim>::surroundings() const
  {
    // Lower corner with its sign changed, so that one maximum over ranks finds both.
    std::vector<double> bounds(2 * dim, std::numeric_limits<double>::lowest());
    for_each_point(std::as_const(markers), [&](const auto &marker) {
      for (unsigned int a = 0; a < dim; ++a)
        {
          bounds[a]       = std::max(bounds[a], -marker.location[a]);
          bounds[dim + a] = std::max(bounds[dim + a], marker.location[a]);
        }
    });
    Utilities::MPI::max(bounds, grid.communicator(), bounds);
    const double margin = grid.n_nodes_1d() * grid.cell_size();
    std::array<Point<dim>, 2> corners;
    for (unsigned int a = 0; a < dim; ++a)
      {
        corners[0][a] = -bounds[a] - margin;
        corners[1][a] = bounds[dim + a] + margin;
      }
    return corners;
  }


  template <int dim>
  template <int n>
  void SurfaceLoad<dim>::add_soil(const SoilBody<dim> &body, const ConstCellPoints<dim> &cell)
  {
    const OpenKnots open = grid.open_knots(cell.cell);
    for_each_point(cell, [&](const auto &point) {
      const CellBasis<dim, n> basis(point.reference_location, open);
      const double volume = point.properties[body.layout.volume] / grid.cell_size();
      for (unsigned int i = 0; i < basis.n_nodes; ++i)
        {
          double along = 1.;
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
            along *= a == normal ? 1. : basis.value[a][rest % n];
          const unsigned int k = i / Utilities::pow(n, normal) % n;
          double *values       = nodes[grid.nodes(cell.cell)[i]];
          values[area_of_soil] += volume * along * basis.derivative[normal][k];
          values[mass_of_soil] += point.properties[body.layout.mass] * along * basis.value[normal][k];
        }
    });
  }


  template <int dim>
  void SurfaceLoad<dim>::find_areas(const std::list<SoilBody<dim>> &bodies)
  {
    nodes.clear();
    for (const auto &cell : std::as_const(markers).cells())
      nodes.activate_cell(cell.cell);
    for_each_point(std::as_const(markers), [&](const auto &marker) {
      visit_nodes(grid, marker.cell, marker.reference_location, [&](const unsigned int node, const double shape) {
        nodes[node][area_of_markers] += shape * marker.properties[area];
      });
    });
    const auto [lower, upper] = surroundings();
    for (const auto &body : bodies)
      for (const auto &cell : body.points.cells())
        {
          bool is_near = true;
          for (unsigned int a = 0; a < dim; ++a)
            is_near = is_near && cell.location_of(0)[a] > lower[a] && cell.location_of(0)[a] < upper[a];
          if (!is_near)
            continue;
          nodes.activate_cell(cell.cell);
          with_nodes_1d(grid, [&](auto n) { add_soil<n>(body, cell); });
        }
    nodes.add_contributions();
    nodes.update_ghosts();
  }


  template <int dim>
  typename SurfaceLoad<dim>::OfNodes SurfaceLoad<dim>::shapes_at(const unsigned int cell,
                                                                 const Point<dim> &reference_location) const
  {
    OfNodes shapes{};
    unsigned int i = 0;
    visit_nodes(grid, cell, reference_location, [&](const unsigned int, const double shape) { shapes[i++] = shape; });
    return shapes;
  }


  template <int dim>
  typename SurfaceLoad<dim>::OfNodes SurfaceLoad<dim>::shares(const unsigned int cell, const OfNodes &shapes) const
  {
    const unsigned int *of_cell = grid.nodes(cell);
    const unsigned int n = grid.n_nodes_1d(), stride = Utilities::pow(n, normal);
    OfNodes result{};
    double sum = 0;
    for (unsigned int first = 0; first < grid.n_nodes_per_cell(); ++first)
      {
        if (first / stride % n != 0)
          continue; // not the first of a column of nodes across the patch
        double shape = 0, facing = 0, marked = 0;
        for (unsigned int k = 0, i = first; k < n; ++k, i += stride)
          {
            shape += shapes[i];
            facing += shapes[i] * nodes[of_cell[i]][area_of_soil];
            marked += nodes[of_cell[i]][area_of_markers];
          }
        // The patch may be the soil's upper or lower face.
        const auto face = [&, side = facing < 0 ? -1. : 1.](const unsigned int i) {
          return std::max(0., side * nodes[of_cell[i]][area_of_soil]);
        };
        double total = 0;
        for (unsigned int k = 0, i = first; k < n; ++k, i += stride)
          total += face(i);
        for (unsigned int k = 0, i = first; k < n; ++k, i += stride)
          {
            result[i] = total > closures::least_area_of_surface * marked
                            ? shape * face(i) / total
                            : (nodes[of_cell[i]][mass_of_soil] > 0 ? shapes[i] : 0.);
            sum += result[i];
          }
      }
    if (sum <= 0.)
      return shapes; // No soil is near: the nodes drop the force.
    for (double &share : result)
      share /= sum;
    return result;
  }


  template <int dim>
  Tensor<1, dim> SurfaceLoad<dim>::add_to(NodalField<dim> &field, const double time) const
  {
    Tensor<1, dim> sum;
    for (const auto &cell : std::as_const(markers).cells())
      field.activate_cell(cell.cell);
    for_each_point(std::as_const(markers), [&](const auto &marker) {
      const Tensor<1, dim> force = force_on(marker, time);
      const OfNodes share        = shares(marker.cell, shapes_at(marker.cell, marker.reference_location));
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          field[grid.nodes(marker.cell)[i]][NodalField<dim>::force + c] += share[i] * force[c];
      sum += force;
    });
    return sum;
  }


  template <int dim>
  Tensor<1, dim> SurfaceLoad<dim>::velocity_of(const unsigned int cell,
                                               const OfNodes &shapes,
                                               const OfNodes &share,
                                               const NodalField<dim> &field) const
  {
    Tensor<1, dim> with_load, with_soil;
    double mass = 0, sum = 0;
    for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
      {
        const double *values   = field[grid.nodes(cell)[i]];
        const double soil_mass = shapes[i] * values[NodalField<dim>::mass];
        if (values[NodalField<dim>::mass] <= 0.)
          continue; // Nothing was solved there.
        mass += soil_mass;
        sum += share[i];
        for (unsigned int c = 0; c < dim; ++c)
          {
            with_load[c] += share[i] * values[NodalField<dim>::velocity + c];
            with_soil[c] += soil_mass * values[NodalField<dim>::velocity + c];
          }
      }
    if (mass <= 0.)
      return {};
    // Along the patch the heavy nodes lead. A marker that followed the light ones of its top cell would lean with them,
    // and its load on.
    Tensor<1, dim> velocity = with_soil / mass;
    if (sum > 0.)
      velocity[normal] = with_load[normal] / sum;
    return velocity;
  }


  template <int dim>
  double SurfaceLoad<dim>::move(const NodalField<dim> &field, const double time, const double time_step)
  {
    double work = 0;
    for_each_point(markers, [&](const auto &marker) {
      const Tensor<1, dim> force = force_on(marker, time);
      const OfNodes shapes       = shapes_at(marker.cell, marker.reference_location);
      const OfNodes share        = shares(marker.cell, shapes);
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        if (const double *values = field[grid.nodes(marker.cell)[i]]; values[NodalField<dim>::mass] > 0.)
          for (unsigned int c = 0; c < dim; ++c)
            work += time_step * share[i] * force[c] *
                    (values[NodalField<dim>::velocity + c] - 0.5 * values[NodalField<dim>::velocity_change + c]);
      marker.location += time_step * velocity_of(marker.cell, shapes, share, field);
      // Soil under a load at the face of the box may swell; the load must not vanish with its marker.
      for (unsigned int a = 0; a < dim; ++a)
        marker.location[a] = std::clamp(marker.location[a], grid.lower_corner()[a], grid.upper_corner()[a]);
    });
    return work;
  }

  template class SurfaceLoad<2>;
  template class SurfaceLoad<3>;
} // namespace scree
