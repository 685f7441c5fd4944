// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/schemes/explicit_scheme.h>

#include <algorithm>
#include <iterator>

namespace scree
{
  using namespace dealii;

  template <int dim>
  ExplicitScheme<dim>::ExplicitScheme(const BackgroundGrid<dim> &grid,
                                      const BodyForces<dim> &forcing,
                                      const TransferParameters &transfer,
                                      const StabilisationParameters &stabilisation,
                                      std::list<SoilBody<dim>> &bodies,
                                      std::list<SurfaceLoad<dim>> &loads,
                                      std::vector<GroupSurroundings<dim>> surroundings,
                                      const std::vector<ContactPair> &pairs,
                                      TimerOutput &timer)
      : bodies(bodies)
      , forcing(forcing)
      , timer(timer)
  {
    std::vector<BodyGroup<dim>> at_nodes;
    for (auto &around : surroundings)
      {
        const unsigned int number = groups.size();
        WallGaps<dim> &gaps       = gaps_of(grid, *around.constraints);
        groups.push_back({ SolidPhase<dim>(grid, transfer, stabilisation, bodies, loads, number),
                           &gaps,
                           ExplicitUpdate<dim>(*around.constraints, gaps, forcing),
                           std::move(around.bed) });
        gaps.add({ &groups.back().soil.field });
        at_nodes.push_back({ number, &groups.back().soil.field, around.constraints });
      }
    for (const ContactPair &pair : pairs)
      contacts.emplace_back(grid, at_nodes[pair.first], at_nodes[pair.second], pair, bodies);
    if (groups.size() > 1)
      mean_field = std::make_unique<NodalField<dim>>(grid);
  }


  template <int dim>
  WallGaps<dim> &ExplicitScheme<dim>::gaps_of(const BackgroundGrid<dim> &grid, Constraints<dim> &constraints)
  {
    for (WallGaps<dim> &gaps : wall_gaps)
      if (gaps.are_of(constraints))
        return gaps;
    return wall_gaps.emplace_back(grid, constraints);
  }


  template <int dim>
  void ExplicitScheme<dim>::reinit()
  {
    for (WallGaps<dim> &gaps : wall_gaps)
      gaps.reinit();
    for (Group &group : groups)
      {
        group.soil.reinit();
        if (group.bed)
          group.bed->reinit();
      }
    for (auto &contact : contacts)
      contact.reinit();
    if (mean_field)
      mean_field->reinit();
  }


  template <int dim>
  void ExplicitScheme<dim>::read_points()
  {
    for (Group &group : groups)
      group.soil.field.clear();
  }


  template <int dim>
  void ExplicitScheme<dim>::to_grid(const double time)
  {
    const TimedPart part(timer, TimerSection::points_to_grid);
    for (Group &group : groups)
      group.soil.to_grid(time);
    for (WallGaps<dim> &gaps : wall_gaps)
      gaps.clear();
    for (const auto &body : bodies)
      if (!body.is_rigid)
        std::next(groups.begin(), body.group)->wall_gaps->add(body.points, body.spacing);
  }


  template <int dim>
  void ExplicitScheme<dim>::solve(const double time_step, StepReport<dim> &report)
  {
    for (Group &group : groups)
      {
        const TimedPart part(timer, TimerSection::points_to_grid);
        group.soil.add_loads(0.); // Velocity and place leap over each other: the acceleration is that of the start.
        group.soil.field.add_contributions();
      }
    for (WallGaps<dim> &gaps : wall_gaps)
      {
        const TimedPart part(timer, TimerSection::nodes);
        gaps.release(forcing, time_step);
      }
    for (Group &group : groups)
      {
        const TimedPart part(timer, TimerSection::nodes);
        report.balance += group.step.solve(group.soil.field, time_step);
        report.balance.load_impulse += group.soil.load_impulse(time_step);
        group.soil.field.update_ghosts();
      }
    for (auto &contact : contacts)
      {
        const TimedPart part(timer, TimerSection::contacts);
        contact.find();
      }
    solve_contacts(time_step, report);
    bool any_bed = false;
    for (Group &group : groups)
      if (group.bed)
        {
          const TimedPart part(timer, TimerSection::bed);
          group.bed->solve(group.soil.field, time_step, report.balance);
          any_bed = true;
        }
    if (any_bed)
      solve_contacts(time_step, report); // The bed has stopped some of what lies on it.
    for (const auto &contact : contacts)
      contact.count_dissipation(report.balance);
  }


  template <int dim>
  void ExplicitScheme<dim>::solve_contacts(const double time_step, StepReport<dim> &report)
  {
    if (contacts.empty())
      return;
    const TimedPart part(timer, TimerSection::contacts);
    // Where three groups meet, one contact disturbs the other.
    const unsigned int n_sweeps = contacts.size() == 1 ? 1 : 4;
    for (unsigned int sweep = 0; sweep < n_sweeps; ++sweep)
      for (auto &contact : contacts)
        contact.solve(time_step, report.balance);
    for (Group &group : groups)
      group.soil.field.update_ghosts();
  }


  template <int dim>
  void ExplicitScheme<dim>::to_points(const double time_step, StepReport<dim> &report)
  {
    const TimedPart part(timer, TimerSection::stress);
    for (Group &group : groups)
      group.soil.to_points(time_step, report);
  }


  template <int dim>
  std::vector<PointSet<dim> *> ExplicitScheme<dim>::point_sets()
  {
    std::vector<PointSet<dim> *> sets;
    groups.front().soil.append_point_sets(sets);
    return sets;
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


  template <int dim>
  std::unique_ptr<WaterView<dim>> ExplicitScheme<dim>::water_view() const
  {
    return nullptr;
  }

  template class ExplicitScheme<2>;
  template class ExplicitScheme<3>;
} // namespace scree
