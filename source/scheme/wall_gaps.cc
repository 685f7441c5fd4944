// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/wall_gaps.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Of the points' spacing: a little more than the half that a point fills.
    constexpr double reach_of_a_point = 0.6;

    /// Fill of a cell from which on it has no gap.
    constexpr double full_beside_wall = 0.9;

    /// Height of a fall, cells, up to the speed of which walls act as soon as a point is beside them.
    constexpr double least_fall = 0.125;
  } // namespace


  template <int dim>
  WallGaps<dim>::WallGaps(const BackgroundGrid<dim> &grid, Constraints<dim> &constraints, const unsigned int n_points)
      : grid(grid)
      , constraints(constraints)
      , reach(reach_of_a_point / n_points)
  {
    reinit();
  }


  template <int dim>
  void WallGaps<dim>::reinit()
  {
    for (NodeVector &gap : gaps)
      gap.reinit(grid.numbering().partitioner());
    released.reinit(grid.numbering().partitioner());
    closing.assign(grid.n_owned_nodes(), Tensor<1, dim>());
    on_walls.clear();
    for (unsigned int node = 0; node < grid.numbering().n_local(); ++node)
      if (grid.node_faces(node) != 0)
        on_walls.push_back(node);
    clear();
  }


  template <int dim>
  void WallGaps<dim>::clear()
  {
    constraints.hold_all();
    for (const unsigned int node : on_walls)
      {
        for (NodeVector &gap : gaps)
          gap.local_element(node) = far;
        released.local_element(node) = 0.;
        if (node < grid.n_owned_nodes())
          closing[node] = Tensor<1, dim>();
      }
  }


  template <int dim>
  void WallGaps<dim>::add(const PointSet<dim> &points)
  {
    for (const auto &cell : points.cells())
      {
        const unsigned int *nodes = grid.nodes(cell.cell);
        std::uint8_t walls        = 0;
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          walls |= grid.node_faces(nodes[i]);
        if (walls == 0)
          continue;
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
  void WallGaps<dim>::add(const Mixture<dim> &mixture)
  {
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.fill >= full_beside_wall)
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          if (const unsigned int node = grid.nodes(cell.cell)[i]; grid.node_faces(node) != 0)
            for (NodeVector &gap : gaps)
              gap.local_element(node) = 0.;
  }


  template <int dim>
  void WallGaps<dim>::release(const NodalField<dim> &soil,
                              const NodalField<dim> &water,
                              const Forcing<dim> &forcing,
                              const double time_step)
  {
    using Field = NodalField<dim>;
    for (NodeVector &gap : gaps)
      gap.compress(VectorOperation::min);
    const double slow = std::sqrt(2. * least_fall * forcing.gravity().norm() * grid.cell_size());
    for (const unsigned int node : on_walls)
      {
        if (node >= grid.n_owned_nodes() || !constraints.has_walls_alone(node))
          continue;
        const double *of_soil = soil[node], *of_water = water[node];
        const double mass = of_soil[Field::mass] + of_water[Field::mass];
        if (mass <= 0.)
          continue;
        const auto sum_of = [&](const unsigned int component) { return of_soil[component] + of_water[component]; };
        unsigned int open = 0;
        for (unsigned int a = 0; a < dim; ++a)
          {
            const unsigned int side = side_across(a, node);
            const double gap        = gaps[a].local_element(node);
            if (side == 0 || gap <= 0.)
              continue;
            const double to_inside = side == 1 ? 1. : -1.;
            const double speed     = (sum_of(Field::momentum + a) + time_step * sum_of(Field::force + a)) / mass +
                                 time_step * forcing.acceleration(node)[a];
            const double limit = -gap * grid.cell_size() / time_step;
            if (to_inside * speed > -slow)
              continue;
            if (to_inside * speed >= limit)
              open |= side << 2 * a;
            else
              closing[node][a] = to_inside * limit;
          }
        released.local_element(node) = open;
      }
    released.update_ghost_values();
    for (const unsigned int node : on_walls)
      if (released.local_element(node) != 0.)
        constraints.release(node, static_cast<std::uint8_t>(released.local_element(node)));
    released.zero_out_ghost_values();
  }

  template class WallGaps<2>;
  template class WallGaps<3>;
} // namespace scree
