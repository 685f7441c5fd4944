// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_schemes_two_phase_scheme_h
#define scree_schemes_two_phase_scheme_h

#include <scree/schemes/scheme.h>
#include <scree/momentum/solid_phase.h>
#include <scree/viscosity/viscous_step.h>
#include <scree/momentum/particle_shifting.h>

namespace scree
{
  /// Soil and water: explicit soil, implicit drag, and a pressure whose force is the transpose of the divergence
  /// (doc/theory/two_phases.md; two sets of points: @source{xie2024}).
  ///
  /// The stages of solve() are numbered as there, and as in doc/theory/wet_step.py. Where water keeps its place, soil
  /// carries its weight, and the pressure is that of its points.
  ///
  /// What a case does not have, viscosity, ground or shifting, is an empty object, whose calls return at once.
  template <int dim>
  class TwoPhaseScheme : public Scheme<dim>
  {
  public:
    /// Makes fields and operators.
    /// @param model its members are kept by reference
    TwoPhaseScheme(const Model<dim> &model, dealii::TimerOutput &timer);

    void reinit() override
    {
      soil.reinit();
      mixture.reinit();
      nodes.reinit();
      surface.reinit();
      operators.reinit();
      pressure.reinit();
      wall_gaps.reinit();
      momentum.reinit(grid.n_owned_nodes());
      viscosity.reinit();
      contact.reinit();
      shifting.reinit();
    }
    void follow_ground() override
    {
      surface.follow_ground();
      contact.follow();
    }
    void read_points() override
    {
      gather();
      activate_nodes();
      pressure.locate(mixture);
      soil.field.clear();
      nodes.water.clear(); // sums, not velocities
    }
    void to_grid(const double time) override;
    void solve(const double time_step, StepReport<dim> &report) override;
    void to_points(const double time_step, const double damping_time, StepReport<dim> &report) override
    {
      {
        const TimedPart part(timer, TimerSection::stress);
        soil.to_points(time_step, damping_time, report);
      }
      if (!water_is_held)
        move_water(time_step, report);
      project_to_boundary(time_step, report);
    }
    void settle(const bool settles) override
    {
      water_is_held = settles;
    }
    NodalForces nodal_forces(const double time_step) const override
    {
      NodalForces sums;
      add_nodal_forces(soil.field, &nodes.water, forces, time_step, sums);
      return sums;
    }
    SolverState<dim> solver_state() const override
    {
      SolverState<dim> state;
      state.tractions = contact.tractions();
      pressure.save(state);
      return state;
    }
    void set_solver_state(const SolverState<dim> &state) override
    {
      contact.set_tractions(state.tractions);
      pressure.load(state);
    }
    std::vector<PointSet<dim> *> point_sets() override;
    const NodalField<dim> &soil_field() override
    {
      return soil.field;
    }
    std::unique_ptr<WaterView<dim>> water_view() const override;

  private:
    /// Sums of the water's points and of the soil's pores. Collective.
    void gather();

    /// Makes all fields active where any is.
    void activate_nodes()
    {
      for (const MixtureCell<dim> &cell : mixture.cells())
        nodes.activate_cell(cell.cell);
    }

    /// Sums of all ranks at the nodes, forces of loads among them, and walls that act. Collective.
    void sum_at_nodes(const double time_step)
    {
      const TimedPart part(timer, TimerSection::nodes);
      activate_nodes();
      soil.add_loads(time_step); // Pressure is implicit, so the load is that of the step's end.
      nodes.add_contributions(forces.mass_scaling());
      wall_gaps.release(forces, time_step);
    }

    /// Free surface, p^n and B; what the sums say of the discharge, and the force of p^n. Collective.
    void prepare_pressure(const double time_step);

    /// The soil takes mass, weight and pressure of the water at its nodes: what carries both where water keeps its
    /// place.
    void load_soil_with_water();

    /// Change of the pressure, and tractions of the ground. Collective.
    void find_pressure(const double time_step, Budget<dim> &budget);

    /// The water's part of to_points(). Collective.
    void move_water(const double time_step, StepReport<dim> &report);

    /// Takes the pressure, and books what is known at the end of a step only. Collective.
    void end_step(const double time_step, Budget<dim> &budget);

    /// Takes points back that have left through the box or the ground.
    void project_to_boundary(const double time_step, StepReport<dim> &report);

    const BackgroundGrid<dim> &grid;
    const BodyForces<dim> &forces;
    bool water_is_held = false;
    std::list<WaterPhase<dim>> &water;
    const std::uint8_t faces_closed_to_soil, faces_closed_to_water; // of the box
    const std::list<Inflow<dim>> &inflows;
    dealii::TimerOutput &timer;

    SolidPhase<dim> soil;
    WaterTransfer<dim> transfer;
    Mixture<dim> mixture;
    WetNodes<dim> nodes;
    GroundGaps<dim> ground_gaps;
    FreeSurface<dim> surface;
    PressureOperators<dim> operators;
    PorePressure<dim> pressure;
    WallGaps<dim> wall_gaps;
    const double spacing; // of the points at the start, where they are widest apart, m
    TwoPhaseMomentum<dim> momentum;
    ViscousStep<dim> viscosity;
    CutCellContact<dim> contact;
    ParticleShifting<dim> shifting;
  };
} // namespace scree

#endif
