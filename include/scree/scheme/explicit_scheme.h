// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_explicit_scheme_h
#define scree_scheme_explicit_scheme_h

#include <scree/grid/boundary_conditions.h>
#include <scree/grid/nodal_field.h>
#include <scree/scheme/step_balance.h>

#include <deal.II/base/function.h>
#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace scree
{
  /// Entry Body force: an acceleration beside gravity, for verification.
  struct BodyForceParameters
  {
    std::string expression; ///< m/s^2, of x, y (z) and t, one an axis; empty: none

    void add_parameters(dealii::ParameterHandler &prm);
    void check(const unsigned int dim) const;
  };

  /// The explicit step of one phase at the nodes: momentum and force in, velocity and its change out.
  template <int dim>
  class ExplicitScheme
  {
  public:
    ExplicitScheme(const BackgroundGrid<dim> &grid,
                   const BoundaryConditions<dim> &walls,
                   const std::vector<double> &gravity,
                   const BodyForceParameters &body_force);

    /// Damped settling: velocity decays at `rate`, 1/s, and nodes with `held[node]` do not move.
    void start_settling(const double rate, std::vector<char> held);

    /// Ends the settling: nothing is held or damped from here on.
    void release();

    /// v = (momentum + dt force)/mass + dt gravity at the active nodes, then the walls.
    StepBalance<dim> solve(NodalField<dim> &field, const double time, const double time_step) const;

    const dealii::Tensor<1, dim> &gravity() const
    {
      return acceleration;
    }

  private:
    const BackgroundGrid<dim> &grid;
    const BoundaryConditions<dim> &walls;
    dealii::Tensor<1, dim> acceleration;
    std::unique_ptr<dealii::Function<dim>> body_force;
    double damping_rate = 0;
    std::vector<char> held;
  };
} // namespace scree

#endif
