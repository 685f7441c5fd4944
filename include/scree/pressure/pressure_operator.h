// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pressure_operator_h
#define scree_pressure_pressure_operator_h

#include <scree/pressure/pressure_numbering.h>

#include <functional>
#include <vector>

namespace scree
{
  /// The matrix L that preconditions the pressure's system: cells that hold water, and which vertices are unknown.
  ///
  /// L = dt sum kappa K with the Laplacian K of one cell and the mobility kappa of the mixture's cells; vertices beside
  /// the surface enter through the unknown ones. Vectors are by local number of a PressureNumbering.
  template <int dim>
  class PressureOperator
  {
  public:
    static constexpr unsigned int n_vertices = 1 << dim;                       ///< vertices of a cell
    using CellMatrix = std::array<std::array<double, n_vertices>, n_vertices>; ///< matrix of a cell, by its vertices

    /// A cell that holds water.
    struct Cell
    {
      std::array<unsigned int, n_vertices> numbers; ///< local numbers of its vertices
      double mobility;                              ///< dt kappa h^(dim-2), m^3/(Pa s)
    };

    /// Keeps references to all of them.
    PressureOperator(const BackgroundGrid<dim> &grid,
                     const NodeNumbering<dim> &vertices,
                     const PressureNumbering<dim> &numbering);

    /// Fits the vectors to new numbers.
    void reinit();

    /// Sets the matrix, as PressureSolver::assemble(). Collective.
    void assemble(const Mixture<dim> &mixture,
                  const FreeSurface<dim> &surface,
                  const double time_step,
                  const std::function<double(unsigned int vertex)> &storage);

    /// Whether the pressure of a local number is a degree of freedom.
    bool is_unknown(const unsigned int number) const
    {
      return unknown[number];
    }

    /// How many numbers this rank owns.
    unsigned int n_owned() const
    {
      return diagonal.size();
    }

    /// The diagonal of L at an owned unknown number, m^3/(Pa s).
    double diagonal_of(const unsigned int number) const
    {
      return whole_diagonal.local_element(number);
    }

    /// What surface vertices and storage add to it.
    double added_to_diagonal(const unsigned int number) const
    {
      return diagonal[number];
    }

    /// Cells of this rank that hold water.
    const std::vector<Cell> &cells() const
    {
      return wet_cells;
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

    /// Numbering of the vectors.
    const PressureNumbering<dim> &numbers() const
    {
      return numbering;
    }

    /// Communicator of the mesh.
    MPI_Comm communicator() const
    {
      return grid.communicator();
    }

  private:
    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    const PressureNumbering<dim> &numbering;
    CellMatrix laplacian; // of the unit cell

    std::vector<Cell> wet_cells;
    std::vector<char> unknown;    // by number
    std::vector<double> diagonal; // what surface vertices and storage add, by owned number
    VertexVector beside_surface;  // what the surface vertices do
    VertexVector whole_diagonal;  // of the owned unknown numbers, m^3/(Pa s)
  };
} // namespace scree

#endif
