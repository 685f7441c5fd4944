// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_bounded_program_h
#define scree_pressure_bounded_program_h

#include <scree/pressure/ground_rows.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

namespace scree
{
  /// The least of x S x/2 - x b over pressures that are not below their bounds and tractions that do not pull at rows
  /// that only press, with S symmetric and positive: a quadratic program.
  ///
  /// It is solved by preconditioned conjugate gradients with projections and proportioning (@source{dostal2005}): they
  /// run in what is free; where they leave the bounds, the whole step is projected, or if that raises the energy the
  /// step ends at the first bound; what is held at its bound is released where it leaves more than what is free. Each
  /// step lowers the energy.
  template <int dim>
  class BoundedProgram
  {
  public:
    using Vector = PressuresAndTractions<dim>; ///< of pressures and tractions, or of flows

    /// Sets `target` to an operator times `source`. Collective.
    using Operator = std::function<void(Vector &target, const Vector &source)>;

    /// @param matrix S, at all unknowns and rows, also those that are held
    /// @param preconditioner an approximate inverse; what it gives to what is held is dropped
    BoundedProgram(const MPI_Comm communicator, const Operator &matrix, const Operator &preconditioner)
        : communicator(communicator)
        , matrix(matrix)
        , preconditioner(preconditioner)
    {
    }

    /// Sets source and solution to 0.
    /// @param n_pressures owned unknowns of this rank
    /// @param of_ground its rows; the program changes what they hold across the ground; null: none on any rank
    void begin(const std::size_t n_pressures, std::vector<GroundRow<dim>> *of_ground);

    /// Holds what of the solution is at its bounds or beyond, and puts it there.
    /// @param least_pressures by owned unknown, Pa; empty: all pressures stay as they are
    /// @param diagonal of S, by owned unknown, m^dim/(Pa s)
    void set_bounds(const std::vector<double> &least_pressures, const std::vector<double> &diagonal);

    /// What iterate() came to.
    struct Iterations
    {
      unsigned int n;  ///< their number
      double residual; ///< its norm, with the weight of the rows, m^dim/s
    };

    /// At most this many steps on the solution, until the norm of what is left is not above the accepted one; the
    /// residual must be known. Collective.
    Iterations iterate(const unsigned int most, const double accepted);

    /// Finds what is left of the source. Collective.
    void find_residual();

    /// What the last iteration left of the source, or find_residual() found.
    const Vector &residual() const
    {
      return remaining;
    }

    /// Whether the traction of a row presses on the ground.
    bool presses(const unsigned int k) const
    {
      constexpr double rounded = 1e-14;
      return solution.tractions[k] * (*rows)[k].normal > rounded * solution.tractions[k].norm();
    }

    /// This rank's part of x S x/2 - x b of the solution, with its residual.
    double energy() const
    {
      return -0.5 * (solution * source + solution * remaining);
    }

    /// Number of owned pressures at their bounds.
    unsigned int n_held() const
    {
      return std::count(is_held.begin(), is_held.end(), char(true));
    }

    static constexpr unsigned int most_of_search = 200; ///< iterations; then the set of what is held is kept

    Vector source;              ///< b, m^dim/s
    Vector solution;            ///< x, Pa
    double weight_of_rows = 1.; ///< of the squares of flows at rows against those of pressures, in norms

  private:
    /// All of them, of the same shape.
    std::array<Vector *, 8> vectors()
    {
      return { { &source, &solution, &remaining, &free_remaining, &preconditioned, &direction, &product, &scratch } };
    }

    /// Drops what is held: pressures, and of the rows what the ground leaves free.
    void restrict_to_free(Vector &vector) const;

    /// Sets `result` to where what is at its bound would leave it: held pressures that the flow raises, lifted rows
    /// that it presses on. Returns the sum of squares of these flows on this rank.
    double find_release(Vector &result) const;

    /// Frees what moves along a direction of find_release().
    void release(const Vector &along);

    /// How far the solution can go along the direction until an owned unknown, or a row, is at its bound.
    double step_of_pressure(const unsigned int i) const;
    double step_of_row(const unsigned int k) const;

    /// The smallest of these on this rank.
    double longest_step() const;

    /// Goes as far as that, or the smallest of all ranks; what is at its bound then is exactly there.
    void go_to_first_bound(const double length);

    /// Takes the traction of a row across the ground away.
    void lift_off(const unsigned int k);

    /// Puts what of the solution is beyond its bounds on them.
    void project();

    /// Holds what of the solution is at its bounds.
    void hold();

    /// Sum of squares on this rank, with the weight of the rows.
    double local_square(const Vector &vector) const;

    const MPI_Comm communicator;
    const Operator matrix, preconditioner;
    std::vector<GroundRow<dim>> *rows = nullptr; // null: none
    std::vector<char> is_held;                   // by owned unknown: at its bound
    std::vector<double> least, diagonal;         // by owned unknown, see set_bounds()
    // What is left of the source, its free part, that preconditioned; the direction of a step, that times S.
    Vector remaining, free_remaining, preconditioned, direction, product, scratch;
  };
} // namespace scree

#endif
