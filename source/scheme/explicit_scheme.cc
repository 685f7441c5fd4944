// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/points/region.h>
#include <scree/scheme/explicit_scheme.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  void BodyForceParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Body force",
                      expression,
                      "Acceleration beside gravity, m/s^2: an expression of x, y (z) and t an axis, separated by "
                      "semicolons; empty: none. For verification.",
                      Patterns::Anything());
  }


  void BodyForceParameters::check(const unsigned int dim) const
  {
    if (!expression.empty() && dim == 2)
      parse_expression<2>(entry_name("", "Body force"), expression, 2, true);
    if (!expression.empty() && dim == 3)
      parse_expression<3>(entry_name("", "Body force"), expression, 3, true);
  }


  template <int dim>
  ExplicitScheme<dim>::ExplicitScheme(const BackgroundGrid<dim> &grid,
                                      const BoundaryConditions<dim> &walls,
                                      const std::vector<double> &gravity,
                                      const BodyForceParameters &body_force)
      : grid(grid)
      , walls(walls)
      , acceleration(make_array_view(gravity))
  {
    if (!body_force.expression.empty())
      this->body_force = parse_expression<dim>(entry_name("", "Body force"), body_force.expression, dim, true);
  }


  template <int dim>
  void ExplicitScheme<dim>::start_settling(const double rate, std::vector<char> held)
  {
    damping_rate = rate;
    this->held   = std::move(held);
  }


  template <int dim>
  void ExplicitScheme<dim>::release()
  {
    damping_rate = 0;
    held.clear();
  }


  template <int dim>
  StepBalance<dim> ExplicitScheme<dim>::solve(NodalField<dim> &field, const double time, const double time_step) const
  {
    StepBalance<dim> balance;
    const double decay = std::exp(-damping_rate * time_step);
    if (body_force)
      body_force->set_time(time);

    for (const unsigned int node : field.active_nodes())
      {
        double *values    = field[node];
        const double mass = values[NodalField<dim>::mass];
        if (mass <= 0.)
          continue; // Another rank sees this node, but no point acts on it.

        Tensor<1, dim> before, push = acceleration;
        if (body_force)
          for (unsigned int c = 0; c < dim; ++c)
            push[c] += body_force->value(grid.node_position(node), c);
        Tensor<1, dim> after;
        for (unsigned int c = 0; c < dim; ++c)
          {
            before[c] = values[NodalField<dim>::momentum + c] / mass;
            after[c]  = before[c] + time_step * (values[NodalField<dim>::force + c] / mass + push[c]);
          }
        balance.body_impulse += mass * time_step * push;

        if (damping_rate > 0.)
          {
            balance.wall_impulse -= mass * (1. - decay) * after;
            after *= decay;
          }

        const auto faces = grid.node_faces(node);
        const bool stays = !held.empty() && held[node];
        if (faces != 0 || stays)
          {
            const Tensor<1, dim> free = after;
            if (stays)
              after = 0.;
            else
              walls.apply(after, faces);
            const Tensor<1, dim> impulse = mass * (after - free);
            balance.wall_impulse += impulse;
            // The work of an impulse is its product with the mean velocity: a reaction at rest does none.
            balance.wall_dissipation -= impulse * (0.5 * (before + after));
          }

        for (unsigned int c = 0; c < dim; ++c)
          {
            values[NodalField<dim>::velocity + c]        = after[c];
            values[NodalField<dim>::velocity_change + c] = after[c] - before[c];
          }
      }
    return balance;
  }

  template class ExplicitScheme<2>;
  template class ExplicitScheme<3>;
} // namespace scree
