// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_nodal_field_h
#define scree_mesh_nodal_field_h

#include <scree/mesh/background_grid.h>
#include <scree/mesh/node_values.h>

namespace scree
{
  /// Mass, momentum and force of one phase at the nodes; later velocity and its change.
  template <int dim>
  class NodalField : public NodeValues<dim, 1 + 2 * dim>
  {
  public:
    static constexpr unsigned int mass            = 0;           ///< kg (2D: per m)
    static constexpr unsigned int momentum        = 1;           ///< kg m/s, before the step is solved
    static constexpr unsigned int velocity        = 1;           ///< m/s at the end of the step, after it
    static constexpr unsigned int force           = 1 + dim;     ///< N, before
    static constexpr unsigned int velocity_change = 1 + dim;     ///< m/s over the step, after
    static constexpr unsigned int n_components    = 1 + 2 * dim; ///< numbers of a node

    /// Makes room on the nodes of the grid, which must live on.
    explicit NodalField(const BackgroundGrid<dim> &grid)
        : NodeValues<dim, n_components>(grid.numbering())
    {
    }

    /// Mass and momentum of the active nodes times a factor.
    void scale_inertia(const double factor)
    {
      if (factor == 1.)
        return;
      for (const unsigned int node : this->active_nodes())
        for (unsigned int c = mass; c < force; ++c)
          (*this)[node][c] *= factor;
    }
  };
} // namespace scree

#endif
