// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/contact_nodes.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/mpi.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void stop_at_walls(const NodeConstraints<dim> &walls,
                     const double inverse_mass,
                     Tensor<1, dim> &velocity,
                     StepBalance<dim> &balance)
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
  ContactNodes<dim>::ContactNodes(const BackgroundGrid<dim> &grid, const Constraints<dim> &constraints)
      : grid(grid)
      , constraints(constraints)
      , is_parallel(Utilities::MPI::n_mpi_processes(grid.triangulation().get_communicator()) > 1)
      , messages(grid.numbering())
  {
    reinit();
  }


  template <int dim>
  void ContactNodes<dim>::reinit()
  {
    messages.reinit();
    messages.clear();
    shared_owned = messages.active_nodes();
    nodes.clear();
    number_of_node.assign(grid.numbering().n_local(), free);
    shared.assign(grid.n_owned_nodes(), false);
    shared.resize(grid.numbering().n_local(), true);
    for (const unsigned int node : shared_owned)
      shared[node] = true;
  }


  template <int dim>
  void ContactNodes<dim>::begin(const NodalField<dim> &field)
  {
    for (const Node &node : nodes)
      number_of_node[node.node] = free;
    nodes.clear();
    held_directions.clear();
    for (const unsigned int node : shared_owned)
      if (field[node][NodalField<dim>::mass] > 0.)
        add(node, field);
  }


  template <int dim>
  unsigned int ContactNodes<dim>::add(const unsigned int node, const NodalField<dim> &field)
  {
    if (number_of_node[node] != free)
      return number_of_node[node];
    number_of_node[node]          = nodes.size();
    const double *values          = field[node];
    const double mass             = values[NodalField<dim>::mass];
    const Tensor<1, dim> velocity = mass > 0. ? vector_of<dim>(values + NodalField<dim>::velocity) : Tensor<1, dim>();
    nodes.push_back({ node, mass > 0. ? 1. / mass : 0., velocity, velocity, free });
    find_walls(nodes.back());
    return number_of_node[node];
  }


  template <int dim>
  void ContactNodes<dim>::find_walls(Node &node)
  {
    const NodeConstraints<dim> *walls = constraints.at(node.node);
    if (walls == nullptr)
      return;
    HeldDirections<dim> held = walls->soil_held;
    // A wall that the step has found the soil to push on bears what the bed adds.
    constexpr double rounding = 1e-12;
    for (const NodeConstraint<dim> &wall : walls->soil)
      if (wall.type == NodeConstraint<dim>::Type::unilateral &&
          node.velocity * wall.normal <= rounding * node.velocity.norm())
        held.hold(wall.normal);
    if (!held.any())
      return;
    node.held = held_directions.size();
    held_directions.push_back(held);
  }


  template <int dim>
  void ContactNodes<dim>::exchange()
  {
    if (!is_parallel)
      return;
    const unsigned int n_owned = grid.n_owned_nodes();
    for (const Node &node : nodes)
      if (node.node >= n_owned)
        for (unsigned int c = 0; c < dim; ++c)
          messages[node.node][c] = node.velocity[c] - node.known[c];
    messages.add_contributions();
    for (const unsigned int shared_node : shared_owned)
      if (const unsigned int number = number_of_node[shared_node]; number != free)
        {
          Node &node = nodes[number];
          node.velocity += vector_of<dim>(messages[shared_node]);
          node.known = node.velocity;
          for (unsigned int c = 0; c < dim; ++c)
            messages[shared_node][c] = node.velocity[c];
        }
    messages.update_ghosts();
    for (Node &node : nodes)
      if (node.node >= n_owned)
        node.velocity = node.known = vector_of<dim>(messages[node.node]);
    messages.clear();
  }


  template <int dim>
  void ContactNodes<dim>::write(NodalField<dim> &field, StepBalance<dim> &balance)
  {
    for (Node &node : nodes)
      if (node.node < grid.n_owned_nodes())
        {
          if (const NodeConstraints<dim> *walls = constraints.at(node.node); walls != nullptr && node.inverse_mass > 0.)
            stop_at_walls(*walls, node.inverse_mass, node.velocity, balance);
          double *values = field[node.node];
          for (unsigned int c = 0; c < dim && node.inverse_mass > 0.; ++c)
            {
              values[NodalField<dim>::velocity_change + c] += node.velocity[c] - values[NodalField<dim>::velocity + c];
              values[NodalField<dim>::velocity + c] = node.velocity[c];
            }
        }
    field.update_ghosts();
  }

  template void stop_at_walls(const NodeConstraints<2> &, const double, Tensor<1, 2> &, StepBalance<2> &);
  template void stop_at_walls(const NodeConstraints<3> &, const double, Tensor<1, 3> &, StepBalance<3> &);
  template class ContactNodes<2>;
  template class ContactNodes<3>;
} // namespace scree
