// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_filled_part_h
#define scree_pressure_filled_part_h

#include <scree/boundary/ground_gaps.h>
#include <scree/mesh/node_rows.h>
#include <scree/pressure/free_surface.h>

#include <functional>
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

    using HoldsNode = std::function<bool(const unsigned int node, const unsigned int face)>; ///< see find()

    /// A cell that water fills or cuts.
    struct Cell
    {
      unsigned int cell;                          ///< active cell index
      unsigned int record;                        ///< of the mixture
      unsigned int integrals;                     ///< their number, see divergence() and volumes()
      double fraction;                            ///< of the volume of the whole cell
      std::array<VertexRow<dim>, dim> hat_slopes; ///< d psi_a/dx_c at the centre of the part, 1/m: by axis, lanes a
      std::array<double, n_vertices> allowed;     ///< int psi_a of the flow into the ground, m^dim/s
    };

    /// All are kept by reference.
    /// @param vertices the numbering of linear functions on the grid
    /// @param cut_cells what rigid ground leaves of the cells; null: all
    FilledPart(const BackgroundGrid<dim> &grid,
               const NodeNumbering<dim> &vertices,
               const FreeSurface<dim> &surface,
               const CutCells<dim> *cut_cells,
               const GroundGaps<dim> &gaps);

    /// Finds the parts of the cells of a mixture whose surface is known.
    /// @param holds whether water does not move through a face of the box at a node on that
    void find(const Mixture<dim> &mixture, const HoldsNode &holds, const double time_step);

    /// Cells that have a part, in the order of the mixture.
    const std::vector<Cell> &cells() const
    {
      return with_water;
    }

    /// Integrals of psi_a d phi_i/dx_c over the part of a cell, less those of psi_a phi_i nu_c over the ground and
    /// the walls that bound it, m^(dim-1): by node i and axis c, the axes of a node behind each other; lanes a.
    const VertexRow<dim> *divergence(const Cell &cell) const
    {
      return &divergences[cell.integrals * grid.n_nodes_per_cell() * dim];
    }

    /// Integrals of phi_i over the part of a cell, m^dim: rows of nodes.
    const NodeRow *volumes(const Cell &cell) const
    {
      return &all_volumes[cell.integrals * n_rows];
    }

    /// Rows of nodes of a cell.
    const unsigned int n_rows;

  private:
    /// Adds the integrals of a part, without what bounds it; returns their number.
    unsigned int add_integrals(const CubicWeights<dim> &part, const OpenKnots open);

    /// Takes a part into the cells.
    void add(const unsigned int cell,
             const unsigned int record,
             const CubicWeights<dim> &part,
             const unsigned int integrals);

    using AtVertices = std::array<double, n_vertices>; // a number a vertex

    /// The part of a cell whose vertices have these depths, cells.
    CubicWeights<dim> part_of(const std::vector<Simplex<dim>> &open, const AtVertices &depths) const;

    /// Faces of the box with a cell through which nothing flows, or which prescribe a pressure other than 0, as bits.
    unsigned int faces_of_box(const unsigned int cell, const HoldsNode &holds) const;

    /// Takes the flow through the wet part of a face of the unit cell into the integrals of that number; returns those
    /// of the vertices' functions, m^(dim-1).
    /// @param normal unit, out of the cell
    AtVertices add_face(const SimplexFace<dim> &face,
                        const dealii::Tensor<1, dim> &normal,
                        const AtVertices &depths,
                        const OpenKnots open,
                        const unsigned int integrals);

    /// The same through faces of the box on which simplices of the cell lie.
    void add_box(const std::vector<Simplex<dim>> &simplices,
                 const unsigned int faces,
                 const AtVertices &depths,
                 const OpenKnots open,
                 const unsigned int integrals);

    /// The same through the ground on which the pressure acts, in the last one of the cells.
    void add_ground(const CutCell<dim> &cut, const AtVertices &depths, const OpenKnots open, const double time_step);

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    const FreeSurface<dim> &surface;
    const CutCells<dim> *cut_cells; // may be null
    const GroundGaps<dim> &gaps;
    const std::vector<Simplex<dim>> unit_cube;
    const CubicWeights<dim> whole;
    std::map<unsigned int, unsigned int> integrals_of_whole; // by knots and faces; they have the first numbers
    std::vector<VertexRow<dim>> divergences;                 // by number of the integrals
    std::vector<NodeRow> all_volumes;                        // by number of the integrals
    std::vector<Cell> with_water;
  };
} // namespace scree

#endif
