// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_node_numbering_h
#define scree_mesh_node_numbering_h

#include <scree/mesh/cell_basis.h>
#include <scree/mesh/fine_cells.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <memory>

namespace scree
{
  /// Shape functions of the background grid.
  enum class Basis
  {
    spline, ///< C1 quadratic B-splines with open knots at the walls
    linear  ///< linear functions
  };

  /// The nodes of a basis on the mesh.
  ///
  /// deal.II has no B-splines, but the free coefficients of the C1 quadratic splines are those Bernstein coefficients
  /// that sit inside a cell or on the boundary of the box: a coefficient on an interior face is the mean of its two
  /// neighbours. A *node* is such a free coefficient; each cell stores the 3^dim nodes (2^dim of the linear basis) that
  /// act on it. Nodes are numbered compactly: [0, n_owned()) are this rank's, then come the ghosts.
  ///
  /// Along an axis cell i of the box has the nodes i, i + 1 (, i + 2). A node j lives in the cell j - 1, whose rank
  /// owns it. Where that cell is not fine, the node is one of this rank alone: no points may act on it, see
  /// CellUse::edge.
  template <int dim>
  class NodeNumbering
  {
  public:
    /// No nodes yet.
    explicit NodeNumbering(const Basis basis)
        : basis(basis)
    {
    }

    /// Numbers the nodes of the fine cells. Collective.
    void distribute(const FineCells<dim> &cells);

    /// Nodes along one axis of a cell: 3 (spline) or 2 (linear).
    unsigned int n_nodes_1d() const
    {
      return basis == Basis::linear ? 2 : 3;
    }

    /// Nodes that act on a cell: 3^dim (spline) or 2^dim (linear).
    unsigned int n_nodes_per_cell() const
    {
      return dealii::Utilities::pow(n_nodes_1d(), dim);
    }

    /// This rank's node indices on a fine cell of its own, lexicographic, n_nodes_per_cell() of them.
    const unsigned int *nodes(const unsigned int cell) const
    {
      return &cell_nodes[std::size_t(cell) * n_nodes_per_cell()];
    }

    /// The walls of the box that a fine cell touches, where knots of the basis are open.
    OpenKnots open_knots(const unsigned int cell) const
    {
      return cell_open_knots[cell];
    }

    /// Whether nodes were numbered on the cell: it is a fine one of this rank.
    bool has_nodes(const unsigned int cell) const
    {
      return cell_nodes[std::size_t(cell) * n_nodes_per_cell()] != dealii::numbers::invalid_unsigned_int;
    }

    /// Number of nodes that this rank owns.
    unsigned int n_owned() const
    {
      return distribution->locally_owned_size();
    }

    /// Nodes of this rank's cells, ghosts included.
    unsigned int n_local() const
    {
      return positions.size();
    }

    /// The distribution of nodes over ranks.
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &partitioner() const
    {
      return distribution;
    }

    /// Where a node sits (Greville abscissa), m.
    const dealii::Point<dim> &position(const unsigned int node) const
    {
      return positions[node];
    }

    /// The faces of the box a node lies on: bit f for face f (deal.II's numbering).
    std::uint8_t faces(const unsigned int node) const
    {
      return face_flags[node];
    }

  private:
    using Cell = typename FineCells<dim>::Cell;

    /// Numbers of the nodes that live in the cells, by cell of FineCells::cells() and place in the cell; `none` for
    /// nodes that live elsewhere.
    using Homes                        = std::vector<dealii::types::global_dof_index>;
    static constexpr unsigned int none = FineCells<dim>::none;

    /// Node `i` of a cell: the place of the cell it lives in, and which one of that cell's it is.
    std::pair<CellPlace<dim>, unsigned int>
    home(const CellPlace<dim> &cell, const unsigned int i, const CellPlace<dim> &n) const;

    /// Numbers the nodes that live in this rank's cells, from 0.
    Homes number_own(const FineCells<dim> &cells, unsigned int &n_owned) const
    {
      const unsigned int n_nodes = n_nodes_per_cell();
      Homes homes(cells.cells().size() * n_nodes, none);
      n_owned = 0;
      for (unsigned int c = 0; c < cells.cells().size(); ++c)
        if (const Cell &cell = cells.cells()[c]; cells.is_owned(cell))
          for (unsigned int i = 0; i < n_nodes; ++i)
            if (home(cell.place, i, cells.box().n).first == cell.place)
              homes[std::size_t(c) * n_nodes + i] = n_owned++;
      return homes;
    }

    /// Makes the numbers those of all ranks, and fetches those of the ghost cells. Collective.
    void exchange(const FineCells<dim> &cells, const dealii::types::global_dof_index first, Homes &homes) const;

    /// The numbers on all ranks of the nodes of this rank's cells, by active cell index.
    /// @param homes with the numbers of this rank's nodes that live in its cells
    std::vector<dealii::types::global_dof_index>
    number_all(const FineCells<dim> &cells, Homes &homes, unsigned int n_owned);

    /// Fills what is known of nodes and cells.
    /// @param global_nodes of owned cells, in the order of `cell_nodes`
    void place_nodes(const FineCells<dim> &cells, const std::vector<dealii::types::global_dof_index> &global_nodes);

    const Basis basis;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> distribution;
    std::vector<unsigned int> cell_nodes;   // of owned fine cells, by active cell index
    std::vector<OpenKnots> cell_open_knots; // by active cell index
    std::vector<dealii::Point<dim>> positions;
    std::vector<std::uint8_t> face_flags;
  };
} // namespace scree

#endif
