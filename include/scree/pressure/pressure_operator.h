// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pressure_operator_h
#define scree_pressure_pressure_operator_h

#include <scree/pressure/free_surface.h>
#include <scree/pressure/solver_state.h>

#include <functional>
#include <vector>

namespace scree
{
  /// The matrix L that preconditions the pressure's system: cells that hold water, and which vertices are unknown.
  ///
  /// L = dt sum kappa K with the Laplacian K of one cell and the mobility kappa of the mixture's cells; vertices beside
  /// the surface enter through the unknown ones.
  template <int dim>
  class PressureOperator
  {
  public:
    static constexpr unsigned int n_vertices = 1 << dim;                       ///< vertices of a cell
    using CellMatrix = std::array<std::array<double, n_vertices>, n_vertices>; ///< matrix of a cell, by its vertices

    /// A cell that holds water.
    struct Cell
    {
      unsigned int cell; ///< active cell index
      double mobility;   ///< dt kappa h^(dim-2), m^3/(Pa s)
    };

    /// Keeps references to both.
    PressureOperator(const BackgroundGrid<dim> &grid, const NodeNumbering<dim> &vertices);

    /// Fits it to the current vertices.
    void reinit();

    /// Sets the matrix, as PressureSolver::assemble(). Collective.
    void assemble(const Mixture<dim> &mixture,
                  const FreeSurface<dim> &surface,
                  const double time_step,
                  const std::function<double(unsigned int vertex)> &storage);

    /// Writes cells and diagonal of this rank into the state of a preconditioner that is made from them.
    void save(PreconditionerState &state) const;

    /// Sets what of them this rank has: the matrix for that preconditioner.
    void load(const PreconditionerState &state);

    /// The owned vertices whose pressure is a degree of freedom.
    const std::vector<unsigned int> &unknowns() const
    {
      return unknown_vertices;
    }

    static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int; ///< see place()

    /// Place of an owned vertex among the unknowns, or `none`.
    unsigned int place(const unsigned int vertex) const
    {
      return places[vertex];
    }

    /// The diagonal of L at an unknown, m^3/(Pa s).
    double diagonal_of(const unsigned int vertex) const
    {
      return diagonals[vertex][whole];
    }

    /// What surface vertices and storage add to it.
    double added_to_diagonal(const unsigned int vertex) const
    {
      return diagonals[vertex][added];
    }

    /// Cells of this rank that hold water.
    const std::vector<Cell> &cells() const
    {
      return wet_cells;
    }

    /// The vertices of a cell, in deal.II's order.
    const unsigned int *vertices_of(const Cell &cell) const
    {
      return vertices.nodes(cell.cell);
    }

    /// What a cell adds to L, by its vertices.
    CellMatrix matrix(const Cell &cell) const
    {
      CellMatrix own;
      for (unsigned int v = 0; v < n_vertices; ++v)
        for (unsigned int w = 0; w < n_vertices; ++w)
          own[v][w] = cell.mobility * laplacian[v][w];
      return own;
    }

    /// Makes room for a number a vertex.
    void reinit(VertexVector &vector) const
    {
      vector.reinit(vertices.partitioner());
    }

    /// Communicator of the mesh.
    MPI_Comm communicator() const
    {
      return grid.communicator();
    }

  private:
    /// Of the diagonal of L, m^3/(Pa s).
    enum Diagonal : unsigned int
    {
      whole,
      added // by surface vertices and storage
    };

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    CellMatrix laplacian; // of the unit cell

    std::vector<Cell> wet_cells;
    std::vector<unsigned int> unknown_vertices, places; // see unknowns(); by owned vertex
    NodeValues<dim, 2> diagonals;                       // Diagonal
  };
} // namespace scree

#endif
