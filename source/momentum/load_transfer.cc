// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/background_grid.h>
#include <scree/mixture/mixture.h>
#include <scree/momentum/load_transfer.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The force on a marker, N (2D: per m).
    template <int dim, typename Marker>
    Tensor<1, dim> force_on(const SurfaceLoad<dim> &load, const Marker &marker, const double time)
    {
      return marker.properties[SurfaceLoad<dim>::area] * load.traction(marker.location, time);
    }
  } // namespace


  template <int dim>
  LoadTransfer<dim>::LoadTransfer(const BackgroundGrid<dim> &grid, SurfaceLoad<dim> &load)
      : grid(grid)
      , load(load)
      , nodes(grid.numbering())
  {
  }


  template <int dim>
  void LoadTransfer<dim>::reinit()
  {
    nodes.reinit();
  }


  template <int dim>
  std::array<Point<dim>, 2> LoadTransfer<dim>::surroundings() const
  {
    // Lower corner with its sign changed, so that one maximum over ranks finds both.
    std::vector<double> bounds(2 * dim, std::numeric_limits<double>::lowest());
    for_each_point(std::as_const(load).points(), [&](const auto &marker) {
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
  void LoadTransfer<dim>::add_soil(const SoilBody<dim> &body, const ConstCellPoints<dim> &cell)
  {
    const OpenKnots open      = grid.open_knots(cell.cell);
    const unsigned int normal = load.normal_axis();
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
          values[area] += volume * along * basis.derivative[normal][k];
          values[mass] += point.properties[body.layout.mass] * along * basis.value[normal][k];
        }
    });
  }


  template <int dim>
  void LoadTransfer<dim>::find_areas(const std::list<SoilBody<dim>> &bodies)
  {
    nodes.clear();
    for (const auto &cell : std::as_const(load).points().cells())
      nodes.activate_cell(cell.cell);
    for_each_point(std::as_const(load).points(), [&](const auto &marker) {
      visit_nodes(grid, marker.cell, marker.reference_location, [&](const unsigned int node, const double shape) {
        nodes[node][marked_area] += shape * marker.properties[SurfaceLoad<dim>::area];
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
  typename LoadTransfer<dim>::OfNodes LoadTransfer<dim>::shapes_at(const unsigned int cell,
                                                                   const Point<dim> &reference_location) const
  {
    OfNodes shapes{};
    unsigned int i = 0;
    visit_nodes(grid, cell, reference_location, [&](const unsigned int, const double shape) { shapes[i++] = shape; });
    return shapes;
  }


  template <int dim>
  typename LoadTransfer<dim>::OfNodes LoadTransfer<dim>::shares(const unsigned int cell, const OfNodes &shapes) const
  {
    const unsigned int *of_cell = grid.nodes(cell);
    const unsigned int n = grid.n_nodes_1d(), stride = Utilities::pow(n, load.normal_axis());
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
            facing += shapes[i] * nodes[of_cell[i]][area];
            marked += nodes[of_cell[i]][marked_area];
          }
        // The patch may be the soil's upper or lower face.
        const auto face = [&, side = facing < 0 ? -1. : 1.](const unsigned int i) {
          return std::max(0., side * nodes[of_cell[i]][area]);
        };
        double total = 0;
        for (unsigned int k = 0, i = first; k < n; ++k, i += stride)
          total += face(i);
        for (unsigned int k = 0, i = first; k < n; ++k, i += stride)
          {
            result[i] = total > closures::least_area_of_surface * marked
                            ? shape * face(i) / total
                            : (nodes[of_cell[i]][mass] > 0 ? shapes[i] : 0.);
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
  Tensor<1, dim> LoadTransfer<dim>::add_to(NodalField<dim> &field, const double time) const
  {
    Tensor<1, dim> sum;
    for (const auto &cell : std::as_const(load).points().cells())
      field.activate_cell(cell.cell);
    for_each_point(std::as_const(load).points(), [&](const auto &marker) {
      const Tensor<1, dim> force = force_on(load, marker, time);
      const OfNodes share        = shares(marker.cell, shapes_at(marker.cell, marker.reference_location));
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          field[grid.nodes(marker.cell)[i]][NodalField<dim>::force + c] += share[i] * force[c];
      sum += force;
    });
    return sum;
  }


  template <int dim>
  Tensor<1, dim> LoadTransfer<dim>::velocity_of(const unsigned int cell,
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
      velocity[load.normal_axis()] = with_load[load.normal_axis()] / sum;
    return velocity;
  }


  template <int dim>
  double LoadTransfer<dim>::move(const NodalField<dim> &field, const double time, const double time_step)
  {
    double work = 0;
    for_each_point(load.points(), [&](const auto &marker) {
      const Tensor<1, dim> force = force_on(load, marker, time);
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

  template class LoadTransfer<2>;
  template class LoadTransfer<3>;
} // namespace scree
