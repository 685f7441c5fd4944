// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/grid/shape_functions.h>
#include <scree/transfer/load_transfer.h>

#include <algorithm>

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
  Tensor<1, dim>
  add_load(const SurfaceLoad<dim> &load, const double time, const BackgroundGrid<dim> &grid, NodalField<dim> &field)
  {
    Tensor<1, dim> sum;
    for (const auto &cell : load.points().cells())
      field.activate_cell(cell.cell);
    for_each_point(load.points(), [&](const auto &marker) {
      const Tensor<1, dim> force = force_on(load, marker, time);
      visit_nodes(grid, marker.cell, marker.reference_location, [&](const unsigned int node, const double value) {
        for (unsigned int c = 0; c < dim; ++c)
          field[node][NodalField<dim>::force + c] += value * force[c];
      });
      sum += force;
    });
    return sum;
  }


  template <int dim>
  double move_load(SurfaceLoad<dim> &load,
                   const double time,
                   const BackgroundGrid<dim> &grid,
                   const NodalField<dim> &field,
                   const double time_step)
  {
    double work = 0;
    for_each_point(load.points(), [&](const auto &marker) {
      const Tensor<1, dim> force = force_on(load, marker, time);
      Tensor<1, dim> velocity, mean;
      double weight = 0;
      visit_nodes(grid, marker.cell, marker.reference_location, [&](const unsigned int node, const double value) {
        const double *values = field[node];
        if (values[NodalField<dim>::mass] <= 0.)
          return; // Nothing was solved there.
        weight += value;
        for (unsigned int c = 0; c < dim; ++c)
          {
            velocity[c] += value * values[NodalField<dim>::velocity + c];
            mean[c] +=
                value * (values[NodalField<dim>::velocity + c] - 0.5 * values[NodalField<dim>::velocity_change + c]);
          }
      });
      work += time_step * (force * mean);
      // A marker a little above the last soil moves with what soil is near.
      if (weight > 0.)
        marker.location += time_step / weight * velocity;
      // Soil under a load at the face of the box may swell; the load must not vanish with its marker.
      for (unsigned int a = 0; a < dim; ++a)
        marker.location[a] = std::clamp(marker.location[a], grid.lower_corner()[a], grid.upper_corner()[a]);
    });
    return work;
  }

  template Tensor<1, 2> add_load(const SurfaceLoad<2> &, const double, const BackgroundGrid<2> &, NodalField<2> &);
  template Tensor<1, 3> add_load(const SurfaceLoad<3> &, const double, const BackgroundGrid<3> &, NodalField<3> &);
  template double
  move_load(SurfaceLoad<2> &, const double, const BackgroundGrid<2> &, const NodalField<2> &, const double);
  template double
  move_load(SurfaceLoad<3> &, const double, const BackgroundGrid<3> &, const NodalField<3> &, const double);
} // namespace scree
