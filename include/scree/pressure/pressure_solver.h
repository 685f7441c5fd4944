// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pressure_solver_h
#define scree_pressure_pressure_solver_h

#include <scree/pressure/pressure_operator.h>
#include <scree/bodies/water_parameters.h>
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
  /// a part of the inverse diagonal of S; at rows of the ground a symmetric sweep over them. The numbering of the
  /// unknowns, too, serves many steps.
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
    /// @param of_ground its rows; null: none on any rank
    void assemble(const Mixture<dim> &mixture,
                  const FreeSurface<dim> &surface,
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

    /// Finds the change of the pressure, Pa, at the unknown vertices (0 at the others), from what `change` holds, and
    /// the tractions of the ground's rows, so that flow is left nowhere where it is held: the least of the kinetic
    /// energy of what is pushed, under the constraints.
    ///
    /// Where the pressure would fall below the least, it is prescribed, and the mixture opens; a row whose traction
    /// would pull lifts off: a quadratic program with bounds, solved by preconditioned conjugate gradients with
    /// projections and proportioning (@source{dostal2005}). Each of its steps lowers the energy. A row that would be
    /// held by more than Coulomb's friction slides under that: a compliance along the ground, from the tractions of a
    /// solve before. Each step finds the whole pressure, so that what is left does not add up over steps.
    ///
    /// Collective; throws if the solver does not converge.
    Result solve(const Task &task, VertexVector &change, GroundRows<dim> *rows = nullptr);

    /// Has the preconditioner made anew by the next solve if it has become worse: to be told of the solves of one kind.
    void update_preconditioner_age(const SolveReport &report);

  private:
    /// Pressures by number, Pa, and tractions by row, Pa; or flows, m^dim/s.
    struct Joint
    {
      VertexVector of_vertices;
      typename GroundRows<dim>::Vectors of_rows;

      void clear(const std::size_t n_rows)
      {
        of_vertices = 0.;
        of_rows.assign(n_rows, dealii::Tensor<1, dim>());
      }
      /// *this = factor * *this + other_factor * other.
      void sadd(const double factor, const double other_factor, const Joint &other);
    };

    /// Sets `target` to the matrix times `source`, at the unknown numbers that are not held and at all rows.
    /// Collective.
    void vmult(Joint &target, const Joint &source);

    /// Sets `to` to the preconditioner times `from`, at what is free. Collective.
    void precondition(const Joint &from, Joint &to);

    /// Drops what belongs to held vertices, and what the ground leaves free of the flow at the rows.
    void restrict_to_free(Joint &vector) const;

    /// Sets `direction` to where what is at its bound would leave it: held pressures that the flow raises, lifted rows
    /// that it presses on. Returns the sum of squares of these flows on this rank.
    double find_release(Joint &direction) const;

    /// Frees what moves along a direction of find_release().
    void release(const Joint &along);

    /// Whether the traction of a row presses on the ground.
    bool presses(const unsigned int k) const;

    /// How far `solution` can go along `direction` until an owned number, or a row, is at its bound.
    double step_of_vertex(const unsigned int i) const;
    double step_of_row(const unsigned int k) const;

    /// The smallest of these on this rank.
    double longest_step() const;

    /// Goes as far as that, or the smallest of all ranks; what is at its bound then is exactly there.
    void go_to_first_bound(const double length);

    /// Takes the traction of a row across the ground away.
    void lift_off(const unsigned int k);

    /// Puts what of `solution` is beyond its bounds on them.
    void project();

    /// Holds what of `solution` is at its bounds.
    void hold();

    /// This rank's part of x S x/2 - x b of `solution`, with its residual.
    double energy() const;

    /// On this rank.
    static double product_of(const Joint &a, const Joint &b);

    /// Sets `to` to the values of the owned unknown vertices, and to 0 elsewhere.
    void take(const VertexVector &from, VertexVector &to) const;

    /// What iterate() came to.
    struct Iterations
    {
      unsigned int n;
      double residual; ///< m^3/s
    };

    /// At most this many steps on `solution`, until the residual is below the accepted one: conjugate gradients in what
    /// is free; where they leave the bounds, the whole step projected, or if that raises the energy the step to the
    /// first bound; steps of release where what is held leaves more than what is free.
    Iterations iterate(const unsigned int most);

    /// Solves the system from what `solution` holds; adds to the report.
    void converge(SolveReport &report);

    /// Sum of squares on this rank.
    double local_square(const Joint &vector) const;

    /// Sets the tolerance from `scratch`, the flow of the whole pressure, and `source`, and how rows count. Collective.
    /// @param relative to the larger of these
    void set_tolerance(const double relative);

    /// Finds what is left of the flow, at all unknowns. Collective.
    void find_residual();

    /// What of the rows is held at first, from the tractions before.
    void start_rows();

    /// Chooses the compliances of the rows along the ground anew, so that friction is what Coulomb's law allows.
    void choose_friction();

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    PressureNumbering<dim> numbering;
    PressureOperator<dim> system;
    const unsigned int maximum_iterations;
    SchurOperator<dim> &schur;
    VertexVector of_schur, times_schur;     // by vertex
    std::vector<double> storage_of_number;  // on the diagonal, of owned numbers
    std::vector<double> diagonal_of_number; // of S with the storage, m^3/(Pa s)

    GroundRows<dim> *ground           = nullptr; // of a solve; null: none
    std::vector<GroundRow<dim>> *rows = nullptr; // its rows
    std::vector<char> is_held;                   // by owned number: at the least pressure
    std::vector<double> least_change;            // by owned number, Pa; empty: the pressure has no bound
    Joint source, solution, residual, scratch, last_solution;
    // Of iterate(): what is left of the source, that preconditioned, that times S; the step's direction, that times S.
    Joint remainder, preconditioned, product, direction, direction_product;
    double tolerance      = 0;  // of the last solve's residual, m^3/s
    double accepted       = 0;  // of the current one's
    double weight_of_rows = 1.; // of the squares of flows at rows against those at vertices, in norms

    std::unique_ptr<PressurePreconditioner<dim>> preconditioner;
    static constexpr unsigned int iterations_worth_a_preconditioner = 200; // what making it costs, measured
    unsigned int iterations_when_new = 0, surplus_iterations = 0;
    bool is_worn = true;
  };
} // namespace scree

#endif
