// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/points/contact_dofs.h>
#include <scree/contact/node_contact.h>
#include <scree/tensor/vector.h>


namespace scree
{
  using namespace dealii;

  template <int dim>
  void stop_at_walls(const NodeConstraints<dim> &walls,
                     const double inverse_mass,
                     Tensor<1, dim> &velocity,
                     Budget<dim> &balance)
  {
    for (const NodeConstraint<dim> &wall : walls.soil)
      if (const double speed = velocity * wall.normal; wall.type == NodeConstraint<dim>::Type::unilateral && speed < 0.)
        {
          const Tensor<1, dim> change = -speed * wall.normal;
          velocity += change;
          balance.wall_impulse += change / inverse_mass;
          balance.soil_walls.add(walls.soil_faces, change / inverse_mass);
        }
  }


  template <int dim>
  ContactDofs<dim>::ContactDofs(const BackgroundGrid<dim> &grid, const Constraints<dim> &constraints)
      : grid(grid)
      , constraints(constraints)
  {
    reinit();
  }


  template <int dim>
  void ContactDofs<dim>::reinit()
  {
    nodes.clear();
    number_of_node.assign(grid.numbering().n_local(), free);
  }


  template <int dim>
  void ContactDofs<dim>::begin()
  {
    for (const Node &node : nodes)
      number_of_node[node.node] = free;
    nodes.clear();
    motions.clear();
    mobilities.clear();
  }


  template <int dim>
  void ContactDofs<dim>::append(const unsigned int node, const NodalField<dim> &field)
  {
    number_of_node[node] = nodes.size();
    const double *values = field[node];
    const double mass    = values[NodalField<dim>::mass];
    NodeRow motion{}, mobility{};
    Tensor<1, dim> velocity;
    if (mass > 0.)
      {
        velocity       = vector_of<dim>(values + NodalField<dim>::velocity);
        motion         = to_row<dim>(velocity);
        motion[beside] = 1.;
        mobility       = NodeRow{} + 1. / mass;
      }
    bool is_held = false;
    if (const NodeConstraints<dim> *walls = constraints.at(node))
      {
        const ConstrainedDirections<dim> held = held_by_walls(*walls, velocity);
        is_held                               = held.any();
        for (unsigned int a = 0; a < dim; ++a)
          mobility[a] *= held.free_part(Point<dim>::unit_vector(a))[a];
      }
    nodes.push_back({ node, is_held, 0, velocity });
    motions.push_back(motion);
    mobilities.push_back(mobility);
  }


  template <int dim>
  ConstrainedDirections<dim> ContactDofs<dim>::held_by_walls(const NodeConstraints<dim> &walls,
                                                             const Tensor<1, dim> &velocity)
  {
    ConstrainedDirections<dim> held = walls.soil_constraint;
    // A wall that the step has found the soil to push on bears what the bed adds.
    constexpr double rounding = 1e-12;
    for (const NodeConstraint<dim> &wall : walls.soil)
      if (wall.type == NodeConstraint<dim>::Type::unilateral && velocity * wall.normal <= rounding * velocity.norm())
        held.hold(wall.normal);
    return held;
  }


  template <int dim>
  void ContactDofs<dim>::write(NodalField<dim> &field, Budget<dim> &balance)
  {
    Budget<dim> of_ghosts;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (mobilities[k][beside] > 0.)
        {
          const unsigned int node = nodes[k].node;
          Tensor<1, dim> velocity = to_vector<dim>(motions[k]);
          if (const NodeConstraints<dim> *walls = constraints.at(node))
            stop_at_walls(*walls, mobilities[k][beside], velocity, node < grid.n_owned_nodes() ? balance : of_ghosts);
          double *values = field[node];
          for (unsigned int c = 0; c < dim; ++c)
            {
              values[NodalField<dim>::velocity_change + c] += velocity[c] - values[NodalField<dim>::velocity + c];
              values[NodalField<dim>::velocity + c] = velocity[c];
            }
        }
  }


  template <int dim>
  void ContactDofs<dim>::take_working_velocities(const NodalField<dim> &field)
  {
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (mobilities[k][beside] > 0.)
        {
          const double *values         = field[nodes[k].node];
          const Tensor<1, dim> after   = vector_of<dim>(values + NodalField<dim>::velocity);
          const Tensor<1, dim> working = working_velocity(
              after, vector_of<dim>(values + NodalField<dim>::velocity_change), after - nodes[k].before);
          for (unsigned int c = 0; c < dim; ++c)
            motions[k][c] = working[c];
        }
  }

  template void stop_at_walls(const NodeConstraints<2> &, const double, Tensor<1, 2> &, Budget<2> &);
  template void stop_at_walls(const NodeConstraints<3> &, const double, Tensor<1, 3> &, Budget<3> &);
  template class ContactDofs<2>;
  template class ContactDofs<3>;
} // namespace scree
