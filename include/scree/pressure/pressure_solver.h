// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pressure_solver_h
#define scree_pressure_pressure_solver_h

#include <scree/bodies/water_parameters.h>
#include <scree/pressure/bounded_program.h>
#include <scree/pressure/pressure_operator.h>
#include <scree/pressure/schur_operator.h>

#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace scree
{
  template <int dim>
  class PressurePreconditioner;

  /// What a pressure solve took.
  struct SolveReport
  {
    unsigned int n_iterations = 0;     ///< iterations of conjugate gradients
    bool made_preconditioner  = false; ///< whether the preconditioner was set up anew
  };

  /// The system for the change of the pressure, S dp = b, on the vertices of the cells that hold water.
  ///
  /// The matrix (SchurOperator) is applied cell by cell and never stored. The preconditioner of the conjugate gradients
  /// is the algebraic multigrid of L (PressureOperator), which is kept over steps and made anew when it gets worse, and
  /// a part of the inverse diagonal of S; at rows of the ground a symmetric sweep over them.
  template <int dim>
  class PressureSolver
  {
  public:
    /// Keeps references to grid, vertices, surface and matrix.
    PressureSolver(const BackgroundGrid<dim> &grid,
                   const NodeNumbering<dim> &vertices,
                   const FreeSurface<dim> &surface,
                   SchurOperator<dim> &schur,
                   const PressureParameters &parameters);
    ~PressureSolver();

    /// Forgets what belongs to another partition of the mesh.
    void reinit();

    /// Sets the diagonal of the matrix and its preconditioner. Collective.
    /// @param storage what the diagonal of a vertex gains: of compressible water, m^3/(Pa s)
    /// @param of_ground its rows; null: none on any rank
    void assemble(const Mixture<dim> &mixture,
                  const double time_step,
                  const std::function<double(unsigned int vertex)> &storage,
                  GroundRows<dim> *of_ground);

    /// What a solve begins with.
    struct Task
    {
      const VertexVector &flow;     ///< right-hand side, m^dim/s, read at owned unknown vertices
      const VertexVector &pressure; ///< at the start of the step, Pa
      double relative_tolerance;    ///< of the residual: over the right-hand side or S times `pressure`
      double least_pressure = -std::numeric_limits<double>::infinity(); ///< Pa
      bool has_pressure     = true; ///< false: the pressure stays as it is, the ground alone acts
    };

    /// What solves took.
    struct Result
    {
      SolveReport first;             ///< the first solve
      SolveReport further;           ///< the one with the friction that was found
      unsigned int n_cavitating = 0; ///< owned vertices that are held at the least pressure
    };

    /// Finds the change of the pressure, Pa, at the unknown vertices (0 at the other wet ones), and the tractions of
    /// the ground's rows, so that flow is left nowhere where it is held: the least of the kinetic energy of what is
    /// pushed, under the constraints. What `change` holds is the first guess, unless it makes energy: then this is 0.
    ///
    /// Where the pressure would fall below the least, it is prescribed, and the mixture opens; a row whose traction
    /// would pull lifts off (BoundedProgram). A row that would be held by more than Coulomb's friction slides under
    /// that: a compliance along the ground, from the tractions of a solve before. Each step finds the whole pressure,
    /// so that what is left does not add up over steps.
    ///
    /// Collective; throws if the solver does not converge.
    Result solve(const Task &task, VertexVector &change, GroundRows<dim> *rows = nullptr);

    /// Has the preconditioner made anew by the next solve if it has become worse: to be told of the solves of one kind.
    void update_preconditioner_age(const SolveReport &report);

    /// The preconditioner's state on all ranks. Collective.
    PreconditionerState state() const;

    /// Makes the preconditioner of a state, after reinit(). Collective.
    void load(const PreconditionerState &state);

  private:
    using Vector = PressuresAndTractions<dim>;

    /// Sets `target` to the matrix times `source`, at the unknowns and at all rows. Collective.
    void vmult(Vector &target, const Vector &source);

    /// Sets `target` to the preconditioner times `source`. Collective.
    void precondition(Vector &target, const Vector &source);

    /// Sets `to` to the values of the owned unknown vertices.
    void take(const VertexVector &from, std::vector<double> &to) const;

    /// Solves the program from its solution until the residual, m^dim/s, is accepted; adds to the report.
    void converge(const double accepted, SolveReport &report);

    /// The tolerance of the residual, m^dim/s, from `flow_of_pressure` and the source; sets how rows count. Collective.
    /// @param relative to the larger of these
    double find_tolerance(const double relative);

    /// Puts source and first guess of the rows into the program, and what of them is held at first. Collective.
    /// @return whether there are some with friction on any rank
    bool start_rows();

    /// Chooses friction, puts the first guess of the change of p into the program and finds the residual. Collective.
    void start_pressures(const Task &task, const VertexVector &change);

    /// Chooses the compliances of the rows along the ground anew, so that friction is what Coulomb's law allows, from
    /// the residual, which is to be found again.
    void choose_friction();

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    const FreeSurface<dim> &surface;
    PressureOperator<dim> system;
    const unsigned int maximum_iterations;
    SchurOperator<dim> &schur;
    VertexVector of_schur, times_schur;     // by vertex
    std::vector<double> storage_of_unknown; // on the diagonal
    std::vector<double> diagonal;           // of S with the storage, by unknown, m^3/(Pa s)

    GroundRows<dim> *ground = nullptr; // of a solve; null: none
    BoundedProgram<dim> program;
    Vector flow_of_pressure; // of the whole pressure at the start of the step

    std::unique_ptr<PressurePreconditioner<dim>> preconditioner;
    static constexpr unsigned int iterations_worth_a_preconditioner = 200; // what making it costs, measured
    PreconditionerState own_state;                                         // of this rank
  };
} // namespace scree

#endif
