// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/points/contact_exchange.h>
#include <scree/particles/point_set.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr int tag = 2; // of messages between contact nodes

    /// Adds the time of `wait()` to a sum unless that is null.
    template <typename Wait>
    void timed(double *sum, const Wait &wait)
    {
      const double start = sum ? thread_time() : 0.;
      const int error    = wait();
      if (sum)
        *sum += thread_time() - start;
      AssertThrowMPI(error);
    }
  } // namespace


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
    const int error = MPI_Isend(
        message.data(), message.size() * sizeof(T), MPI_BYTE, rank, tag, grid.communicator(), &requests.back());
    AssertThrowMPI(error);
  }


  template <int dim>
  void ContactExchange<dim>::wait()
  {
    timed(waited, [&] { return MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE); });
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
              for (unsigned int c = 0; c < dim; ++c)
                neighbour.records.back().change[c] = change[c];
            }
        post(neighbour.records, neighbour.rank);
      }
  }


  template <int dim>
  void ContactExchange<dim>::receive_records(Neighbour &neighbour, const NodalField<dim> &field)
  {
    MPI_Status status;
    timed(waited, [&] { return MPI_Probe(neighbour.rank, tag, grid.communicator(), &status); });
    int size, error = MPI_Get_count(&status, MPI_BYTE, &size);
    AssertThrowMPI(error);
    records.resize(size / sizeof(Record));
    error = MPI_Recv(records.data(), size, MPI_BYTE, neighbour.rank, tag, grid.communicator(), MPI_STATUS_IGNORE);
    AssertThrowMPI(error);

    // Both lists are in the order of the shared nodes.
    neighbour.entries.clear();
    const auto add = [&](const unsigned int k, const Turns of_own, const Turns of_others) {
      neighbour.entries.push_back(
          { nodes.add(neighbour.nodes[k], field), bool(neighbour.is_known_to_more[k]), { { of_own, of_others } } });
    };
    auto sent = neighbour.records.begin();
    for (const Record &record : records)
      {
        for (; sent != neighbour.records.end() && sent->node < record.node; ++sent)
          add(sent->node, sent->turns, 0);
        const bool is_sent = sent != neighbour.records.end() && sent->node == record.node;
        add(record.node, is_sent ? sent->turns : 0, record.turns);
        sent += is_sent;
        NodeRow &motion = nodes.motion(neighbour.entries.back().number);
        for (unsigned int c = 0; c < dim; ++c)
          motion[c] += record.change[c];
      }
    for (; sent != neighbour.records.end(); ++sent)
      add(sent->node, sent->turns, 0);
  }


  template <int dim>
  void ContactExchange<dim>::begin(const NodalField<dim> &field,
                                   const unsigned int n_turns,
                                   const unsigned int n_sweeps,
                                   double *waited)
  {
    this->n_turns = n_turns;
    this->waited  = waited;
    n_positions   = n_turns * n_sweeps;
    send_records();
    for (Neighbour &neighbour : neighbours)
      {
        receive_records(neighbour, field);
        for (Stream &stream : neighbour.streams)
          stream.clear();
        for (unsigned int k = 0; k < neighbour.entries.size(); ++k)
          for (const unsigned int by : { own, others })
            neighbour.streams[by].add(k, neighbour.entries[k].turns[by], neighbour.entries[k].turns[1 - by]);
      }
    latest.assign(neighbours.empty() ? 0 : nodes.size(), -1);
    shared.assign(latest.size(), false);
    for (const Neighbour &neighbour : neighbours)
      for (const Entry &entry : neighbour.entries)
        shared[entry.number] |= entry.turns[others] != 0;
  }


  template <int dim>
  void ContactExchange<dim>::Stream::clear()
  {
    causes.fill(0);
    for (auto &of_turn : entries)
      of_turn.clear();
    last_entries.clear();
    since = all = 0;
  }


  template <int dim>
  void ContactExchange<dim>::Stream::add(const unsigned int entry, const Turns change, const Turns read)
  {
    if (read == 0 && change != 0)
      last_entries.push_back(entry);
    if (read == 0)
      return;
    all |= change;
    for (Turns rest = change; rest != 0; rest &= rest - 1)
      entries[__builtin_ctzll(rest)].push_back(entry);
    for (Turns rest = read; rest != 0; rest &= rest - 1)
      causes[__builtin_ctzll(rest)] |= change;
  }


  template <int dim>
  void ContactExchange<dim>::take_message(Neighbour &neighbour, const unsigned int by, const bool is_end)
  {
    listed.clear();
    Stream &stream    = neighbour.streams[by];
    const Turns since = stream.since & stream.all;
    for (Turns rest = since; rest != 0; rest &= rest - 1)
      {
        const unsigned int turn = __builtin_ctzll(rest);
        for (const unsigned int k : stream.entries[turn]) // Each is told once.
          if (unsigned(__builtin_ctzll(neighbour.entries[k].turns[by] & since)) == turn)
            listed.push_back(k);
      }
    if (is_end)
      listed.insert(listed.end(), stream.last_entries.begin(), stream.last_entries.end());
    stream.since = 0;
  }


  template <int dim>
  void ContactExchange<dim>::send(Neighbour &neighbour, const bool is_end)
  {
    take_message(neighbour, own, is_end);
    if (listed.empty())
      return;
    messages.emplace_back();
    messages.back().reserve(listed.size() * dim);
    for (const unsigned int k : listed)
      {
        const NodeRow &motion = nodes.motion(neighbour.entries[k].number);
        for (unsigned int c = 0; c < dim; ++c)
          messages.back().push_back(motion[c]);
      }
    post(messages.back(), neighbour.rank);
  }


  template <int dim>
  void ContactExchange<dim>::receive(Neighbour &neighbour, const unsigned int position, const bool is_end)
  {
    take_message(neighbour, others, is_end);
    if (listed.empty())
      return;
    values.resize(listed.size() * dim);
    timed(waited, [&] {
      return MPI_Recv(values.data(),
                      values.size() * sizeof(double),
                      MPI_BYTE,
                      neighbour.rank,
                      tag,
                      grid.communicator(),
                      MPI_STATUS_IGNORE);
    });
    const double *value = values.data();
    for (const unsigned int k : listed)
      {
        const Entry &entry = neighbour.entries[k];
        // A third rank may have told a later change.
        if (const int last = entry.is_known_to_more ? last_before(entry.turns[others], position) : 0;
            !entry.is_known_to_more ||
            last > std::max(latest[entry.number], last_before(nodes.turns(entry.number), position)))
          {
            for (unsigned int c = 0; c < dim; ++c)
              nodes.motion(entry.number)[c] = value[c];
            latest[entry.number] = last;
          }
        value += dim;
      }
  }


  template <int dim>
  bool ContactExchange<dim>::has_come(const unsigned int position) const
  {
    for (const Neighbour &neighbour : neighbours)
      if (neighbour.streams[others].is_due(turn_at(position)))
        {
          int is_here     = 0;
          const int error = MPI_Iprobe(neighbour.rank, tag, grid.communicator(), &is_here, MPI_STATUS_IGNORE);
          AssertThrowMPI(error);
          if (!is_here)
            return false;
        }
    return true;
  }


  template <int dim>
  void ContactExchange<dim>::before(const unsigned int position)
  {
    const unsigned int turn = turn_at(position);
    for (Neighbour &neighbour : neighbours)
      {
        if (neighbour.streams[others].is_due(turn))
          receive(neighbour, position, false);
        neighbour.streams[others].since |= Turns(1) << turn;
      }
  }


  template <int dim>
  void ContactExchange<dim>::after(const unsigned int position)
  {
    const Turns turn = Turns(1) << turn_at(position);
    for (Neighbour &neighbour : neighbours)
      {
        Stream &sent = neighbour.streams[own];
        sent.since |= turn;
        if (!(sent.all & turn))
          continue;
        for (unsigned int next = position + 1; next < n_positions; ++next)
          {
            if (sent.is_due(turn_at(next)))
              send(neighbour, false);
            if (sent.since == 0 || sent.all >> turn_at(next) & 1)
              break;
          }
      }
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
