// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/node_values.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr int tag = 3; // of these messages
  }


  template <int dim>
  void NodeMessages<dim>::reinit()
  {
    const auto &partitioner = *numbering.partitioner();
    std::map<unsigned int, Neighbour> by_rank;
    unsigned int ghost = numbering.n_owned();
    for (const auto &[rank, n] : partitioner.ghost_targets())
      {
        by_rank[rank].first_ghost = ghost;
        by_rank[rank].n_ghosts    = n;
        ghost += n;
      }
    Nodes imported;
    for (const auto &[first, last] : partitioner.import_indices())
      for (unsigned int node = first; node < last; ++node)
        imported.push_back(node);
    auto next = imported.begin();
    for (const auto &[rank, n] : partitioner.import_targets())
      {
        by_rank[rank].shared.assign(next, next + n);
        next += n;
      }
    neighbours.clear();
    for (auto &[rank, neighbour] : by_rank)
      {
        neighbour.rank = rank;
        neighbours.push_back(std::move(neighbour));
      }
  }


  template <int dim>
  void NodeMessages<dim>::begin(const std::vector<unsigned int> &ghosts)
  {
    const MPI_Comm communicator = numbering.partitioner()->get_mpi_communicator();
    for (Neighbour &neighbour : neighbours)
      {
        neighbour.ghosts.clear();
        for (const unsigned int node : ghosts)
          if (node >= neighbour.first_ghost && node < neighbour.first_ghost + neighbour.n_ghosts)
            neighbour.ghosts.push_back(node);
        neighbour.sent.clear();
        for (const unsigned int node : neighbour.ghosts)
          neighbour.sent.push_back(node - neighbour.first_ghost);
        if (neighbour.n_ghosts == 0)
          continue;
        requests.emplace_back();
        const int error = MPI_Isend(neighbour.sent.data(),
                                    neighbour.sent.size(),
                                    MPI_DOUBLE,
                                    neighbour.rank,
                                    tag,
                                    communicator,
                                    &requests.back());
        AssertThrowMPI(error);
      }
    for (Neighbour &neighbour : neighbours)
      {
        neighbour.owned.clear();
        if (neighbour.shared.empty())
          continue;
        MPI_Status status;
        int n = 0, error = MPI_Probe(neighbour.rank, tag, communicator, &status);
        AssertThrowMPI(error);
        error = MPI_Get_count(&status, MPI_DOUBLE, &n);
        AssertThrowMPI(error);
        neighbour.received.resize(n);
        error =
            MPI_Recv(neighbour.received.data(), n, MPI_DOUBLE, neighbour.rank, tag, communicator, MPI_STATUS_IGNORE);
        AssertThrowMPI(error);
        for (const double place : neighbour.received)
          neighbour.owned.push_back(neighbour.shared[static_cast<unsigned int>(place)]);
      }
    const int error = MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
    requests.clear();
  }


  template <int dim>
  void NodeMessages<dim>::send_and_receive()
  {
    const MPI_Comm communicator = numbering.partitioner()->get_mpi_communicator();
    const auto post             = [&](const auto &function, std::vector<double> &numbers, const unsigned int rank) {
      if (numbers.empty())
        return;
      requests.emplace_back();
      const int error = function(numbers.data(), numbers.size(), MPI_DOUBLE, rank, tag, communicator, &requests.back());
      AssertThrowMPI(error);
    };
    for (Neighbour &neighbour : neighbours)
      post(MPI_Irecv, neighbour.received, neighbour.rank);
    for (Neighbour &neighbour : neighbours)
      post(MPI_Isend, neighbour.sent, neighbour.rank);
    const int error = MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
    requests.clear();
  }

  template class NodeMessages<2>;
  template class NodeMessages<3>;


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
  template class NodeValues<2, 8>;  // Pores; normals to choose from, between bodies
  template class NodeValues<3, 9>;  // Pores
  template class NodeValues<2, 16>; // linear functions about vertices, see VolumeProjection
  template class NodeValues<3, 11>;
  template class NodeValues<3, 20>;
  template class NodeValues<2, 18>; // moments of the points of two bodies
  template class NodeValues<3, 28>;
} // namespace scree
