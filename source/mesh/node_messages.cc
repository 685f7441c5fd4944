// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/node_messages.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

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
} // namespace scree
