// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/cut_cells/traction_solver.h>
#include <scree/contact/node_contact.h>
#include <scree/tensor/vector.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// A block at rest creeps by 0.8e-6 m/s; with 4 by 1.0e-6, with 10 by 1.0e-6.
    constexpr unsigned int n_iterations = 6;

    /// The traction that the ground may have, nearest to `traction`.
    template <int dim>
    Tensor<1, dim> admissible(const GroundRow<dim> &row, const Tensor<1, dim> &traction)
    {
      if (!row.is_unilateral)
        return traction; // It is fixed.
      const double pressing = traction * row.normal;
      if (pressing <= 0.)
        return Tensor<1, dim>();
      return pressing * row.normal +
             coulomb_friction<dim>(row.along(traction), available_friction(row.friction, pressing)).impulse;
    }

    /// The directions along which walls hold a node with this velocity, m/s.
    template <int dim>
    ConstrainedDirections<dim> held_by_walls(const NodeConstraints<dim> &walls, const Tensor<1, dim> &velocity)
    {
      ConstrainedDirections<dim> held = walls.soil_constraint;
      // A wall on which the step has found the soil to press takes what the ground adds.
      constexpr double rounding = 1e-12;
      for (const NodeConstraint<dim> &wall : walls.soil)
        if (wall.type == NodeConstraint<dim>::Type::unilateral && velocity * wall.normal <= rounding * velocity.norm())
          held.hold(wall.normal);
      return held;
    }
  } // namespace


  template <int dim>
  TractionSolver<dim>::TractionSolver(const BackgroundGrid<dim> &grid, const Constraints<dim> &constraints)
      : grid(grid)
      , constraints(constraints)
      , messages(grid.numbering())
  {
    reinit();
  }


  template <int dim>
  void TractionSolver<dim>::add_node(const unsigned int node, const NodalField<dim> &field)
  {
    if (number_of_node[node] != none)
      return;
    number_of_node[node]          = nodes.size();
    const double *values          = field[node];
    const double mass             = values[NodalField<dim>::mass];
    const Tensor<1, dim> velocity = mass > 0. ? vector_of<dim>(values + NodalField<dim>::velocity) : Tensor<1, dim>();
    NodeRow inverse_mass{};
    for (unsigned int a = 0; a < dim && mass > 0.; ++a)
      inverse_mass[a] = 1. / mass;
    if (const NodeConstraints<dim> *walls = constraints.at(node))
      {
        const ConstrainedDirections<dim> held = held_by_walls(*walls, velocity);
        for (unsigned int a = 0; a < dim; ++a)
          inverse_mass[a] *= held.free_part(Point<dim>::unit_vector(a))[a];
      }
    nodes.push_back({ node, velocity });
    inverse_masses.push_back(inverse_mass);
  }


  template <int dim>
  void TractionSolver<dim>::begin(const GroundRows<dim> &rows, const NodalField<dim> &field)
  {
    for (const Node &node : nodes)
      number_of_node[node.node] = none;
    nodes.clear();
    inverse_masses.clear();
    number_of_corner.clear();
    for (unsigned int k = 0; k < rows.all.size(); ++k)
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        {
          const unsigned int node = rows.nodes(k)[i];
          add_node(node, field);
          number_of_corner.push_back(number_of_node[node]);
        }
    std::vector<unsigned int> ghosts;
    for (const Node &node : nodes)
      if (node.node >= grid.n_owned_nodes())
        ghosts.push_back(node.node);
    messages.begin(ghosts);
  }


  template <int dim>
  void TractionSolver<dim>::add_at_owners(const NodalField<dim> *field)
  {
    messages.to_owners(
        dim,
        [this](const unsigned int node, double *numbers) { write_force(node, numbers); },
        [&](const unsigned int node, const double *numbers) {
          if (field != nullptr && number_of_node[node] == none)
            {
              add_node(node, *field);
              forces.push_back(NodeRow{});
            }
          for (unsigned int c = 0; c < dim; ++c)
            forces[number_of_node[node]][c] += numbers[c];
        });
  }


  template <int dim>
  void TractionSolver<dim>::take_from_owners()
  {
    messages.from_owners(
        dim,
        [this](const unsigned int node, double *numbers) { write_force(node, numbers); },
        [this](const unsigned int node, const double *numbers) {
          for (unsigned int c = 0; c < dim; ++c)
            forces[number_of_node[node]][c] = numbers[c];
        });
  }


  template <int dim>
  void
  TractionSolver<dim>::find_steps(const GroundRows<dim> &rows, const NodalField<dim> &field, const double time_step)
  {
    const unsigned int n = grid.n_nodes_per_cell();
    forces.assign(nodes.size(), NodeRow{});
    for (unsigned int k = 0; k < rows.all.size(); ++k)
      for (unsigned int i = 0; i < n; ++i)
        forces[number_of_corner[k * n + i]] += NodeRow{} + rows.weight(k, i);
    add_at_owners(&field);
    take_from_owners();
    steps.resize(rows.all.size());
    for (unsigned int k = 0; k < rows.all.size(); ++k)
      {
        NodeRow response{};
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int node = number_of_corner[k * n + i];
            response += rows.weight(k, i) * forces[node] * inverse_masses[node];
          }
        double largest = 0.;
        for (unsigned int a = 0; a < dim; ++a)
          largest = std::max(largest, response[a]);
        steps[k] = largest > 0. ? 1. / (time_step * largest) : 0.; // 0: walls hold all
      }
  }


  template <int dim>
  void TractionSolver<dim>::find_motions(const GroundRows<dim> &rows,
                                         const typename GroundRows<dim>::Vectors &tractions,
                                         const double time_step,
                                         const bool is_last)
  {
    const unsigned int n = grid.n_nodes_per_cell();
    forces.assign(nodes.size(), NodeRow{});
    for (unsigned int k = 0; k < rows.all.size(); ++k)
      {
        const NodeRow traction = to_row<dim>(tractions[k]);
        for (unsigned int i = 0; i < n; ++i)
          forces[number_of_corner[k * n + i]] += rows.weight(k, i) * traction;
      }
    add_at_owners();
    if (!is_last)
      take_from_owners();
    motions.resize(nodes.size());
    for (unsigned int j = 0; j < nodes.size(); ++j)
      motions[j] = -time_step * inverse_masses[j] * forces[j];
  }


  template <int dim>
  void TractionSolver<dim>::write(NodalField<dim> &field, const double time_step, Budget<dim> &balance)
  {
    for (unsigned int j = 0; j < nodes.size(); ++j)
      {
        const unsigned int node = nodes[j].node;
        double *values          = field[node];
        const double mass       = values[NodalField<dim>::mass];
        if (mass <= 0. || node >= grid.n_owned_nodes())
          continue;
        Tensor<1, dim> velocity = nodes[j].before + to_vector<dim>(motions[j]);
        if (const NodeConstraints<dim> *walls = constraints.at(node))
          {
            Tensor<1, dim> held;
            for (unsigned int a = 0; a < dim; ++a)
              if (inverse_masses[j][a] == 0.)
                held[a] = time_step * forces[j][a];
            balance.wall_impulse += held;
            balance.soil_walls.add(walls->soil_faces, held);
            stop_at_walls(*walls, 1. / mass, velocity, balance);
          }
        for (unsigned int c = 0; c < dim; ++c)
          {
            values[NodalField<dim>::velocity_change + c] += velocity[c] - values[NodalField<dim>::velocity + c];
            values[NodalField<dim>::velocity + c] = velocity[c];
          }
      }
    field.update_ghosts();
    for (unsigned int j = 0; j < nodes.size(); ++j)
      {
        const double *values = field[nodes[j].node];
        if (values[NodalField<dim>::mass] <= 0.)
          continue;
        const Tensor<1, dim> velocity = vector_of<dim>(values + NodalField<dim>::velocity);
        motions[j]                    = to_row<dim>(working_velocity(
            velocity, vector_of<dim>(values + NodalField<dim>::velocity_change), velocity - nodes[j].before));
      }
  }


  template <int dim>
  void TractionSolver<dim>::solve(GroundRows<dim> &rows,
                                  NodalField<dim> &field,
                                  const double time_step,
                                  Budget<dim> &balance)
  {
    const unsigned int n_rows = rows.all.size();
    begin(rows, field);
    find_steps(rows, field, time_step);
    last.resize(n_rows);
    extrapolated.resize(n_rows);
    for (unsigned int k = 0; k < n_rows; ++k)
      last[k] = extrapolated[k] = admissible(rows.all[k], rows.all[k].traction);
    double theta = 1.;
    for (unsigned int iteration = 0; iteration < n_iterations; ++iteration)
      {
        const double next   = 0.5 * (1. + std::sqrt(1. + 4. * theta * theta));
        const double onward = (theta - 1.) / next;
        theta               = next;
        find_motions(rows, extrapolated, time_step, false);
        for (unsigned int k = 0; k < n_rows; ++k)
          {
            const GroundRow<dim> &row     = rows.all[k];
            const Tensor<1, dim> flow     = row.flow + to_vector<dim>(flow_of_motions(rows, k));
            const Tensor<1, dim> traction = admissible<dim>(row, extrapolated[k] + steps[k] * flow);
            extrapolated[k]               = traction + onward * (traction - last[k]);
            last[k]                       = traction;
          }
      }
    find_motions(rows, last, time_step, true);
    for (unsigned int k = 0; k < n_rows; ++k)
      rows.all[k].traction = last[k];
    write(field, time_step, balance);
  }

  template class TractionSolver<2>;
  template class TractionSolver<3>;
} // namespace scree
