// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/schemes/explicit_scheme.h>

#include <algorithm>
#include <iterator>

namespace scree
{
  using namespace dealii;

  template <int dim>
  ExplicitScheme<dim>::Group::Group(const Model<dim> &model,
                                    const unsigned int number,
                                    WallGaps<dim> &wall_gaps,
                                    TimerOutput &timer)
      : number(number)
      , soil(model.grid, model.transfer, model.stabilisation, model.bodies, model.loads, number)
      , closed_faces(model.constraints[number]->faces_closed_to_soil())
      , wall_gaps(wall_gaps)
      , momentum(*model.constraints[number], wall_gaps, model.forces)
      , ground_gaps(model.grid, model.cut_cells, model.forces.fall().norm())
      , contact(model.grid, model.ground, model.surfaces, model.cut_cells, ground_gaps, timer)
      , tractions(model.grid, *model.constraints[number])
  {
    wall_gaps.add({ &soil.field });
  }


  template <int dim>
  ExplicitScheme<dim>::ExplicitScheme(const Model<dim> &model, TimerOutput &timer)
      : bodies(model.bodies)
      , forces(model.forces)
      , meets_surfaces(!model.surfaces.empty())
      , timer(timer)
  {
    std::vector<BodyGroup<dim>> at_nodes;
    for (unsigned int number = 0; number < model.constraints.size(); ++number)
      {
        Constraints<dim> &constraints = *model.constraints[number];
        Group &group                  = groups.emplace_back(model, number, gaps_of(model.grid, constraints), timer);
        at_nodes.push_back({ number, &group.soil.field, &constraints });
      }
    for (const RigidSurface<dim> &surface : model.surfaces)
      if (surface.turbulent_friction > 0.)
        turbulent_frictions.emplace_back(
            model.grid, *surface.samples, surface.turbulent_friction, forces.gravity().norm());
    for (const ContactPair &pair : model.contacts)
      contacts.emplace_back(model.grid, at_nodes[pair.first], at_nodes[pair.second], pair, bodies);
    if (Constraints<dim> &constraints = *model.constraints.front(); constraints.absorbing_faces() != 0)
      absorbing_walls = std::make_unique<AbsorbingWalls<dim>>(model.grid, constraints, forces);
    if (groups.size() > 1)
      mean_field = std::make_unique<NodalField<dim>>(model.grid);
  }


  template <int dim>
  void ExplicitScheme<dim>::sum_at_nodes(const double time_step, Budget<dim> &budget)
  {
    {
      const TimedPart part(timer, TimerSection::points_to_grid);
      for (Group &group : groups)
        {
          group.soil.add_loads(0.); // Leapfrog: loads are those of the start of the step.
          for (const auto &friction : turbulent_frictions)
            friction.add_to(group.soil.field, bodies, group.number, time_step, budget);
        }
    }
    {
      const TimedPart part(timer, TimerSection::waiting);
      for (Group &group : groups)
        group.soil.field.add_contributions();
    }
    for (Group &group : groups)
      group.soil.field.scale_inertia(forces.mass_scaling());
    const TimedPart part(timer, TimerSection::nodes);
    if (absorbing_walls && !is_settling)
      absorbing_walls->release();
    for (WallGaps<dim> &gaps : wall_gaps)
      gaps.release(forces, time_step);
    if (absorbing_walls && !is_settling)
      absorbing_walls->add_forces(bodies, groups.front().soil.field, time_step, budget);
  }


  template <int dim>
  void ExplicitScheme<dim>::solve(const double time_step, StepReport<dim> &report)
  {
    Budget<dim> &budget = report.balance;

    sum_at_nodes(time_step, budget);
    for (Group &group : groups)
      {
        const TimedPart part(timer, TimerSection::nodes);
        budget += group.momentum.solve(group.soil.field, time_step); // m v = m v + dt (f + m g)
        budget.load_impulse += group.soil.load_impulse(time_step);
        group.soil.field.update_ghosts();
      }
    for (auto &contact : contacts)
      {
        const TimedPart part(timer, TimerSection::contacts);
        contact.find();
      }
    solve_contacts(time_step, budget);
    solve_ground(time_step, budget);
    if (meets_surfaces)
      solve_contacts(time_step, budget); // The surfaces have stopped some of what lies on them.
    for (const auto &contact : contacts)
      contact.count_dissipation(budget);
  }


  template <int dim>
  void ExplicitScheme<dim>::solve_ground(const double time_step, Budget<dim> &budget)
  {
    if (!meets_surfaces)
      return;
    const TimedPart part(timer, TimerSection::bed);
    for (Group &group : groups)
      {
        GroundRows<dim> &rows =
            group.contact.find_rows(bodies, group.number, group.soil.field, forces.mass_scaling(), time_step);
        group.tractions.solve(rows, group.soil.field, time_step, budget);
        group.contact.count_rows(group.tractions, time_step, budget);
      }
  }


  template <int dim>
  SolverState<dim> ExplicitScheme<dim>::solver_state() const
  {
    SolverState<dim> state;
    for (const Group &group : groups)
      for (FacetTractions<dim> one : group.contact.tractions())
        {
          one.group = group.number;
          state.tractions.push_back(one);
        }
    if (absorbing_walls)
      state.free_field = absorbing_walls->free_field;
    return state;
  }


  template <int dim>
  void ExplicitScheme<dim>::set_solver_state(const SolverState<dim> &state)
  {
    for (Group &group : groups)
      {
        std::vector<FacetTractions<dim>> of_group;
        std::copy_if(state.tractions.begin(),
                     state.tractions.end(),
                     std::back_inserter(of_group),
                     [&](const auto &one) { return one.group == group.number; });
        group.contact.set_tractions(of_group);
      }
    if (absorbing_walls)
      absorbing_walls->free_field = state.free_field;
  }


  template <int dim>
  const NodalField<dim> &ExplicitScheme<dim>::soil_field()
  {
    if (!mean_field)
      return groups.front().soil.field;
    using Field = NodalField<dim>;
    mean_field->clear();
    for (const auto &body : bodies)
      for (const auto &cell : body.points.cells())
        mean_field->activate_cell(cell.cell);
    for (const unsigned int node : mean_field->active_nodes())
      {
        double *mean = (*mean_field)[node];
        for (const Group &group : groups)
          if (const double *values = group.soil.field[node]; values[Field::mass] > 0.)
            {
              mean[Field::mass] += values[Field::mass];
              for (unsigned int c = 0; c < dim; ++c)
                mean[Field::velocity + c] += values[Field::mass] * values[Field::velocity + c];
            }
        for (unsigned int c = 0; c < dim && mean[Field::mass] > 0.; ++c)
          mean[Field::velocity + c] /= mean[Field::mass];
      }
    mean_field->update_ghosts();
    return *mean_field;
  }


  template class ExplicitScheme<2>;
  template class ExplicitScheme<3>;
} // namespace scree
