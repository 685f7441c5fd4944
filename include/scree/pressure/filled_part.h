// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_filled_part_h
#define scree_pressure_filled_part_h

#include <scree/pressure/free_surface.h>

#include <map>
#include <vector>

namespace scree
{
  /// The part of the cells that water fills, with the grains in it: where the depth of the vertices, linear in each
  /// simplex of a cell, is positive, and the ground leaves it open. Integrals over it say what the pressure does.
  template <int dim>
  class FilledPart
  {
  public:
    static constexpr unsigned int n_vertices = 1 << dim; ///< vertices of a cell

    /// A cell that water fills or cuts.
    struct Cell
    {
      unsigned int cell;                                         ///< active cell index
      unsigned int record;                                       ///< of the mixture
      unsigned int integrals;                                    ///< where they begin, see divergence() and volumes()
      double fraction;                                           ///< of the volume of the whole cell
      std::array<dealii::Tensor<1, dim>, n_vertices> hat_slopes; ///< grad psi_a at the centre of the part, 1/m
    };

    /// All are kept by reference.
    /// @param vertices the numbering of linear functions on the grid
    /// @param cut_cells what rigid ground leaves of the cells; null: all
    FilledPart(const BackgroundGrid<dim> &grid,
               const NodeNumbering<dim> &vertices,
               const FreeSurface<dim> &surface,
               const CutCells<dim> *cut_cells);

    /// Finds the parts of the cells of a mixture whose surface is known.
    void find(const Mixture<dim> &mixture);

    /// Cells that have a part, in the order of the mixture.
    const std::vector<Cell> &cells() const
    {
      return with_water;
    }

    /// Integrals of psi_a d phi_i/dx_c over the part of a cell, m^(dim-1): rows of nodes i, by axis c and vertex a.
    const NodeRow *divergence(const Cell &cell, const unsigned int axis, const unsigned int vertex) const
    {
      return &all_integrals[cell.integrals + (axis * n_vertices + vertex) * n_rows];
    }

    /// Integrals of phi_i over the part of a cell, m^dim: rows of nodes.
    const NodeRow *volumes(const Cell &cell) const
    {
      return &all_integrals[cell.integrals + dim * n_vertices * n_rows];
    }

    /// Rows of nodes of a cell.
    const unsigned int n_rows;

  private:
    /// Adds the integrals to `all_integrals`; returns where they begin.
    unsigned int add_integrals(const CubicWeights<dim> &part, const OpenKnots open);

    template <int n>
    void integrate(const CubicWeights<dim> &part, const OpenKnots open, NodeRow *integrals) const;

    /// Takes a part into the cells.
    void add(const unsigned int cell,
             const unsigned int record,
             const CubicWeights<dim> &part,
             const unsigned int integrals);

    /// The part of a cell with these depths, cells, at its vertices.
    CubicWeights<dim> part_of(const std::vector<Simplex<dim>> &open,
                              const std::array<double, n_vertices> &depths) const;

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    const FreeSurface<dim> &surface;
    const CutCells<dim> *cut_cells; // may be null
    const std::vector<Simplex<dim>> unit_cube;
    CubicWeights<dim> whole;
    std::map<OpenKnots, unsigned int> integrals_of_whole; // at the front of all_integrals
    std::size_t end_of_whole = 0;
    std::vector<NodeRow> all_integrals;
    std::vector<Cell> with_water;
  };
} // namespace scree

#endif
