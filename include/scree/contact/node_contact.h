// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_node_contact_h
#define scree_contact_node_contact_h

#include <scree/boundary/node_constraint.h>
#include <scree/step/step_report.h>

#include <algorithm>

namespace scree
{
  /// What one of two fields of velocity has at a node.
  template <int dim>
  struct MovingMass
  {
    double inverse_mass;             ///< 1/kg; 0: nothing moves it
    dealii::Tensor<1, dim> velocity; ///< m/s
  };

  /// The impulse, N s, that the second mass gets and the first one gives in contact: none along the normal unless they
  /// approach each other too fast, then what leaves them the approach that is allowed; along the surface Coulomb's law.
  ///
  /// @param normal unit, from the first to the second
  /// @param approach largest velocity, m/s, at which they may close the gap between them
  template <int dim>
  dealii::Tensor<1, dim> contact_impulse(const MovingMass<dim> &first,
                                         const MovingMass<dim> &second,
                                         const dealii::Tensor<1, dim> &normal,
                                         const double approach,
                                         const double friction_coefficient)
  {
    const dealii::Tensor<1, dim> relative = second.velocity - first.velocity;
    const double inverse_mass             = first.inverse_mass + second.inverse_mass;
    const double across                   = relative * normal;
    if (inverse_mass == 0. || across >= -approach)
      return dealii::Tensor<1, dim>();
    const double pressing              = (-approach - across) / inverse_mass;
    const dealii::Tensor<1, dim> along = relative - across * normal;
    return pressing * normal +
           coulomb_friction<dim>(-along / inverse_mass, available_friction(friction_coefficient, pressing)).impulse;
  }


  /// The velocity, m/s, with which an impulse that contact gives a node in a step does work.
  ///
  /// Forces do work with the velocity of the step's end, so that a node gains -m dv^2/2 beside the work of all impulses
  /// with that velocity. The part of this along the contact's impulse is what the contact takes by stopping the node.
  ///
  /// @param after at the end of the step, m/s
  /// @param change dv over the whole step, m/s
  /// @param own_change of this by the contact, m/s
  template <int dim>
  dealii::Tensor<1, dim> working_velocity(const dealii::Tensor<1, dim> &after,
                                          const dealii::Tensor<1, dim> &change,
                                          const dealii::Tensor<1, dim> &own_change)
  {
    const double square = own_change.norm_square();
    if (square == 0.)
      return after;
    const double share = change * own_change / square; // more than 1 in size: other forces pushed the same way
    return after - 0.5 * share * std::clamp(share, -1., 1.) * own_change;
  }


  /// Stops what moves into walls that it could lift off from.
  /// @param inverse_mass 1/kg, above 0
  template <int dim>
  void stop_at_walls(const NodeConstraints<dim> &walls,
                     const double inverse_mass,
                     dealii::Tensor<1, dim> &velocity,
                     Budget<dim> &balance)
  {
    for (const NodeConstraint<dim> &wall : walls.soil)
      if (const double speed = velocity * wall.normal; wall.type == NodeConstraint<dim>::Type::unilateral && speed < 0.)
        {
          const dealii::Tensor<1, dim> change = -speed * wall.normal;
          velocity += change;
          balance.wall_impulse += change / inverse_mass;
          balance.soil_walls.add(walls.soil_faces, change / inverse_mass);
        }
  }
} // namespace scree

#endif
