// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/wall_friction.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The component of a vector that points from a face into the box.
    template <int dim>
    double inward(const Tensor<1, dim> &vector, const unsigned int face)
    {
      return face % 2 == 0 ? vector[face / 2] : -vector[face / 2];
    }
  } // namespace


  template <int dim>
  WallFriction<dim>::WallFriction(const BackgroundGrid<dim> &grid, const BoundaryConditions<dim> &walls)
      : grid(grid)
      , walls(walls)
  {
    reinit();
  }


  template <int dim>
  void WallFriction<dim>::reinit()
  {
    const bool any = std::any_of(
        walls.walls().begin(), walls.walls().end(), [](const Wall &wall) { return wall.type == WallType::friction; });
    contacts.assign(any ? grid.n_owned_nodes() : 0, 0);
    reactions.assign(contacts.size(), Tensor<1, dim>());
  }


  template <int dim>
  void WallFriction<dim>::clear()
  {
    std::fill(contacts.begin(), contacts.end(), 0);
  }


  template <int dim>
  bool WallFriction<dim>::find_contact(const unsigned int node, const Tensor<1, dim> &velocity)
  {
    if (contacts.empty())
      return false;
    const std::uint8_t faces = walls.friction_faces(grid.node_faces(node));
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if (((faces >> f) & 1) && inward(velocity, f) < 0.)
        contacts[node] |= 1 << (f / 2);
    reactions[node] = 0.;
    return contacts[node] != 0;
  }


  template <int dim>
  void WallFriction<dim>::add_reaction(const unsigned int node, const Tensor<1, dim> &impulse)
  {
    if (!contacts.empty())
      reactions[node] += impulse;
  }


  template <int dim>
  Tensor<1, dim> WallFriction<dim>::slow_down(const unsigned int node,
                                              const double mass,
                                              const Tensor<1, dim> &before,
                                              const Tensor<1, dim> &velocity,
                                              StepBalance<dim> &balance) const
  {
    if (stopped_components(node) == 0)
      return Tensor<1, dim>();
    const std::uint8_t faces = walls.friction_faces(grid.node_faces(node));
    double bound             = 0; // Coulomb's, of the tangential impulse, N s
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1)
        bound += walls.walls()[f].friction_coefficient * std::max(0., inward(reactions[node], f));
    const double momentum = mass * velocity.norm();
    if (momentum == 0.)
      return Tensor<1, dim>();
    const Tensor<1, dim> change = -std::min(1., bound / momentum) * velocity;
    balance.wall_impulse += mass * change;
    balance.wall_dissipation -= 0.5 * mass * change * (before + velocity + change);
    return change;
  }

  template class WallFriction<2>;
  template class WallFriction<3>;
} // namespace scree
