// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/cut_cells/dry_contact.h>
#include <scree/contact/node_contact.h>
#include <scree/tensor/vector.h>

#include <algorithm>
#include <cstdlib>

namespace scree
{
  using namespace dealii;

  namespace
  {
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
  DryContact<dim>::DryContact(const BackgroundGrid<dim> &grid, const Constraints<dim> &constraints)
      : grid(grid)
      , constraints(constraints)
      , program(
            grid.communicator(),
            [this](Vector &target, const Vector &source) {
              find_forces(source.tractions);
              for (const unsigned int node : flow.active_nodes())
                for (unsigned int c = 0; c < dim; ++c)
                  flow[node][c] *= -step * inverse_masses[node][c];
              take_from_owners();
              rows->find_flows(flow, target.tractions);
              rows->add_compliances(source.tractions, target.tractions);
            },
            [this](Vector &target, const Vector &source) {
              for (unsigned int k = 0; k < rows->all.size(); ++k)
                target.tractions[k] = rows->all[k].traction_of(source.tractions[k]);
            })
      , flow(grid.numbering())
      , messages(grid.numbering())
  {
    reinit();
  }


  template <int dim>
  void DryContact<dim>::find_inertia(GroundRows<dim> &of_ground, const NodalField<dim> &field, const double time_step)
  {
    rows = &of_ground;
    step = time_step;
    list_ghosts();
    flow.clear();
    for (unsigned int k = 0; k < rows->all.size(); ++k)
      flow.activate_cell(rows->cell(k));
    for (const unsigned int node : flow.active_nodes())
      {
        const double *values = field[node], mass = values[NodalField<dim>::mass];
        const double inverse = mass > 0. ? 1. / mass : 0.;
        flow[node][0]        = inverse;
        for (unsigned int a = 0; a < dim; ++a)
          inverse_masses[node][a] = inverse;
        if (const NodeConstraints<dim> *walls = constraints.at(node); walls != nullptr && mass > 0.)
          {
            const auto held = held_by_walls(*walls, vector_of<dim>(values + NodalField<dim>::velocity));
            for (unsigned int a = 0; a < dim; ++a)
              inverse_masses[node][a] *= held.free_part(Point<dim>::unit_vector(a))[a];
          }
      }
    take_from_owners(1);
    rows->set_diagonals(flow, step);
  }


  template <int dim>
  void DryContact<dim>::list_ghosts()
  {
    ghosts.clear();
    for (unsigned int k = 0; k < rows->all.size(); ++k)
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        if (const unsigned int node = rows->nodes(k)[i]; node >= grid.n_owned_nodes())
          ghosts.push_back(node);
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    messages.begin(ghosts);
  }


  template <int dim>
  void DryContact<dim>::find_forces(const Vectors &tractions)
  {
    for (const unsigned int node : flow.active_nodes())
      std::fill_n(flow[node], 2 * dim, 0.);
    for (const unsigned int node : ghosts)
      std::fill_n(flow[node], 2 * dim, 0.);
    rows->add_forces(tractions, flow);
    messages.to_owners(
        dim,
        [this](const unsigned int node, double *numbers) { std::copy_n(flow[node], dim, numbers); },
        [this](const unsigned int node, const double *numbers) {
          for (unsigned int c = 0; c < dim; ++c)
            flow[node][c] += numbers[c];
        });
  }


  template <int dim>
  void DryContact<dim>::find_tractions()
  {
    static const unsigned int n_iterations = std::getenv("W2") ? std::atoi(std::getenv("W2")) : 5;
    constexpr double rounding              = 1e-12;
    program.begin(0, &rows->all);
    Vectors &tractions = program.solution.tractions;
    rows->begin(program.source.tractions, tractions);
    for (unsigned int k = 0; k < tractions.size(); ++k)
      rows->all[k].limit_friction(tractions[k]);
    program.set_bounds({}, {});
    program.find_residual();
    rows->choose_friction(tractions, program.residual().tractions);
    program.set_bounds({}, {});
    const double square = Utilities::MPI::sum(program.source * program.source, grid.communicator());
    program.iterate(n_iterations, rounding * std::sqrt(square));
    for (unsigned int k = 0; k < tractions.size(); ++k)
      rows->all[k].traction = tractions[k];
  }


  template <int dim>
  void DryContact<dim>::write(NodalField<dim> &field, const double time_step, Budget<dim> &balance)
  {
    for (const unsigned int node : flow.active_nodes())
      {
        double *values    = field[node];
        const double mass = values[NodalField<dim>::mass];
        if (mass <= 0.)
          continue;
        const Tensor<1, dim> before = vector_of<dim>(values + NodalField<dim>::velocity);
        Tensor<1, dim> velocity     = before, held;
        for (unsigned int a = 0; a < dim; ++a)
          if (inverse_masses[node][a] > 0.)
            velocity[a] += time_step * inverse_masses[node][a] * flow[node][a];
          else
            held[a] = -time_step * flow[node][a];
        if (const NodeConstraints<dim> *walls = constraints.at(node))
          {
            balance.wall_impulse += held;
            balance.soil_walls.add(walls->soil_faces, held);
            stop_at_walls(*walls, 1. / mass, velocity, balance);
          }
        Tensor<1, dim> change;
        for (unsigned int c = 0; c < dim; ++c)
          {
            change[c] = values[NodalField<dim>::velocity_change + c] += velocity[c] - before[c];
            values[NodalField<dim>::velocity + c] = velocity[c];
          }
        const Tensor<1, dim> working = working_velocity(velocity, change, velocity - before);
        for (unsigned int c = 0; c < dim; ++c)
          flow[node][c] = working[c];
      }
    field.update_ghosts();
    take_from_owners();
  }


  template <int dim>
  typename DryContact<dim>::Vectors DryContact<dim>::solve(GroundRows<dim> &of_ground,
                                                           NodalField<dim> &field,
                                                           const double time_step,
                                                           Budget<dim> &balance)
  {
    find_inertia(of_ground, field, time_step);
    find_tractions();
    find_forces(program.solution.tractions);
    write(field, time_step, balance);
    Vectors working;
    rows->find_flows(flow, working);
    return working;
  }

  template class DryContact<2>;
  template class DryContact<3>;
} // namespace scree
