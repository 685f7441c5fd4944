// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_cut_cells_clamp_to_box_h
#define scree_contact_cut_cells_clamp_to_box_h

#include <scree/mesh/background_grid.h>
#include <scree/mesh/discrete_level_set.h>
#include <scree/particles/point_set.h>

namespace scree
{
  /// Puts points that have passed a closed face of the box by less than a tenth of a cell back to it. No velocity of
  /// the nodes carries a point through a wall within a stable step, but that of water in pores may be a multiple of
  /// theirs (PoreVelocity). What is farther out stays there, as a sign of a step that is not stable.
  ///
  /// @param closed_faces bit f: face f, as in BackgroundGrid::node_faces()
  template <int dim>
  void clamp_to_box(const BackgroundGrid<dim> &grid, const std::uint8_t closed_faces, PointSet<dim> &points);

  /// Moves a place that is `depth`, m, below ground with this `normal` out of it, and along the closed faces of the box
  /// that it would leave through. Where there is no room between ground and a face, it stays at the face.
  template <int dim>
  void move_out_of_ground(const BackgroundGrid<dim> &grid,
                          const std::uint8_t closed_faces,
                          const dealii::Tensor<1, dim> &normal,
                          double depth,
                          dealii::Point<dim> &place);

  /// Does so with the points that have come below the ground. None has moved farther than `farthest`, m.
  template <int dim>
  void move_out_of_ground(const BackgroundGrid<dim> &grid,
                          const RigidBoundary<dim> &ground,
                          const double farthest,
                          const std::uint8_t closed_faces,
                          PointSet<dim> &points);
} // namespace scree

#endif
