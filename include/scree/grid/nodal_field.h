// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_grid_nodal_field_h
#define scree_grid_nodal_field_h

#include <scree/grid/background_grid.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace scree
{
  /// Mass, momentum and force of one phase at the nodes; later velocity and its change. The components of a node lie
  /// together, so that a node is one cache line and one message carries all of them.
  template <int dim>
  class NodalField
  {
  public:
    static constexpr unsigned int mass            = 0;       ///< kg (2D: per m)
    static constexpr unsigned int momentum        = 1;       ///< kg m/s, before the step is solved
    static constexpr unsigned int velocity        = 1;       ///< m/s at the end of the step, after it
    static constexpr unsigned int force           = 1 + dim; ///< N, before
    static constexpr unsigned int velocity_change = 1 + dim; ///< m/s over the step, after
    static constexpr unsigned int n_components    = 1 + 2 * dim;

    explicit NodalField(const BackgroundGrid<dim> &grid);

    /// Fits the field to the grid's current nodes.
    void reinit();

    /// Empties the field and deactivates its nodes, before a new step.
    void clear();

    /// Marks the nodes of a locally owned cell as active.
    void activate_cell(const unsigned int cell)
    {
      const unsigned int *nodes = grid.nodes(cell);
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        if (!is_active[nodes[i]])
          activate(nodes[i]);
    }

    /// Sums over ranks: owned nodes hold the whole afterwards.
    void add_contributions();

    /// Hands the owners' values to the ranks that see the node as a ghost.
    void update_ghosts();

    /// The owned nodes on which any rank's points act.
    const std::vector<unsigned int> &active_nodes() const
    {
      return active_owned;
    }

    double *operator[](const unsigned int node)
    {
      return values.begin() + std::size_t(node) * n_components;
    }
    const double *operator[](const unsigned int node) const
    {
      return values.begin() + std::size_t(node) * n_components;
    }

  private:
    void activate(const unsigned int node)
    {
      is_active[node] = true;
      if (node < grid.n_owned_nodes())
        active_owned.push_back(node);
    }

    const BackgroundGrid<dim> &grid;
    dealii::LinearAlgebra::distributed::Vector<double> values;
    std::vector<unsigned int> active_owned;
    std::vector<unsigned int> shared_owned; // owned nodes that are ghosts of other ranks
    std::vector<char> is_active;
  };
} // namespace scree

#endif
