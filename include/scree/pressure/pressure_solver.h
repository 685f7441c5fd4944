// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pressure_solver_h
#define scree_pressure_pressure_solver_h

#include <scree/pressure/pressure_operator.h>
#include <scree/bodies/water_parameters.h>
#include <scree/pressure/schur_operator.h>

#include <functional>
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
  /// The matrix (SchurOperator) is applied cell by cell and never stored. The algebraic multigrid preconditioner of the
  /// conjugate gradients is that of L (PressureOperator), scaled up where the diagonal of S is small beside it: at
  /// vertices with little water about them. It is kept over steps and made anew when it gets worse. The numbering of
  /// the unknowns, too, serves many steps.
  template <int dim>
  class PressureSolver
  {
  public:
    /// Keeps references to grid, vertices and matrix.
    PressureSolver(const BackgroundGrid<dim> &grid,
                   const NodeNumbering<dim> &vertices,
                   SchurOperator<dim> &schur,
                   const PressureParameters &parameters);
    ~PressureSolver();

    /// Forgets what belongs to another partition of the mesh.
    void reinit();

    /// Sets the diagonal of the matrix and its preconditioner. Collective.
    /// @param storage what the diagonal of a vertex gains: of compressible water, m^3/(Pa s)
    void assemble(const Mixture<dim> &mixture,
                  const FreeSurface<dim> &surface,
                  const double time_step,
                  const std::function<double(unsigned int vertex)> &storage);

    /// Solves for the change of the pressure, Pa, at the unknown vertices (0 at the others); `rhs`, m^3/s, is read at
    /// owned unknown vertices. Starts from what `change` holds, and ends when the residual is below this part of the
    /// right-hand side or of S times `pressure`: each step finds the whole pressure, so that what is left does not add
    /// up over steps. Collective; throws if the solver does not converge.
    SolveReport
    solve(const VertexVector &rhs, const VertexVector &pressure, const double relative_tolerance, VertexVector &change);

    /// Keeps the pressure of a vertex from falling below `least`, Pa: where the solution of solve(), in
    /// `change`, would take it there, it is prescribed, and the mixture opens; it is set free again where the mixture
    /// would close, S dp < b. A primal-dual active set (@source{hintermueller2002}): nothing is solved if no vertex is
    /// below. To be called right after solve(). Collective; throws as solve().
    /// @return what the solves took; the owned vertices that are held at `least`
    std::pair<SolveReport, unsigned int>
    enforce_least_pressure(const double least, const VertexVector &pressure, VertexVector &change);

    /// Has the preconditioner made anew by the next solve if it has become worse: to be told of the solves of one kind.
    void update_preconditioner_age(const SolveReport &report);

  private:
    /// Sets `target` to the matrix times `source`, at the owned numbers. Collective.
    void vmult(VertexVector &target, const VertexVector &source);

    /// Sets `to` to the values of the owned unknown vertices, and to 0 elsewhere.
    void take(const VertexVector &from, VertexVector &to) const;

    /// What iterate() came to.
    struct Iterations
    {
      unsigned int n;
      double residual; ///< m^3/s
    };

    /// At most this many steps of conjugate gradients on `solution`, until the residual is below the tolerance. The
    /// sums over all ranks are taken together, once a step (@source{chronopoulos1989}); they also tell the residual at
    /// the step's end.
    Iterations iterate(const unsigned int most);

    /// Solves the system from what `solution` holds; adds to the report.
    void converge(SolveReport &report);

    /// Solves with `solution` prescribed where `is_held`, by owned number; `residual` is S dp - b then, at all.
    void solve_held(const std::vector<char> &is_held, VertexVector &residual, SolveReport &report);

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    PressureNumbering<dim> numbering;
    PressureOperator<dim> system;
    const unsigned int maximum_iterations;
    SchurOperator<dim> &schur;
    VertexVector of_schur, times_schur;    // by vertex
    std::vector<double> storage_of_number; // on the diagonal, of owned numbers
    std::vector<double> scale_of_number;   // of the preconditioner, at least 1; see assemble()

    VertexVector source, solution, scratch; // by number
    // Of iterate(): what is left of the source, that preconditioned, that times S; the step's direction, that times S.
    VertexVector remainder, preconditioned, product, direction, direction_product;
    double tolerance = 0; // of the last solve's residual, m^3/s

    std::unique_ptr<PressurePreconditioner<dim>> preconditioner;
    static constexpr unsigned int iterations_worth_a_preconditioner = 200; // what making it costs, measured
    unsigned int iterations_when_new = 0, surplus_iterations = 0;
    bool is_worn = true;
  };
} // namespace scree

#endif
