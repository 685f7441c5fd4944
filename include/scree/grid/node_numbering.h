// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_grid_node_numbering_h
#define scree_grid_node_numbering_h

#include <scree/grid/cell_basis.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/distributed/tria.h>

#include <memory>
#include <vector>

namespace scree
{
  /// Shape functions of the background grid.
  enum class Basis
  {
    spline,    ///< C1 quadratic B-splines with open knots at the walls
    quadratic, ///< C0 quadratic Bernstein polynomials
    linear     ///< linear functions
  };

  /// The nodes of a basis on the mesh.
  ///
  /// deal.II has no B-splines, but the free coefficients of the C1 quadratic splines are those Bernstein coefficients
  /// that sit inside a cell or on the boundary of the box: a coefficient on an interior face is the mean of its two
  /// neighbours. A *node* is such a free coefficient; each cell stores the 3^dim nodes (2^dim of the linear basis) that
  /// act on it. Nodes are numbered compactly: [0, n_owned()) are this rank's, then come the ghosts.
  template <int dim>
  class NodeNumbering
  {
  public:
    /// No nodes yet.
    explicit NodeNumbering(const Basis basis);

    /// Numbers the nodes for the current partition of a mesh of cubes `width` m wide. Collective.
    void distribute(const dealii::parallel::distributed::Triangulation<dim> &mesh, const double width);

    /// Nodes along one axis of a cell: 3 (quadratic) or 2 (linear).
    unsigned int n_nodes_1d() const
    {
      return basis == Basis::linear ? 2 : 3;
    }

    unsigned int n_nodes_per_cell() const
    {
      return dealii::Utilities::pow(n_nodes_1d(), dim);
    }

    /// This rank's node indices on a locally owned cell, lexicographic, n_nodes_per_cell() of them.
    const unsigned int *nodes(const unsigned int cell) const
    {
      return &cell_nodes[std::size_t(cell) * n_nodes_per_cell()];
    }

    OpenKnots open_knots(const unsigned int cell) const
    {
      return cell_open_knots[cell];
    }

    unsigned int n_owned() const
    {
      return distribution->locally_owned_size();
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
    /// Fills what is known of nodes and cells, but the open knots.
    /// @param global_nodes of owned cells, in the order of `cell_nodes`
    void place_nodes(const dealii::Triangulation<dim> &mesh,
                     const double width,
                     const std::vector<dealii::types::global_dof_index> &global_nodes);

    const Basis basis;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> distribution;
    std::vector<unsigned int> cell_nodes;   // of owned cells, by active cell index
    std::vector<OpenKnots> cell_open_knots; // by active cell index
    std::vector<dealii::Point<dim>> positions;
    std::vector<std::uint8_t> face_flags;
  };
} // namespace scree

#endif
