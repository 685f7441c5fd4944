// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_points_contact_exchange_h
#define scree_contact_points_contact_exchange_h

#include <scree/contact/points/contact_dofs.h>

#include <array>
#include <list>
#include <map>
#include <vector>

namespace scree
{
  /// Tells ranks what others have done to contact nodes that they share, while cells change the nodes in turns.
  ///
  /// No two cells with a turn in common share a node, so one rank at a time changes a node. Ranks tell each other once
  /// which turns change which nodes; from that, both ends of a message know when it is due (the last moment before a
  /// cell reads what another rank has changed) and which nodes it has. It is sent once its last change is made, so that
  /// it travels while cells away from the border have their turn. A message has values, not changes, so that all ranks
  /// know the same bits.
  template <int dim>
  class ContactExchange
  {
  public:
    /// Keeps references to both.
    ContactExchange(const BackgroundGrid<dim> &grid, ContactDofs<dim> &nodes);

    /// Fits the shared nodes to the grid's current partition. Collective.
    void reinit();

    /// Adds up what ranks have done to the nodes so far, each to its own copies, and learns in which turns they will
    /// change them. Collective with neighbours, as are the following.
    /// @param n_turns of a sweep; every other sweep takes them backward
    /// @param waited to which the processor time, s, is added that this rank waits for others up to finish(); null:
    /// none
    void begin(const NodalField<dim> &field, const unsigned int n_turns, const unsigned int n_sweeps, double *waited);

    /// Whether another rank changes this contact node, too.
    bool is_shared(const unsigned int number) const
    {
      return number < shared.size() && shared[number];
    }

    /// Whether all that cells of this turn read has come; `position` counts the turns of all sweeps.
    bool has_come(const unsigned int position) const;

    /// Brings it.
    void before(const unsigned int position);

    /// Sends what this turn has changed last before others read it.
    void after(const unsigned int position);

    /// Brings the velocities at the end to all ranks that know the nodes.
    void finish();

  private:
    using Turns = typename ContactDofs<dim>::Turns;

    /// What a rank does to a node before the turns.
    struct Record
    {
      unsigned int node; // in the order of the shared nodes
      Turns turns;
      std::array<double, dim> change; // m/s
    };

    /// A shared node that contacts act on in this step.
    struct Entry
    {
      unsigned int number; // in the contact nodes
      bool is_known_to_more;
      std::array<Turns, 2> turns; // in which this rank and the neighbour change it
    };

    /// Messages in one direction.
    struct Stream
    {
      static constexpr unsigned int n_turns = 8 * sizeof(Turns);

      std::array<Turns, n_turns> causes; // by turn: those that change what the turn reads at the other end
      std::array<std::vector<unsigned int>, n_turns> entries; // by turn: those it changes that the other end reads
      std::vector<unsigned int> last_entries;                 // that only one end changes, told at the end
      Turns since;                                            // those after the last message
      Turns all;                                              // with entries

      void clear();

      /// Lists an entry that is changed and read, at the other end, in these turns.
      void add(const unsigned int entry, const Turns change, const Turns read);

      bool is_due(const unsigned int turn) const
      {
        return causes[turn] & since;
      }
    };

    enum
    {
      own,
      others
    };

    struct Neighbour
    {
      unsigned int rank;
      std::vector<unsigned int> nodes; // of the grid, that both know, in the order of their global numbers
      std::vector<char> is_known_to_more;
      std::vector<Record> records; // to send
      std::vector<Entry> entries;
      std::array<Stream, 2> streams; // sent and received
    };

    /// The global numbers of the nodes that this rank shares, by the other rank. Collective.
    std::map<unsigned int, std::vector<dealii::types::global_dof_index>> shared_nodes() const;

    unsigned int turn_at(const unsigned int position) const
    {
      const unsigned int turn = position % n_turns;
      return position / n_turns % 2 == 0 ? turn : n_turns - 1 - turn;
    }

    /// The last position before this one with one of the turns; -1 without any.
    int last_before(const Turns turns, const unsigned int position) const;

    /// Lists the entries of the message that a stream has now, in the same order at both ends, and begins the next one.
    void take_message(Neighbour &neighbour, const unsigned int by, const bool is_end);

    void send_records();
    void receive_records(Neighbour &neighbour, const NodalField<dim> &field);
    void send(Neighbour &neighbour, const bool is_end);
    void receive(Neighbour &neighbour, const unsigned int position, const bool is_end);

    template <typename T>
    void post(const std::vector<T> &message, const unsigned int rank);
    void wait();

    const BackgroundGrid<dim> &grid;
    ContactDofs<dim> &nodes;
    std::vector<Neighbour> neighbours;
    unsigned int n_turns = 0, n_positions = 0;
    std::vector<MPI_Request> requests;
    std::list<std::vector<double>> messages; // that are under way
    std::vector<int> latest;                 // position of the change that a node has from elsewhere, by number
    std::vector<char> shared;                // whether others change it, by number
    double *waited = nullptr;                // s
    std::vector<unsigned int> listed;        // entries of a message
    std::vector<double> values;              // received
    std::vector<Record> records;             // received
  };
} // namespace scree

#endif
