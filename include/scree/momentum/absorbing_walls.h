// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_absorbing_walls_h
#define scree_momentum_absorbing_walls_h

#include <scree/bodies/phases.h>
#include <scree/boundary/body_forces.h>
#include <scree/boundary/constraints.h>
#include <scree/mesh/node_values.h>
#include <scree/pressure/solver_state.h>
#include <scree/step/step_report.h>

namespace scree
{
  /// Walls of type `absorbing`: ground goes on beyond them, and waves leave the box.
  ///
  /// From the release on, where soil lies at the walls then, the force at rest of a node stays, and dashpots of the
  /// impedances rho c_p and rho c_s act on its velocity relative to the free field (@source{lysmer1969}). The free
  /// field of a side is a column of elastic soil for each line of nodes, which the base motion shakes; its stress acts
  /// on the wall, too (@source{zienkiewicz1989}). Beyond the bottom is a half space, from which the base motion comes
  /// as a wave (@source{mejia2006}). A step takes the mean of the velocities at its ends, so that dashpots never give
  /// energy.
  template <int dim>
  class AbsorbingWalls
  {
  public:
    /// Keeps references to all of them.
    AbsorbingWalls(const BackgroundGrid<dim> &grid, Constraints<dim> &constraints, const BodyForces<dim> &forcing);

    /// Fits the walls to the grid's current nodes.
    void reinit();

    /// Releases the nodes of the walls for a step, before gaps of other walls are looked at.
    void release();

    /// Adds the forces of the ground beyond to the nodes, whose sums are those of all ranks. The first call finds what
    /// is at rest. Collective.
    void
    add_forces(const std::list<SoilBody<dim>> &bodies, NodalField<dim> &field, const double time_step, Budget<dim> &);

    /// Puts points that have moved through the walls back to them.
    void keep_inside(std::list<SoilBody<dim>> &bodies) const;

    FreeField<dim> free_field; ///< without nodes: the next add_forces() begins anew

  private:
    /// A node on these walls.
    struct WallNode
    {
      unsigned int node;                                         // of this rank's cells, ghosts included
      std::vector<std::pair<unsigned int, unsigned int>> places; // faces, and the numbers in `free_field`
      bool is_free;                                              // of what else may hold it
    };

    void begin(const std::list<SoilBody<dim>> &bodies, const NodalField<dim> &field);
    template <int n>
    void add_impedances(const SoilBody<dim> &body, const ConstCellPoints<dim> &cell);
    void move_column(const unsigned int face, const unsigned int first, const double time_step);
    unsigned int place_on(const unsigned int face, const CellPlace<dim> &node) const;

    const BackgroundGrid<dim> &grid;
    Constraints<dim> &constraints;
    const BodyForces<dim> &forcing;
    const std::uint8_t faces;                          // that absorb, bit f: face f
    CellPlace<dim> n_nodes;                            // along the axes of the box
    std::array<unsigned int, 2 * dim + 1> first_place; // of each face
    std::vector<WallNode> wall_nodes;
    std::vector<dealii::Tensor<1, dim>> velocity, force; // of the free field in the step, by place
    dealii::Tensor<1, dim> base_velocity;                // of the wave from below in the step, m/s
  };
} // namespace scree

#endif
