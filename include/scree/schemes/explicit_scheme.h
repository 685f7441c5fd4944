// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_schemes_explicit_scheme_h
#define scree_schemes_explicit_scheme_h

#include <scree/contact/turbulent_friction.h>
#include <scree/contact/bodies/body_contact.h>
#include <scree/contact/cut_cells/cut_cell_contact.h>
#include <scree/contact/cut_cells/traction_solver.h>
#include <scree/momentum/absorbing_walls.h>
#include <scree/momentum/explicit_update.h>
#include <scree/schemes/scheme.h>
#include <scree/momentum/solid_phase.h>

namespace scree
{
  /// Soil without water: one phase, explicit. Each group of bodies that stick to each other has a velocity field of its
  /// own; nearly always there is one.
  template <int dim>
  class ExplicitScheme : public Scheme<dim>
  {
  public:
    /// Makes a field for each group of bodies.
    /// @param model its members are kept by reference
    ExplicitScheme(const Model<dim> &model, dealii::TimerOutput &timer);

    void reinit() override
    {
      for (WallGaps<dim> &gaps : wall_gaps)
        gaps.reinit();
      for (Group &group : groups)
        {
          group.soil.reinit();
          group.contact.reinit();
          group.tractions.reinit();
        }
      for (auto &contact : contacts)
        contact.reinit();
      if (absorbing_walls)
        absorbing_walls->reinit();
      if (mean_field)
        mean_field->reinit();
    }
    void read_points() override
    {
      for (Group &group : groups)
        group.soil.field.clear();
    }
    void to_grid(const double time) override
    {
      for (Group &group : groups)
        group.soil.average(timer);
      const TimedPart part(timer, TimerSection::points_to_grid);
      for (Group &group : groups)
        group.soil.to_grid(time);
      for (WallGaps<dim> &gaps : wall_gaps)
        gaps.clear();
      for (Group &group : groups)
        group.ground_gaps.clear();
      for (const auto &body : bodies)
        if (!body.is_rigid)
          {
            Group &group = *std::next(groups.begin(), body.group);
            group.wall_gaps.add(body.points, body.spacing);
            group.ground_gaps.add(body.points, body.layout.velocity, body.spacing);
          }
    }
    void solve(const double time_step, StepReport<dim> &report) override;
    void to_points(const double time_step, const double damping_time, StepReport<dim> &report) override
    {
      const TimedPart part(timer, TimerSection::stress);
      for (Group &group : groups)
        group.soil.to_points(time_step, damping_time, report);
      if (absorbing_walls)
        absorbing_walls->keep_inside(bodies);
      for (auto &body : bodies)
        if (!body.is_rigid)
          {
            Group &group = *std::next(groups.begin(), body.group);
            report.soil +=
                group.contact.project_to_boundary({ body.points, body.layout, body.has_affine_energy, Phase::soil },
                                                  forces.mass_scaling(),
                                                  time_step,
                                                  report.speeds.points,
                                                  group.closed_faces,
                                                  report.balance);
          }
    }
    void settle(const bool settles) override
    {
      is_settling = settles;
      if (absorbing_walls)
        absorbing_walls->free_field = FreeField<dim>();
    }
    SolverState<dim> solver_state() const override;
    void set_solver_state(const SolverState<dim> &state) override;
    void follow_ground() override
    {
      for (Group &group : groups)
        group.contact.follow();
    }
    NodalForces nodal_forces(const double time_step) const override
    {
      NodalForces sums;
      for (const Group &group : groups)
        add_nodal_forces<dim>(group.soil.field, nullptr, forces, time_step, sums);
      return sums;
    }
    std::vector<PointSet<dim> *> point_sets() override
    {
      std::vector<PointSet<dim> *> sets;
      groups.front().soil.append_point_sets(sets);
      return sets;
    }
    const NodalField<dim> &soil_field() override;

  private:
    /// Bodies that stick to each other.
    struct Group
    {
      Group(const Model<dim> &model, const unsigned int number, WallGaps<dim> &wall_gaps, dealii::TimerOutput &timer);

      const unsigned int number; ///< of the group
      SolidPhase<dim> soil;
      const std::uint8_t closed_faces; ///< of the box, to the soil
      WallGaps<dim> &wall_gaps;
      ExplicitUpdate<dim> momentum;
      GroundGaps<dim> ground_gaps;
      CutCellContact<dim> contact; ///< with rigid ground
      TractionSolver<dim> tractions;
    };

    /// Those at nodes with these constraints, which groups may share; made where there are none yet.
    WallGaps<dim> &gaps_of(const BackgroundGrid<dim> &grid, Constraints<dim> &constraints)
    {
      for (WallGaps<dim> &gaps : wall_gaps)
        if (gaps.are_of(constraints))
          return gaps;
      return wall_gaps.emplace_back(grid, constraints);
    }

    /// Sums of all ranks, with the loads, and walls that act. Collective.
    void sum_at_nodes(const double time_step, Budget<dim> &budget);

    /// Impulses of rigid ground. Collective.
    void solve_ground(const double time_step, Budget<dim> &budget);

    /// Impulses where groups meet.
    void solve_contacts(const double time_step, Budget<dim> &budget)
    {
      if (contacts.empty())
        return;
      const TimedPart part(timer, TimerSection::contacts);
      // Where three groups meet, one contact disturbs the other.
      const unsigned int n_sweeps = contacts.size() == 1 ? 1 : 4;
      for (unsigned int sweep = 0; sweep < n_sweeps; ++sweep)
        for (auto &contact : contacts)
          contact.solve(time_step, budget);
      for (Group &group : groups)
        group.soil.field.update_ghosts();
    }

    std::list<SoilBody<dim>> &bodies;
    const BodyForces<dim> &forces;
    const bool meets_surfaces; // rigid ones
    std::list<WallGaps<dim>> wall_gaps;
    std::list<Group> groups;
    std::list<BodyContact<dim>> contacts;
    std::vector<TurbulentFriction<dim>> turbulent_frictions; // of the bed
    std::unique_ptr<NodalField<dim>> mean_field;             // of all groups; null if there is one
    std::unique_ptr<AbsorbingWalls<dim>> absorbing_walls;    // null if there are none
    bool is_settling = false;
    dealii::TimerOutput &timer;
  };
} // namespace scree

#endif
