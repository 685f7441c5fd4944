// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/wall_gaps.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void WallGaps<dim>::add(const PointSet<dim> &points, const double spacing)
  {
    const double reach = closures::reach_of_a_point * spacing / grid.cell_size();
    for (const auto &cell : points.cells())
      {
        if ((grid.open_knots(cell.cell) & closed_faces) == 0)
          continue;
        const unsigned int *nodes = grid.nodes(cell.cell);
        std::array<double, dim> lowest, highest; // places of points, cells
        lowest.fill(1.);
        highest.fill(0.);
        for (unsigned int p = 0; p < cell.n_points; ++p)
          for (unsigned int a = 0; a < dim; ++a)
            {
              const double place = cell.reference_location_of(p)[a];
              lowest[a]          = std::min(lowest[a], place);
              highest[a]         = std::max(highest[a], place);
            }
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          for (unsigned int a = 0; a < dim; ++a)
            if (const unsigned int side = side_across(a, nodes[i]); side != 0)
              {
                double &gap = gaps[a].local_element(nodes[i]);
                gap         = std::min(gap, (side == 1 ? lowest[a] : 1. - highest[a]) - reach);
              }
      }
  }


  template <int dim>
  void WallGaps<dim>::release(const BodyForces<dim> &forcing, const double time_step)
  {
    using Field = NodalField<dim>;
    if (closed_faces == 0)
      return;
    for (NodeVector &gap : gaps)
      gap.compress(VectorOperation::min);
    std::array<double, 2 * dim> slow_of_face;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      slow_of_face[face] = slow(face, forcing.fall().norm());
    for (const unsigned int node : on_walls)
      {
        if (node >= grid.n_owned_nodes() || !constraints.has_walls_alone(node))
          continue;
        unsigned int open = 0;
        for (unsigned int a = 0; a < dim; ++a)
          {
            const unsigned int side = side_across(a, node);
            const double gap        = gaps[a].local_element(node);
            if (side == 0 || gap <= 0.)
              continue;
            const double to_inside = side == 1 ? 1. : -1.;
            double speed           = 0.; // away from the wall
            for (const Fields &fields : all_fields)
              {
                double mass = 0., impulse = 0.;
                for (const NodalField<dim> *field : fields)
                  {
                    const double *values = (*field)[node];
                    mass += values[Field::mass];
                    impulse += values[Field::momentum + a] + time_step * values[Field::force + a];
                  }
                if (mass > 0.)
                  speed = std::min(speed, to_inside * (impulse / mass + time_step * forcing.acceleration(node)[a]));
              }
            const double limit = -gap * grid.cell_size() / time_step;
            if (speed >= 0. || speed > -slow_of_face[2 * a + side - 1])
              continue;
            if (speed >= limit)
              open |= side << 2 * a;
            else
              {
                closing[node][a]           = to_inside * limit;
                closes.local_element(node) = 1.;
              }
          }
        released.local_element(node) = open;
      }
    released.update_ghost_values();
    closes.update_ghost_values();
    for (const unsigned int node : on_walls)
      if (released.local_element(node) != 0.)
        constraints.release(node, static_cast<std::uint8_t>(released.local_element(node)));
    released.zero_out_ghost_values();
  }

  template class WallGaps<2>;
  template class WallGaps<3>;
} // namespace scree
