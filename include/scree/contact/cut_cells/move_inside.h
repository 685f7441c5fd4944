// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_cut_cells_move_inside_h
#define scree_contact_cut_cells_move_inside_h

#include <scree/bodies/phases.h>
#include <scree/mesh/background_grid.h>
#include <scree/mesh/discrete_level_set.h>
#include <scree/particles/point_set.h>
#include <scree/step/step_report.h>

#include <functional>

namespace scree
{
  /// Keeps the water's own points a twentieth of their size V^(1/dim) away from closed faces of the box: nearer ones
  /// are put there, and their velocity into the wall goes to the wall. Points of a film on the wall itself would leave
  /// the nodes above it without mass. What is farther out than a tenth of a cell stays there, as a sign of a step that
  /// is not stable.
  ///
  /// @param closed_faces bit f: face f, as in BackgroundGrid::node_faces()
  /// @param mass_scaling of the inertia that the balance counts
  template <int dim>
  void keep_off_walls(const BackgroundGrid<dim> &grid,
                      const std::uint8_t closed_faces,
                      const double mass_scaling,
                      WaterPhase<dim> &water,
                      Budget<dim> &balance);

  /// Called with a point, the part of the ground, and the normal.
  template <int dim>
  using ActOnGround = std::function<
      void(const PointView<dim, double> &point, const unsigned int part, const dealii::Tensor<1, dim> &normal)>;

  /// Moves a place that is `depth`, m, below ground with this `normal` out of it, and along the closed faces of the box
  /// that it would leave through. Where there is no room between ground and a face, it stays at the face.
  template <int dim>
  void move_out_of_ground(const BackgroundGrid<dim> &grid,
                          const std::uint8_t closed_faces,
                          const dealii::Tensor<1, dim> &normal,
                          double depth,
                          dealii::Point<dim> &place);

  /// Does so with the points that have come below the ground, and calls `act(point, part, normal)` for each before: the
  /// nearest part of the ground, and its normal. None has moved farther than `farthest`, m.
  template <int dim>
  void move_out_of_ground(const BackgroundGrid<dim> &grid,
                          const RigidBoundary<dim> &ground,
                          const double farthest,
                          const std::uint8_t closed_faces,
                          PointSet<dim> &points,
                          const ActOnGround<dim> &act);
} // namespace scree

#endif
