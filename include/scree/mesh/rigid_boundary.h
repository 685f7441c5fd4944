// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_rigid_boundary_h
#define scree_mesh_rigid_boundary_h

#include <scree/mesh/discrete_level_set.h>

#include <vector>

namespace scree
{
  /// A part of rigid ground. What it refers to must live on.
  template <int dim>
  struct GroundPart
  {
    const DiscreteLevelSet<dim> *samples;             ///< its surface, sampled on the mesh
    const dealii::Tensor<1, dim> *velocity = nullptr; ///< in the current step, m/s; null if it never moves
  };

  /// Rigid ground as the mesh sees it: all that is at rest as one part, and each part that moves. What is inside any of
  /// them is inside.
  template <int dim>
  class RigidBoundary
  {
  public:
    /// @param parts at least one
    explicit RigidBoundary(const std::vector<GroundPart<dim>> &parts);

    /// The parts in the order of the constructor's.
    const std::vector<GroundPart<dim>> &parts() const
    {
      return all_parts;
    }

    /// Whether any part may move.
    bool moves() const
    {
      return any_moves;
    }

    /// Whether a part that may move is near a cell.
    bool moves_near(const unsigned int cell) const;

    /// Number of parts that are near a cell.
    unsigned int n_near(const unsigned int cell) const;

    /// As DiscreteLevelSet: the least of all parts'.
    double least_distance(const unsigned int cell) const;

    /// The part that is nearest to a place (from 0 to 1) in a cell that is near one, or deepest around it.
    unsigned int nearest_part(const unsigned int cell, const dealii::Point<dim> &place) const;

    /// As DiscreteLevelSet, of the nearest part.
    SurfaceView<dim> view(const unsigned int cell, const dealii::Point<dim> &place) const;

    /// As DiscreteLevelSet, from a cell that is near a part.
    Batch distances(const unsigned int cell, const std::array<Batch, dim> &places) const;

  private:
    const std::vector<GroundPart<dim>> all_parts;
    const bool any_moves;
  };
} // namespace scree

#endif
