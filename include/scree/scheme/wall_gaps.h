// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_wall_gaps_h
#define scree_scheme_wall_gaps_h

#include <scree/grid/constraints.h>
#include <scree/grid/nodal_field.h>
#include <scree/points/point_set.h>
#include <scree/scheme/forcing.h>
#include <scree/transfer/mixture.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <vector>

namespace scree
{
  /// Walls of the box act on what has reached them.
  ///
  /// A node on a wall moves with all that is in the cells beside it. Were it held from the moment that a point comes
  /// into one of them, what falls would be stopped up to a cell before the wall, by stress of soil that is pressed
  /// together there and by pressure that grows as steps shrink. So a wall does not act on a node that comes towards it
  /// faster than after a fall through an eighth of a cell, v^2 > g h/4, while their gap is open; if it would close
  /// within the step, the wall holds the node at the speed that just closes it. The gap is that of the nearest point
  /// less .6 of the points' spacing; beside a cell that is full there is none.
  template <int dim>
  class WallGaps
  {
  public:
    /// @param n_points of a cell along each axis at the start; where they are fewest
    WallGaps(const BackgroundGrid<dim> &grid, Constraints<dim> &constraints, const unsigned int n_points);

    /// Fits the gaps to the grid's current nodes.
    void reinit();

    /// All walls act on all nodes, and no gap is known, before a new step.
    void clear();

    /// Heeds points, and cells that are full of water and wet soil, which have no gap.
    void add(const PointSet<dim> &points);
    void add(const Mixture<dim> &mixture);

    /// Frees nodes of walls for the step, s. `soil` and `water` hold mass, momentum and force of owned nodes.
    /// Collective.
    void release(const NodalField<dim> &soil,
                 const NodalField<dim> &water,
                 const Forcing<dim> &forcing,
                 const double time_step);

    /// Velocity, m/s, at which walls hold an owned node that closes its gap in this step; else 0.
    const dealii::Tensor<1, dim> &closing_velocity(const unsigned int node) const
    {
      return closing[node];
    }

  private:
    using NodeVector = dealii::LinearAlgebra::distributed::Vector<double>;

    static constexpr double far = 1.; // a cell without points

    /// The wall that a node lies on across an axis: 1 the lower, 2 the upper one, 0 none.
    unsigned int side_across(const unsigned int axis, const unsigned int node) const
    {
      return grid.node_faces(node) >> 2 * axis & 3;
    }

    const BackgroundGrid<dim> &grid;
    Constraints<dim> &constraints;
    const double reach;                          // of a point, cells
    std::array<NodeVector, dim> gaps;            // to the wall that a node lies on across an axis, cells
    NodeVector released;                         // faces, bit f: face f
    std::vector<dealii::Tensor<1, dim>> closing; // by owned node
    std::vector<unsigned int> on_walls;          // nodes, ghosts included
  };
} // namespace scree

#endif
