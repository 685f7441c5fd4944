// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/momentum/explicit_update.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  ExplicitUpdate<dim>::ExplicitUpdate(const Constraints<dim> &constraints,
                                      const WallGaps<dim> &wall_gaps,
                                      const BodyForces<dim> &forcing)
      : constraints(constraints)
      , wall_gaps(wall_gaps)
      , forcing(forcing)
  {
  }


  template <int dim>
  Budget<dim> ExplicitUpdate<dim>::solve(NodalField<dim> &field, const double time_step) const
  {
    Budget<dim> balance;
    const double decay = forcing.decay(time_step);

    for (const unsigned int node : field.active_nodes())
      {
        double *values    = field[node];
        const double mass = values[NodalField<dim>::mass];
        if (mass <= 0.)
          continue; // Another rank sees this node, but no point acts on it.

        const Tensor<1, dim> push = forcing.acceleration(node);
        Tensor<1, dim> before, after;
        for (unsigned int c = 0; c < dim; ++c)
          {
            before[c] = values[NodalField<dim>::momentum + c] / mass;
            after[c]  = before[c] + time_step * (values[NodalField<dim>::force + c] / mass + push[c]);
          }
        balance.body_impulse += mass * time_step * push;

        if (forcing.is_damped())
          {
            balance.wall_impulse -= mass * (1. - decay) * after;
            after *= decay;
          }

        Tensor<1, dim> mean = 0.5 * (before + after);
        if (const NodeConstraints<dim> *walls = constraints.at(node))
          {
            const Tensor<1, dim> free                = after;
            const Tensor<1, dim> wall_velocity       = walls->soil_velocity + wall_gaps.closing_velocity(node);
            const ConstrainedDirections<dim> stopped = walls->apply(after, wall_velocity);
            const Tensor<1, dim> impulse             = mass * (after - free);
            balance.wall_impulse += impulse;
            balance.soil_walls.add(walls->soil_faces, impulse);
            // Forces do work with the velocity of the step's end, and so none on what is stopped.
            mean = stopped.held_part(wall_velocity) + stopped.free_part(0.5 * (before + after));
            balance.wall_dissipation +=
                0.5 * mass * stopped.held_part(before - wall_velocity).norm_square() - impulse * mean;
          }
        balance.load_work += time_step * mass * (push - forcing.fall()) * mean;

        for (unsigned int c = 0; c < dim; ++c)
          {
            values[NodalField<dim>::velocity + c]        = after[c];
            values[NodalField<dim>::velocity_change + c] = after[c] - before[c];
          }
      }
    return balance;
  }

  template class ExplicitUpdate<2>;
  template class ExplicitUpdate<3>;
} // namespace scree
