// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/node_values.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim, int n>
  NodeValues<dim, n>::NodeValues(const NodeNumbering<dim> &numbering)
      : numbering(numbering)
  {
    reinit();
  }


  template <int dim, int n>
  void NodeValues<dim, n>::reinit()
  {
    const auto &nodes = *numbering.partitioner();
    const auto range  = nodes.local_range();
    const IndexSet ghosts(nodes.ghost_indices());

    IndexSet owned_values(nodes.size() * n), ghost_values(nodes.size() * n);
    owned_values.add_range(range.first * n, range.second * n);
    for (const auto node : ghosts)
      ghost_values.add_range(node * n, (node + 1) * n);
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


  template <int dim, int n>
  void NodeValues<dim, n>::clear()
  {
    for (const unsigned int node : active_owned)
      {
        std::fill_n((*this)[node], n, 0.);
        is_active[node] = false;
      }
    values.zero_out_ghost_values();
    std::fill(is_active.begin() + numbering.n_owned(), is_active.end(), false);
    active_owned.clear();
    // Another rank's points may act on these, unknown to us.
    for (const unsigned int node : shared_owned)
      activate(node);
  }


  template <int dim, int n>
  void NodeValues<dim, n>::add_contributions()
  {
    values.compress(VectorOperation::add);
  }


  template <int dim, int n>
  void NodeValues<dim, n>::take_largest()
  {
    values.compress(VectorOperation::max);
  }


  template <int dim, int n>
  void NodeValues<dim, n>::clear_ghosts()
  {
    values.zero_out_ghost_values();
  }


  template <int dim, int n>
  void NodeValues<dim, n>::update_ghosts()
  {
    values.update_ghost_values();
  }

  template class NodeValues<2, 1>;
  template class NodeValues<2, 2>;
  template class NodeValues<3, 1>;
  template class NodeValues<3, 2>;
  template class NodeValues<2, 3>;
  template class NodeValues<3, 3>;
  template class NodeValues<2, 4>; // pressure forces on soil and water
  template class NodeValues<3, 4>;
  template class NodeValues<2, 5>; // NodalField in 2D
  template class NodeValues<3, 6>;
  template class NodeValues<3, 7>;
  template class NodeValues<2, 8>; // normals to choose from, between bodies
  template class NodeValues<3, 11>;
  template class NodeValues<2, 18>; // moments of the points of two bodies
  template class NodeValues<3, 28>;
} // namespace scree
