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
    resistances = reactions;
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
    resistances[node] = 0.;
    return contacts[node] != 0;
  }


  template <int dim>
  double WallFriction<dim>::bound(const unsigned int node, const Tensor<1, dim> &reaction) const
  {
    const std::uint8_t faces = walls.friction_faces(grid.node_faces(node));
    double result            = 0;
    for (unsigned int f = 0; f < 2 * dim; ++f)
      if ((faces >> f) & 1)
        result += walls.walls()[f].friction_coefficient * std::max(0., inward(reaction, f));
    return result;
  }


  template <int dim>
  Tensor<1, dim> WallFriction<dim>::resist(const unsigned int node,
                                           const DragPair<dim> &pair,
                                           const Tensor<1, dim> &soil_impulse,
                                           const Tensor<1, dim> &water_impulse)
  {
    // A wall that holds all components: what it needs along itself is what sticking takes.
    DragPair<dim> stuck = pair;
    stuck.fixed_soil    = (1u << dim) - 1;
    Tensor<1, dim> soil, water, normal, along;
    stuck.solve(soil_impulse, water_impulse, soil, water);
    const Tensor<1, dim> wall = stuck.soil_reaction(soil_impulse, water);
    for (unsigned int c = 0; c < dim; ++c)
      if ((contacts[node] >> c) & 1)
        normal[c] = wall[c];
      else if (((pair.fixed_soil >> c) & 1) == 0)
        along[c] = wall[c];

    reactions[node]        = normal;
    const double available = bound(node, normal), needed = along.norm();
    if (needed < available)
      contacts[node] = stuck.fixed_soil;
    else if (needed > 0.)
      resistances[node] = available / needed * along;
    return resistances[node];
  }


  template <int dim>
  Tensor<1, dim> WallFriction<dim>::adjust(const unsigned int node,
                                           const Tensor<1, dim> &reaction_change,
                                           const double mass,
                                           const Tensor<1, dim> &velocity) const
  {
    const double speed = velocity.norm(); // along the wall: the rest is stopped
    if (stopped_components(node) == 0 || speed == 0.)
      return Tensor<1, dim>();
    const double change = bound(node, reactions[node] + reaction_change) - resistances[node].norm();
    return -std::min(change, mass * speed) / speed * velocity; // friction does not turn the motion round
  }

  template class WallFriction<2>;
  template class WallFriction<3>;
} // namespace scree
