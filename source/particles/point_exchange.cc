// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/point_exchange.h>
#include <scree/deal_ii_versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/distributed/tria_base.h>

#include <utility>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PointExchange<dim>::PointExchange(const Triangulation<dim> &triangulation)
      : mesh(triangulation)
  {
  }


  template <int dim>
  void PointExchange<dim>::add(const CellIterator &cell, PointRecord<dim> &record)
  {
    record.cell = cell->id().template to_binary<dim>();
    emigrants[cell->subdomain_id()].push_back(record);
  }


  template <int dim>
  std::vector<PointRecord<dim>> PointExchange<dim>::exchange()
  {
    // Points go to ghost cells only, so that the ghost layer gives the partners. deal.II's some_to_some() asks first,
    // which takes 60 microseconds more a step on two ranks.
    const auto &neighbours      = dynamic_cast<const parallel::TriangulationBase<dim> &>(mesh).ghost_owners();
    const MPI_Comm communicator = communicator_of(mesh);
    constexpr int tag           = 1;
    std::vector<Record> immigrants;
    std::vector<std::vector<char>> messages;
    std::vector<MPI_Request> requests(neighbours.size());
    for (const unsigned int rank : neighbours)
      {
        messages.push_back(Utilities::pack(emigrants[rank], /*allow_compression=*/false));
        const int error = MPI_Isend(messages.back().data(),
                                    messages.back().size(),
                                    MPI_CHAR,
                                    rank,
                                    tag,
                                    communicator,
                                    &requests[messages.size() - 1]);
        AssertThrowMPI(error);
      }
    for (const unsigned int rank : neighbours)
      {
        MPI_Status status;
        int size, error = MPI_Probe(rank, tag, communicator, &status);
        AssertThrowMPI(error);
        error = MPI_Get_count(&status, MPI_CHAR, &size);
        AssertThrowMPI(error);
        std::vector<char> message(size);
        error = MPI_Recv(message.data(), size, MPI_CHAR, rank, tag, communicator, MPI_STATUS_IGNORE);
        AssertThrowMPI(error);
        for (Record &record : Utilities::unpack<std::vector<Record>>(message, /*allow_compression=*/false))
          immigrants.push_back(std::move(record));
      }
    const int error = MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
    emigrants.clear();
    return immigrants;
  }

  template class PointExchange<2>;
  template class PointExchange<3>;
} // namespace scree
