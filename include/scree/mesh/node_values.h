// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_node_values_h
#define scree_mesh_node_values_h

#include <scree/mesh/node_numbering.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace scree
{
  /// `n` numbers a node. The components of a node lie together, so that a node is one cache line and one message
  /// carries all of them. Only active nodes are touched: an empty cell costs nothing.
  template <int dim, int n>
  class NodeValues
  {
  public:
    /// Makes room on the nodes of the numbering, which must live on.
    explicit NodeValues(const NodeNumbering<dim> &numbering);

    /// Fits the values to the current nodes.
    void reinit();

    /// Empties the values and deactivates their nodes, before a new step.
    void clear();

    /// Marks the nodes of a locally owned cell as active.
    void activate_cell(const unsigned int cell)
    {
      const unsigned int *nodes = numbering.nodes(cell);
      for (unsigned int i = 0; i < numbering.n_nodes_per_cell(); ++i)
        if (!is_active[nodes[i]])
          activate(nodes[i]);
    }

    /// Sums over ranks: owned nodes hold the whole afterwards.
    void add_contributions();

    /// Takes the largest of the ranks' values, none of which is negative: owned nodes hold it afterwards.
    void take_largest();

    /// Hands the owners' values to the ranks that see the node as a ghost.
    void update_ghosts();

    /// Drops what this rank holds of the ghosts, before it adds to them again.
    void clear_ghosts();

    /// The owned nodes on which any rank's points act.
    const std::vector<unsigned int> &active_nodes() const
    {
      return active_owned;
    }

    /// The `n` numbers of a node of this rank's cells, ghosts included.
    double *operator[](const unsigned int node)
    {
      return values.begin() + std::size_t(node) * n;
    }

    /// Read-only access.
    const double *operator[](const unsigned int node) const
    {
      return values.begin() + std::size_t(node) * n;
    }

  private:
    void activate(const unsigned int node)
    {
      is_active[node] = true;
      if (node < numbering.n_owned())
        active_owned.push_back(node);
    }

    const NodeNumbering<dim> &numbering;
    dealii::LinearAlgebra::distributed::Vector<double> values;
    std::vector<unsigned int> active_owned;
    std::vector<unsigned int> shared_owned; // owned nodes that are ghosts of other ranks
    std::vector<char> is_active;
  };
} // namespace scree

#endif
