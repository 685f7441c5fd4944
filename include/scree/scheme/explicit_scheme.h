// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_explicit_scheme_h
#define scree_scheme_explicit_scheme_h

#include <scree/grid/boundary_conditions.h>
#include <scree/grid/nodal_field.h>
#include <scree/scheme/forcing.h>
#include <scree/scheme/step_balance.h>

namespace scree
{
  /// The explicit step of one phase at the nodes: momentum and force in, velocity and its change out.
  template <int dim>
  class ExplicitScheme
  {
  public:
    ExplicitScheme(const BackgroundGrid<dim> &grid, const BoundaryConditions<dim> &walls, const Forcing<dim> &forcing);

    /// v = (momentum + dt force)/mass + dt acceleration at the active nodes, then the walls.
    StepBalance<dim> solve(NodalField<dim> &field, const double time_step) const;

  private:
    const BackgroundGrid<dim> &grid;
    const BoundaryConditions<dim> &walls;
    const Forcing<dim> &forcing;
  };
} // namespace scree

#endif
