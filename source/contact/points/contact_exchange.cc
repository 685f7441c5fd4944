// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/points/contact_exchange.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr int tag = 2; // of messages between contact nodes
  }


  template <int dim>
  ContactExchange<dim>::ContactExchange(const BackgroundGrid<dim> &grid, ContactDofs<dim> &nodes)
      : grid(grid)
      , nodes(nodes)
  {
    reinit();
  }


  template <int dim>
  std::map<unsigned int, std::vector<types::global_dof_index>> ContactExchange<dim>::shared_nodes() const
  {
    const auto &partitioner = *grid.numbering().partitioner();
    std::map<unsigned int, std::vector<types::global_dof_index>> shared;
    unsigned int next = partitioner.locally_owned_size();
    for (const auto &[rank, n] : partitioner.ghost_targets())
      for (const unsigned int last = next + n; next < last; ++next)
        shared[rank].push_back(partitioner.local_to_global(next));

    std::vector<unsigned int> imported;
    for (const auto &[first, last] : partitioner.import_indices())
      for (unsigned int node = first; node < last; ++node)
        imported.push_back(node);
    std::map<unsigned int, std::vector<unsigned int>> ranks_of_node;
    auto node = imported.begin();
    for (const auto &[rank, n] : partitioner.import_targets())
      for (unsigned int k = 0; k < n; ++k, ++node)
        {
          shared[rank].push_back(partitioner.local_to_global(*node));
          ranks_of_node[*node].push_back(rank);
        }

    // Two ranks may know a node that a third one owns.
    using Pair = std::array<types::global_dof_index, 2>;
    std::map<unsigned int, std::vector<Pair>> to_send;
    for (const auto &[number, ranks] : ranks_of_node)
      for (const unsigned int to : ranks)
        for (const unsigned int other : ranks)
          if (other != to)
            to_send[to].push_back({ { partitioner.local_to_global(number), other } });
    for (const auto &[owner, pairs] : Utilities::MPI::some_to_some(partitioner.get_mpi_communicator(), to_send))
      for (const auto &[global, other] : pairs)
        shared[other].push_back(global);
    return shared;
  }


  template <int dim>
  void ContactExchange<dim>::reinit()
  {
    neighbours.clear();
    const auto &partitioner = *grid.numbering().partitioner();
    if (Utilities::MPI::n_mpi_processes(partitioner.get_mpi_communicator()) == 1)
      return;
    std::vector<unsigned int> n_others(grid.numbering().n_local(), 0);
    for (auto &[rank, shared] : shared_nodes())
      {
        std::sort(shared.begin(), shared.end());
        neighbours.emplace_back();
        neighbours.back().rank = rank;
        for (const auto global : shared)
          {
            neighbours.back().nodes.push_back(partitioner.global_to_local(global));
            ++n_others[neighbours.back().nodes.back()];
          }
      }
    for (Neighbour &neighbour : neighbours)
      for (const unsigned int node : neighbour.nodes)
        neighbour.is_known_to_more.push_back(n_others[node] > 1);
  }


  template <int dim>
  int ContactExchange<dim>::last_before(const Turns turns, const unsigned int position) const
  {
    int last = position;
    while (--last >= 0 && !(turns >> turn_at(last) & 1))
      ;
    return last;
  }


  template <int dim>
  template <typename T>
  void ContactExchange<dim>::post(const std::vector<T> &message, const unsigned int rank)
  {
    requests.emplace_back();
    const int error = MPI_Isend(message.data(),
                                message.size() * sizeof(T),
                                MPI_BYTE,
                                rank,
                                tag,
                                grid.triangulation().get_communicator(),
                                &requests.back());
    AssertThrowMPI(error);
  }


  template <int dim>
  void ContactExchange<dim>::wait()
  {
    const int error = MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
    requests.clear();
    messages.clear();
  }


  template <int dim>
  void ContactExchange<dim>::send_records()
  {
    for (Neighbour &neighbour : neighbours)
      {
        neighbour.records.clear();
        for (unsigned int k = 0; k < neighbour.nodes.size(); ++k)
          if (const unsigned int number = nodes.find(neighbour.nodes[k]); number != ContactDofs<dim>::free)
            {
              const NodeRow change = nodes.motion(number) - to_row<dim>(nodes.before(number));
              neighbour.records.push_back({ k, nodes.turns(number), {} });
              std::copy_n(&change[0], dim, neighbour.records.back().change.begin());
            }
        post(neighbour.records, neighbour.rank);
      }
  }


  template <int dim>
  void ContactExchange<dim>::receive_records(Neighbour &neighbour, const NodalField<dim> &field)
  {
    const MPI_Comm communicator = grid.triangulation().get_communicator();
    MPI_Status status;
    int size, error = MPI_Probe(neighbour.rank, tag, communicator, &status);
    AssertThrowMPI(error);
    error = MPI_Get_count(&status, MPI_BYTE, &size);
    AssertThrowMPI(error);
    records.resize(size / sizeof(Record));
    error = MPI_Recv(records.data(), size, MPI_BYTE, neighbour.rank, tag, communicator, MPI_STATUS_IGNORE);
    AssertThrowMPI(error);

    // Both lists are in the order of the shared nodes.
    neighbour.entries.clear();
    const auto add = [&](const unsigned int k, const Turns own, const Turns others) {
      neighbour.entries.push_back(
          { nodes.add(neighbour.nodes[k], field), bool(neighbour.is_known_to_more[k]), own, others });
    };
    auto own = neighbour.records.begin();
    for (const Record &record : records)
      {
        for (; own != neighbour.records.end() && own->node < record.node; ++own)
          add(own->node, own->turns, 0);
        const bool is_own = own != neighbour.records.end() && own->node == record.node;
        add(record.node, is_own ? own->turns : 0, record.turns);
        own += is_own;
        NodeRow &motion = nodes.motion(neighbour.entries.back().number);
        for (unsigned int c = 0; c < dim; ++c)
          motion[c] += record.change[c];
      }
    for (; own != neighbour.records.end(); ++own)
      add(own->node, own->turns, 0);
  }


  template <int dim>
  void
  ContactExchange<dim>::begin(const NodalField<dim> &field, const unsigned int n_turns, const unsigned int n_sweeps)
  {
    this->n_turns = n_turns;
    n_positions   = n_turns * n_sweeps;
    send_records();
    for (Neighbour &neighbour : neighbours)
      {
        receive_records(neighbour, field);
        neighbour.sent = neighbour.received = Stream();
        const auto add_causes               = [](Stream &stream, const Turns change, const Turns read) {
          for (Turns rest = read; rest != 0; rest &= rest - 1)
            stream.causes[__builtin_ctzll(rest)] |= change;
        };
        for (const Entry &entry : neighbour.entries)
          {
            add_causes(neighbour.sent, entry.own, entry.others);
            add_causes(neighbour.received, entry.others, entry.own);
          }
      }
    latest.assign(neighbours.empty() ? 0 : nodes.size(), -1);
  }


  template <int dim>
  void ContactExchange<dim>::send(Neighbour &neighbour, const bool is_end)
  {
    messages.emplace_back();
    std::vector<double> &message = messages.back();
    for (const Entry &entry : neighbour.entries)
      if (has(entry.own, entry.others, neighbour.sent.since, is_end))
        {
          const NodeRow &motion = nodes.motion(entry.number);
          message.insert(message.end(), &motion[0], &motion[0] + dim);
        }
    if (!message.empty())
      post(message, neighbour.rank);
    neighbour.sent.since = 0;
  }


  template <int dim>
  void ContactExchange<dim>::receive(Neighbour &neighbour, const unsigned int position, const bool is_end)
  {
    const Turns since  = neighbour.received.since;
    const auto n_nodes = std::count_if(neighbour.entries.begin(), neighbour.entries.end(), [&](const Entry &entry) {
      return has(entry.others, entry.own, since, is_end);
    });
    neighbour.received.since = 0;
    if (n_nodes == 0)
      return;
    values.resize(n_nodes * dim);
    const int error = MPI_Recv(values.data(),
                               values.size() * sizeof(double),
                               MPI_BYTE,
                               neighbour.rank,
                               tag,
                               grid.triangulation().get_communicator(),
                               MPI_STATUS_IGNORE);
    AssertThrowMPI(error);
    const double *value = values.data();
    for (const Entry &entry : neighbour.entries)
      if (has(entry.others, entry.own, since, is_end))
        {
          // A third rank may have told a later change.
          if (const int last = entry.is_known_to_more ? last_before(entry.others, position) : 0;
              !entry.is_known_to_more ||
              last > std::max(latest[entry.number], last_before(nodes.turns(entry.number), position)))
            {
              std::copy_n(value, dim, &nodes.motion(entry.number)[0]);
              latest[entry.number] = last;
            }
          value += dim;
        }
  }


  template <int dim>
  void ContactExchange<dim>::before(const unsigned int position)
  {
    const unsigned int turn = turn_at(position);
    for (Neighbour &neighbour : neighbours)
      if (neighbour.sent.is_due(turn))
        send(neighbour, false);
    for (Neighbour &neighbour : neighbours)
      if (neighbour.received.is_due(turn))
        receive(neighbour, position, false);
    for (Neighbour &neighbour : neighbours)
      for (Stream *stream : { &neighbour.sent, &neighbour.received })
        stream->since |= Turns(1) << turn;
  }


  template <int dim>
  void ContactExchange<dim>::finish()
  {
    for (Neighbour &neighbour : neighbours)
      send(neighbour, true);
    for (Neighbour &neighbour : neighbours)
      receive(neighbour, n_positions, true);
    wait();
  }

  template class ContactExchange<2>;
  template class ContactExchange<3>;
} // namespace scree
