// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/grid/nodal_field.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  NodalField<dim>::NodalField(const BackgroundGrid<dim> &grid)
      : grid(grid)
  {
    reinit();
  }


  template <int dim>
  void NodalField<dim>::reinit()
  {
    const auto &nodes = *grid.node_partitioner();
    const auto range  = nodes.local_range();
    const IndexSet ghosts(nodes.ghost_indices());

    IndexSet owned_values(nodes.size() * n_components), ghost_values(nodes.size() * n_components);
    owned_values.add_range(range.first * n_components, range.second * n_components);
    for (const auto node : ghosts)
      ghost_values.add_range(node * n_components, (node + 1) * n_components);
    values.reinit(owned_values, ghost_values, nodes.get_mpi_communicator());

    is_active.assign(nodes.locally_owned_size() + nodes.n_ghost_indices(), false);
    active_owned.clear();
    shared_owned.clear();
    for (const auto &shared : nodes.import_indices())
      for (unsigned int node = shared.first; node < shared.second; ++node)
        shared_owned.push_back(node);
    std::sort(shared_owned.begin(), shared_owned.end());
    shared_owned.erase(std::unique(shared_owned.begin(), shared_owned.end()), shared_owned.end());
  }


  template <int dim>
  void NodalField<dim>::clear()
  {
    for (const unsigned int node : active_owned)
      {
        std::fill_n((*this)[node], n_components, 0.);
        is_active[node] = false;
      }
    values.zero_out_ghost_values();
    std::fill(is_active.begin() + grid.n_owned_nodes(), is_active.end(), false);
    active_owned.clear();
    // Another rank's points may act on these, unknown to us.
    for (const unsigned int node : shared_owned)
      activate(node);
  }


  template <int dim>
  void NodalField<dim>::add_contributions()
  {
    values.compress(VectorOperation::add);
  }


  template <int dim>
  void NodalField<dim>::update_ghosts()
  {
    values.update_ghost_values();
  }

  template class NodalField<2>;
  template class NodalField<3>;
} // namespace scree
