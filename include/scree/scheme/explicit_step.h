// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_explicit_step_h
#define scree_scheme_explicit_step_h

#include <scree/grid/constraints.h>
#include <scree/grid/nodal_field.h>
#include <scree/scheme/forcing.h>
#include <scree/scheme/step_balance.h>
#include <scree/scheme/wall_gaps.h>

namespace scree
{
  /// The explicit step of one phase at the nodes: momentum and force in, velocity and its change out.
  template <int dim>
  class ExplicitStep
  {
  public:
    ExplicitStep(const Constraints<dim> &constraints, const WallGaps<dim> &wall_gaps, const Forcing<dim> &forcing);

    /// v = (momentum + dt force)/mass + dt acceleration at the active nodes, then their constraints.
    StepBalance<dim> solve(NodalField<dim> &field, const double time_step) const;

  private:
    const Constraints<dim> &constraints;
    const WallGaps<dim> &wall_gaps;
    const Forcing<dim> &forcing;
  };
} // namespace scree

#endif
