// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/grid/shape_functions.h>
#include <scree/transfer/load_transfer.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Calls `visit(cell, p, force)` for the markers.
    template <int dim, typename Visit>
    void visit_markers(const SurfaceLoad<dim> &load, const double time, const Visit &visit)
    {
      for (const auto &cell : load.points().cells())
        for (unsigned int p = 0; p < cell.n_points; ++p)
          visit(cell,
                p,
                cell.properties[p * load.points().stride() + SurfaceLoad<dim>::area] *
                    load.traction(cell.location[p], time));
    }
  } // namespace


  template <int dim>
  Tensor<1, dim>
  add_load(const SurfaceLoad<dim> &load, const double time, const BackgroundGrid<dim> &grid, NodalField<dim> &field)
  {
    Tensor<1, dim> sum;
    visit_markers(load, time, [&](const auto &cell, const unsigned int p, const Tensor<1, dim> &force) {
      if (p == 0)
        field.activate_cell(cell.cell);
      visit_nodes(grid, cell.cell, cell.reference_location[p], [&](const unsigned int node, const double value) {
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
    visit_markers(load, time, [&](const auto &cell, const unsigned int p, const Tensor<1, dim> &force) {
      Tensor<1, dim> velocity, mean;
      double weight = 0;
      visit_nodes(grid, cell.cell, cell.reference_location[p], [&](const unsigned int node, const double value) {
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
        cell.location[p] += time_step / weight * velocity;
      // Soil under a load at the face of the box may swell; the load must not vanish with its marker.
      for (unsigned int a = 0; a < dim; ++a)
        cell.location[p][a] = std::clamp(cell.location[p][a], grid.lower_corner()[a], grid.upper_corner()[a]);
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
