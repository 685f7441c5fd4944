// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pore_pressure_h
#define scree_pressure_pore_pressure_h

#include <scree/bodies/water_parameters.h>
#include <scree/pressure/bounded_program.h>
#include <scree/pressure/operators.h>
#include <scree/pressure/preconditioner.h>
#include <scree/step/step_report.h>

namespace scree
{
  /// The pore pressure p at the vertices of the cells: where the water ends, p at the start of a step, and the system
  /// for its change dp and the tractions of the ground, S dp = T^T (B u** - c - H T p) (PressureOperators), with the
  /// drag in S.
  ///
  /// The preconditioner of the conjugate gradients is PressurePreconditioner, which is kept over steps and made anew
  /// when it gets worse, and a part of the inverse diagonal of S; at rows of the ground a symmetric sweep over them.
  template <int dim>
  class PorePressure
  {
  public:
    using AtVertices = std::array<double, (1 << dim)>; ///< a number a vertex of a cell, in deal.II's order

    /// Keeps references to grid, surface and operators.
    PorePressure(const BackgroundGrid<dim> &grid,
                 FreeSurface<dim> &surface,
                 PressureOperators<dim> &operators,
                 const PressureParameters &parameters,
                 const WaterParameters &water,
                 dealii::TimerOutput &timer);

    /// Fits it to the grid's current vertices. Collective.
    void reinit();

    /// Finds the water's surface and the pressure at the start of a step. Collective.
    void locate(const Mixture<dim> &mixture);

    /// Impulses of the pressure in a step, N s, at the owned nodes: of u, then of q beside it. Collective.
    const FlowField<dim> &impulses(const double time_step)
    {
      return operators.impulses(pressure, time_step, surface.suction_behind());
    }

    /// Solves for the change of the pressure over a step, and for the tractions of the ground, from the predicted
    /// velocities, whose ghosts hold values, so that flow is left nowhere where it is held: the least of the kinetic
    /// energy of what is pushed, under the constraints. The first guess is the change of the last step, unless it makes
    /// energy.
    ///
    /// Where the pressure would fall below that of cavitation, it is prescribed, and the mixture opens; a row whose
    /// traction would pull lifts off (BoundedProgram). A row that would be held by more than Coulomb's friction slides
    /// under that: a compliance along the ground, from the tractions of a solve before. The divergence is
    /// that of the whole velocity, so that what is left does not add up over steps.
    ///
    /// Collective; throws if the solver does not converge.
    /// @param mixture gets the mobilities of its cells
    /// @param block_at see PressureOperators
    /// @param rows of the ground; null: there is none
    /// @param holds_pressure the pressure stays as it is, the ground alone acts
    void solve(Mixture<dim> &mixture,
               const WetNodes<dim> &nodes,
               const typename PressureOperators<dim>::BlockAt &block_at,
               GroundRows<dim> *rows,
               const bool holds_pressure,
               const double time_step,
               Budget<dim> &balance);

    /// Impulses of its change over the step and of the ground, as impulses(). Collective.
    const FlowField<dim> &impulses_of_change(const double time_step)
    {
      const TimedPart timed(timer, TimerSection::nodes);
      return operators.impulses(change, time_step, nullptr, &tractions);
    }

    /// Impulses of suction and of the pressure at drained walls, which do work, as impulses(). Collective.
    const FlowField<dim> &prescribed_impulses(const double time_step);

    /// Adds the change to the pressure, which is that of the end of the step from here on. Collective.
    void accept_change();

    /// Finds the potential whose flux, with the matrix of the last solve(), is `source`, m^dim/s, by owned unknown.
    /// Collective.
    void solve_potential(const std::vector<double> &source, Budget<dim> &balance);

    /// Impulses of the potential as of a pressure, as impulses(). Collective.
    const FlowField<dim> &impulses_of_potential(const double time_step)
    {
      return operators.impulses(potential, time_step);
    }

    /// Writes what the next step's solves begin with into a state, of all ranks. Collective.
    void save(SolverState<dim> &state) const;

    /// Sets what of it this rank has, after reinit(). Collective.
    void load(const SolverState<dim> &state);

    /// Pressure, with suction, at the vertices of a cell with points, Pa, in deal.II's order.
    AtVertices pressure_of(const unsigned int cell) const;

  private:
    using Vector = PressuresAndTractions<dim>;

    /// What a solve took.
    struct SolveReport
    {
      unsigned int n_iterations = 0;
      bool made_preconditioner  = false;
    };

    void reinit_vectors();

    /// What a pressure gradient does to the flow in the cells.
    void find_mobilities(Mixture<dim> &mixture, const double time_step) const;

    /// Sets `target` to the matrix times `source`, at the unknowns and at all rows. Collective.
    void vmult(Vector &target, const Vector &source);

    /// Sets `target` to the preconditioner times `source`. Collective.
    void precondition(Vector &target, const Vector &source);

    /// Begins a program with this source, m^dim/s, at the owned unknowns.
    /// @param of_ground its rows; null: none on any rank
    void begin(const std::vector<double> &source, GroundRows<dim> *of_ground);

    /// Solves it, and sets `solution` to the pressures, which are its first guess before. Collective.
    /// @param relative tolerance of the residual: over the source or S times the pressure at the start of the step
    /// @param least pressure with this one, Pa
    /// @return what the first solve took: there are two where there is friction, the second with what was found of it
    SolveReport find_solution(VertexVector &solution,
                              const double relative,
                              const double least,
                              const bool holds_pressure,
                              Budget<dim> &balance);

    /// The tolerance of the residual, m^dim/s; sets how rows count. Collective.
    double find_tolerance(const double relative);

    /// Puts source and first guess of the rows into the program, and what of them is held at first. Collective.
    /// @return whether there are some with friction on any rank
    bool start_rows();

    /// Chooses friction, puts the first guess of the pressures into the program and finds the residual. Collective.
    void start_pressures(const VertexVector &first, const double least, const bool holds_pressure);

    /// Chooses the compliances of the rows along the ground anew, so that friction is what Coulomb's law allows, from
    /// the residual, which is to be found again.
    void choose_friction();

    /// Solves the program from its solution until the residual, m^dim/s, is accepted. Collective.
    SolveReport converge(const double accepted, Budget<dim> &balance);

    /// Has the preconditioner made anew by the next solve if it has become worse.
    void update_preconditioner_age(const SolveReport &report);

    const BackgroundGrid<dim> &grid;
    const double relative_tolerance, bulk_modulus, cavitation_pressure;
    const unsigned int maximum_iterations;
    dealii::TimerOutput &timer;

    const NodeNumbering<dim> &vertices;
    FreeSurface<dim> &surface;
    PressureOperators<dim> &operators;
    PressurePreconditioner<dim> preconditioner;
    PreconditionerState own_state;                                         // of this rank
    static constexpr unsigned int iterations_worth_a_preconditioner = 200; // what making it costs, measured
    BoundedProgram<dim> program;
    GroundRows<dim> *ground = nullptr; // of a solve; null: none

    VertexVector pressure, change, potential, prescribed;
    typename GroundRows<dim>::Vectors tractions; // of the last solve, Pa
    std::vector<double> storage;                 // on the diagonal, by owned unknown
    std::vector<double> diagonal;                // of S with the storage, by unknown, m^dim/(Pa s)
  };
} // namespace scree

#endif
