// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_wall_gaps_h
#define scree_boundary_wall_gaps_h

#include <scree/boundary/constraints.h>
#include <scree/mesh/node_values.h>
#include <scree/boundary/body_forces.h>
#include <scree/mixture/mixture.h>

namespace scree
{
  /// A wall of the box constrains a node only once a particle has reached the wall.
  ///
  /// A node on a wall moves with everything in the cells beside it. Constraining it as soon as a particle enters one of
  /// them would stop a falling body up to a cell before the wall, and compress the soil there. So a wall does not act
  /// on a node that approaches it while the gap is open; if the gap would close within the step, the wall constrains
  /// the node at the speed that just closes it. The gap is that of the nearest particle less .6 of the particle
  /// spacing. Slow nodes are constrained at once: in wet scenes those slower than after a fall through an eighth of a
  /// cell, v^2 < g h/4; in dry scenes at fixed walls those slower than after a fall through half a cell, v^2 < g h, as
  /// soil that spreads over a fixed floor otherwise stops earlier (column_dense, h = .05 m: the 99.5 % front 2.37 m in
  /// place of 2.66; 2.83 at h/2). In wet scenes there is no gap beside a full cell.
  template <int dim>
  class WallGaps
  {
  public:
    /// Fields whose mass moves with one velocity: that of one group of bodies, or of soil and water together.
    using Fields = std::vector<const NodalField<dim> *>;

    /// Keeps references to both.
    WallGaps(const BackgroundGrid<dim> &grid, Constraints<dim> &constraints)
        : grid(grid)
        , constraints(constraints)
        , closed_faces(constraints.closed_faces())
    {
      reinit();
    }

    /// These move with one velocity and meet the walls, too. They must live on.
    void add(const Fields &fields)
    {
      all_fields.push_back(fields);
    }

    /// Whether these are the gaps at nodes with these constraints.
    bool are_of(const Constraints<dim> &others) const
    {
      return &others == &constraints;
    }

    /// Fits the gaps to the grid's current nodes.
    void reinit()
    {
      for (NodeVector &gap : gaps)
        gap.reinit(grid.numbering().partitioner());
      released.reinit(grid.numbering().partitioner());
      closes.reinit(grid.numbering().partitioner());
      closing.assign(grid.n_owned_nodes(), dealii::Tensor<1, dim>());
      on_walls.clear();
      for (unsigned int node = 0; node < grid.numbering().n_local(); ++node)
        if ((grid.node_faces(node) & closed_faces) != 0)
          on_walls.push_back(node);
      clear();
    }

    /// All walls act on all nodes, and no gap is known, before a new step.
    void clear()
    {
      constraints.hold_all();
      for (const unsigned int node : on_walls)
        {
          for (NodeVector &gap : gaps)
            gap.local_element(node) = far;
          released.local_element(node) = 0.;
          closes.local_element(node)   = 0.;
          if (node < grid.n_owned_nodes())
            closing[node] = dealii::Tensor<1, dim>();
        }
    }

    /// Takes the gaps of points.
    /// @param spacing of the points at the start, m
    void add(const PointSet<dim> &points, const double spacing);

    /// Cells that are full of water and wet soil have no gap.
    void add(const Mixture<dim> &mixture)
    {
      for (const MixtureCell<dim> &cell : mixture.cells())
        if (cell.bulk_volume >= closures::full_cell_at_wall * cell.volume)
          for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
            if (const unsigned int node = grid.nodes(cell.cell)[i]; grid.node_faces(node) != 0)
              for (NodeVector &gap : gaps)
                gap.local_element(node) = 0.;
    }

    /// Frees nodes of walls for the step, s. The fields hold mass, momentum and force of owned nodes; of several
    /// `Fields` the one that approaches a wall fastest decides. Collective.
    void release(const BodyForces<dim> &forcing, const double time_step);

    /// Whether water does not move through a face of the box at a node of this rank's cells that lies on that.
    bool is_closed_to_water(const unsigned int node, const unsigned int face) const
    {
      const NodeConstraints<dim> *walls = constraints.at(node);
      return walls != nullptr && walls->water_velocity.norm_square() == 0. && !(closes.local_element(node) > 0.) &&
             walls->water_constraint.held_part(dealii::Point<dim>::unit_vector(face / 2)).norm_square() > 0.5;
    }

    /// Velocity, m/s, at which walls hold an owned node that closes its gap in this step; else 0.
    const dealii::Tensor<1, dim> &closing_velocity(const unsigned int node) const
    {
      return closing[node];
    }

  private:
    using NodeVector = dealii::LinearAlgebra::distributed::Vector<double>;

    static constexpr double far = 1.; // a cell without points

    /// The closed wall that a node lies on across an axis: 1 the lower, 2 the upper one, 0 none.
    unsigned int side_across(const unsigned int axis, const unsigned int node) const
    {
      return (grid.node_faces(node) & closed_faces) >> 2 * axis & 3;
    }

    /// Speed, m/s, up to which a wall acts at once.
    double slow(const unsigned int face, const double gravity) const
    {
      if (!constraints.has_water() && !constraints.is_fixed(face))
        return 0.;
      if (!constraints.has_water() && gravity == 0.)
        return std::numeric_limits<double>::infinity(); // Nothing falls.
      const double fall = constraints.has_water() ? closures::fall_of_wet_soil : closures::fall_onto_fixed_wall;
      return speed_after_fall(fall, gravity, grid.cell_size());
    }

    const BackgroundGrid<dim> &grid;
    Constraints<dim> &constraints;
    const std::uint8_t closed_faces; // to soil or water, bit f: face f
    std::vector<Fields> all_fields;
    std::array<NodeVector, dim> gaps;            // to the wall that a node lies on across an axis, cells
    NodeVector released;                         // faces, bit f: face f
    NodeVector closes;                           // whether a wall closes the gap in this step; with ghosts
    std::vector<dealii::Tensor<1, dim>> closing; // by owned node
    std::vector<unsigned int> on_walls;          // nodes on closed faces, ghosts included
  };
} // namespace scree

#endif
