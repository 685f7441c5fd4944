// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/momentum/wall_friction.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    bool is_unilateral(const NodeConstraint<dim> &constraint)
    {
      return constraint.type == NodeConstraint<dim>::Type::unilateral;
    }
  } // namespace


  template <int dim>
  WallFriction<dim>::WallFriction(const Constraints<dim> &constraints)
      : constraints(constraints)
  {
  }


  template <int dim>
  void WallFriction<dim>::reinit(const unsigned int n_owned_nodes)
  {
    contacts.assign(constraints.has_unilateral() ? n_owned_nodes : 0, Contact());
  }


  template <int dim>
  void WallFriction<dim>::clear()
  {
    std::fill(contacts.begin(), contacts.end(), Contact());
  }


  template <int dim>
  ConstrainedDirections<dim> WallFriction<dim>::held(const unsigned int node) const
  {
    ConstrainedDirections<dim> result;
    const NodeConstraints<dim> *walls = constraints.at(node);
    if (walls == nullptr)
      return result;
    result = walls->soil_constraint;
    if (contacts.empty() || !contacts[node].any())
      return result;
    if (contacts[node].sticks)
      result.hold_all();
    for (unsigned int i = 0; i < walls->soil.size(); ++i)
      if ((contacts[node].pushing >> i) & 1)
        result.hold(walls->soil[i].normal);
    return result;
  }


  template <int dim>
  bool WallFriction<dim>::find_contact(const unsigned int node, const Tensor<1, dim> &velocity)
  {
    const NodeConstraints<dim> *walls = contacts.empty() ? nullptr : constraints.at(node);
    if (walls == nullptr)
      return false;
    for (unsigned int i = 0; i < walls->soil.size(); ++i)
      if (is_unilateral(walls->soil[i]) && velocity * walls->soil[i].normal < 0.)
        contacts[node].pushing |= 1u << i;
    return contacts[node].any();
  }


  template <int dim>
  double WallFriction<dim>::bound(const unsigned int node, const Tensor<1, dim> &reaction) const
  {
    double result = 0;
    for (const NodeConstraint<dim> &wall : constraints.at(node)->soil)
      if (is_unilateral(wall))
        result += wall.friction_coefficient * std::max(0., reaction * wall.normal);
    return result;
  }


  template <int dim>
  Tensor<1, dim>
  WallFriction<dim>::resist(const unsigned int node, const DragBlock<dim> &pair, const SoilAndWater<dim> &impulses)
  {
    // A wall that holds the soil altogether: what it needs along itself is what sticking takes.
    DragBlock<dim> stuck = pair;
    stuck.held_soil.hold_all();
    const Tensor<1, dim> wall = stuck.reactions(impulses, stuck.solve(impulses)).soil;
    Contact &contact          = contacts[node];
    ConstrainedDirections<dim> normals;
    for (unsigned int i = 0; i < constraints.at(node)->soil.size(); ++i)
      if ((contact.pushing >> i) & 1)
        normals.hold(constraints.at(node)->soil[i].normal);
    contact.reaction = normals.held_part(wall);

    const auto friction = coulomb_friction(pair.held_soil.free_part(wall), bound(node, contact.reaction));
    contact.sticks      = friction.sticks;
    if (!friction.sticks)
      contact.resistance = friction.impulse;
    return contact.resistance;
  }


  template <int dim>
  Tensor<1, dim> WallFriction<dim>::adjust(const unsigned int node,
                                           const Tensor<1, dim> &reaction_change,
                                           const double mass,
                                           const Tensor<1, dim> &velocity) const
  {
    const double speed = velocity.norm(); // along the wall: the rest is stopped
    if (contacts.empty() || !contacts[node].any() || speed == 0.)
      return Tensor<1, dim>();
    const double change = bound(node, contacts[node].reaction + reaction_change) - contacts[node].resistance.norm();
    return -std::min(change, mass * speed) / speed * velocity; // friction does not turn the motion round
  }

  template class WallFriction<2>;
  template class WallFriction<3>;
} // namespace scree
