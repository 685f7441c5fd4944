// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_explicit_update_h
#define scree_momentum_explicit_update_h

#include <scree/boundary/constraints.h>
#include <scree/mesh/node_values.h>
#include <scree/boundary/body_forces.h>
#include <scree/step/step_report.h>
#include <scree/boundary/wall_gaps.h>

namespace scree
{
  /// The explicit step of one phase at the nodes (@source{sulsky1994}): momentum and force in, velocity and its change
  /// out.
  template <int dim>
  class ExplicitUpdate
  {
  public:
    /// Keeps references to all of them.
    ExplicitUpdate(const Constraints<dim> &constraints, const WallGaps<dim> &wall_gaps, const BodyForces<dim> &forcing);

    /// v = (momentum + dt force)/mass + dt acceleration at the active nodes, then their constraints.
    Budget<dim> solve(NodalField<dim> &field, const double time_step) const;

  private:
    const Constraints<dim> &constraints;
    const WallGaps<dim> &wall_gaps;
    const BodyForces<dim> &forcing;
  };
} // namespace scree

#endif
