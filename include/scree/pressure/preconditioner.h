// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_preconditioner_h
#define scree_pressure_preconditioner_h

#include <scree/pressure/free_surface.h>
#include <scree/pressure/solver_state.h>

#include <memory>
#include <vector>

namespace scree
{
  /// Preconditioner of the pressures: an approximate inverse of L = dt sum kappa K, with the Laplacian K of one cell
  /// and the mobility kappa of the mixture's cells; vertices beside the surface enter through the unknown ones.
  ///
  /// It is made of the L of a step and kept over steps: algebraic multigrid, or of small systems on few ranks a direct
  /// solver of each rank's block.
  template <int dim>
  class PressurePreconditioner
  {
  public:
    /// Keeps references to all.
    PressurePreconditioner(const BackgroundGrid<dim> &grid,
                           const NodeNumbering<dim> &vertices,
                           const FreeSurface<dim> &surface);
    ~PressurePreconditioner();

    /// Drops what belongs to another partition of the mesh.
    void reinit();

    /// Sets L of a step. Collective.
    /// @param storage what the diagonal of a vertex gains over its volume of water: of compressible water, 1/(Pa s)
    void assemble(const Mixture<dim> &mixture, const double time_step, const double storage);

    /// Makes it of L, and writes what this rank has of that into the state. Collective.
    void make(PreconditionerState &state);

    /// Makes it of the L of a state, after reinit(), and writes to it what this rank has. Collective.
    void load(PreconditionerState &state);

    /// Sets `preconditioned` to what it makes of `remainder`, both by owned unknown: vertices that have become unknown
    /// since it was made get that over their own diagonal. Collective.
    void vmult(std::vector<double> &preconditioned, const std::vector<double> &remainder);

  private:
    static constexpr unsigned int n_vertices = 1 << dim;                       ///< vertices of a cell
    using CellMatrix = std::array<std::array<double, n_vertices>, n_vertices>; ///< matrix of a cell, by its vertices
    struct Inverse;

    /// A cell that holds water.
    struct Cell
    {
      unsigned int cell;  ///< active cell index
      double conductance; ///< dt kappa h^(dim-2), m^dim/(Pa s)
    };

    /// Of the diagonal of L, m^dim/(Pa s).
    enum Diagonal : unsigned int
    {
      whole,
      added // by surface vertices and storage
    };

    /// Sets L at the owned vertices that are unknown, with what is added to their diagonal.
    void set_unknowns(const double storage);

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    const FreeSurface<dim> &surface;
    CellMatrix laplacian; // of the unit cell

    std::vector<Cell> cells;            // of this rank
    std::vector<unsigned int> unknowns; // owned vertices
    std::vector<unsigned int> places;   // of owned vertices among the unknowns, or `none`
    NodeValues<dim, 2> diagonals;       // Diagonal
    std::unique_ptr<Inverse> inverse;   // null until it is made
    static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
  };
} // namespace scree

#endif
