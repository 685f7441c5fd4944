// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_lost_points_h
#define scree_run_lost_points_h

#include <scree/model/scene.h>

namespace scree
{
  /// Adds what left the box through open walls to `totals`, and clears it. Throws if a point left through a closed
  /// one.
  /// @param time s, for the message
  template <int dim>
  void account_for_lost_points(Scene<dim> &scene, RunTotals<dim> &totals, const double time);
} // namespace scree

#endif
