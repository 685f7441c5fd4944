// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_rigid_surface_h
#define scree_contact_rigid_surface_h

#include <scree/boundary/obstacle.h>
#include <scree/mesh/discrete_level_set.h>

namespace scree
{
  /// A rigid surface and how soil rubs on it. What it refers to must live on.
  template <int dim>
  struct RigidSurface
  {
    const DiscreteLevelSet<dim> *samples;    ///< the surface, sampled on the mesh
    double friction_coefficient;             ///< infinite: soil that presses does not slip
    bool no_slip                  = false;   ///< whether free water does not slip
    const Obstacle<dim> *obstacle = nullptr; ///< whose surface it is; null: the bed
    double turbulent_friction     = 0;       ///< xi of TurbulentFriction, m/s^2; 0: none
  };
} // namespace scree

#endif
