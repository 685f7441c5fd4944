// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/contact_nodes.h>
#include <scree/scheme/node_contact.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

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
    motions.clear();
    mobilities.clear();
    for (const unsigned int node : shared_owned)
      if (field[node][NodalField<dim>::mass] > 0.)
        add(node, field);
  }


  template <int dim>
  void ContactNodes<dim>::append(const unsigned int node, const NodalField<dim> &field)
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
        const HeldDirections<dim> held = held_by_walls(*walls, velocity);
        is_held                        = held.any();
        for (unsigned int a = 0; a < dim; ++a)
          mobility[a] *= held.free_part(Point<dim>::unit_vector(a))[a];
      }
    nodes.push_back({ node, is_held, velocity, velocity });
    motions.push_back(motion);
    mobilities.push_back(mobility);
  }


  template <int dim>
  HeldDirections<dim> ContactNodes<dim>::held_by_walls(const NodeConstraints<dim> &walls,
                                                       const Tensor<1, dim> &velocity)
  {
    HeldDirections<dim> held = walls.soil_held;
    // A wall that the step has found the soil to push on bears what the bed adds.
    constexpr double rounding = 1e-12;
    for (const NodeConstraint<dim> &wall : walls.soil)
      if (wall.type == NodeConstraint<dim>::Type::unilateral && velocity * wall.normal <= rounding * velocity.norm())
        held.hold(wall.normal);
    return held;
  }


  template <int dim>
  void ContactNodes<dim>::exchange()
  {
    if (!is_parallel)
      return;
    const unsigned int n_owned = grid.n_owned_nodes();
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (nodes[k].node >= n_owned)
        for (unsigned int c = 0; c < dim; ++c)
          messages[nodes[k].node][c] = motions[k][c] - nodes[k].known[c];
    messages.add_contributions();
    for (const unsigned int node : shared_owned)
      if (const unsigned int number = number_of_node[node]; number != free)
        for (unsigned int c = 0; c < dim; ++c)
          messages[node][c] = nodes[number].known[c] = motions[number][c] += messages[node][c];
    messages.update_ghosts();
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (nodes[k].node >= n_owned)
        for (unsigned int c = 0; c < dim; ++c)
          motions[k][c] = nodes[k].known[c] = messages[nodes[k].node][c];
    messages.clear();
  }


  template <int dim>
  void ContactNodes<dim>::write(NodalField<dim> &field, StepBalance<dim> &balance)
  {
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (const unsigned int node = nodes[k].node; node < grid.n_owned_nodes() && mobilities[k][beside] > 0.)
        {
          Tensor<1, dim> velocity = to_vector<dim>(motions[k]);
          if (const NodeConstraints<dim> *walls = constraints.at(node))
            stop_at_walls(*walls, mobilities[k][beside], velocity, balance);
          double *values = field[node];
          for (unsigned int c = 0; c < dim; ++c)
            {
              values[NodalField<dim>::velocity_change + c] += velocity[c] - values[NodalField<dim>::velocity + c];
              values[NodalField<dim>::velocity + c] = velocity[c];
            }
        }
    field.update_ghosts();
  }


  template <int dim>
  void ContactNodes<dim>::take_working_velocities(const NodalField<dim> &field)
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

  template void stop_at_walls(const NodeConstraints<2> &, const double, Tensor<1, 2> &, StepBalance<2> &);
  template void stop_at_walls(const NodeConstraints<3> &, const double, Tensor<1, 3> &, StepBalance<3> &);
  template class ContactNodes<2>;
  template class ContactNodes<3>;
} // namespace scree
