// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_node_messages_h
#define scree_mesh_node_messages_h

#include <scree/mesh/node_numbering.h>

#include <vector>

namespace scree
{
  /// Messages about the nodes of other ranks that a rank acts on, few of its ghosts: to their owners and back.
  template <int dim>
  class NodeMessages
  {
  public:
    /// Kept by reference; reinit() fits the messages to its nodes.
    explicit NodeMessages(const NodeNumbering<dim> &numbering)
        : numbering(numbering)
    {
    }

    /// Fits the messages to the current nodes; until begin(), they have none.
    void reinit();

    /// Sets the ghosts that messages are about, in any order, and informs their owners. Collective with neighbours, as
    /// are the following.
    void begin(const std::vector<unsigned int> &ghosts);

    /// Brings `n` numbers for each of these ghosts to its owner.
    /// @param write (node, double *numbers) on this rank's ghosts
    /// @param read (node, const double *numbers) on the owner's nodes, once for each rank that sends some
    template <typename Write, typename Read>
    void to_owners(const unsigned int n, const Write &write, const Read &read)
    {
      exchange(n, &Neighbour::ghosts, write, &Neighbour::owned, read);
    }

    /// Brings `n` numbers for each of them from its owner.
    template <typename Write, typename Read>
    void from_owners(const unsigned int n, const Write &write, const Read &read)
    {
      exchange(n, &Neighbour::owned, write, &Neighbour::ghosts, read);
    }

  private:
    using Nodes = std::vector<unsigned int>;

    struct Neighbour
    {
      unsigned int rank;
      unsigned int first_ghost = 0, n_ghosts = 0; // that it owns
      Nodes shared;                               // of this rank, in the order of its ghosts
      Nodes ghosts;                               // that messages are about: of its nodes
      Nodes owned;                                // and of this rank's
      std::vector<double> sent, received;
    };

    template <typename Write, typename Read>
    void exchange(const unsigned int n,
                  Nodes Neighbour::*written,
                  const Write &write,
                  Nodes Neighbour::*to_read,
                  const Read &read)
    {
      for (Neighbour &neighbour : neighbours)
        {
          neighbour.sent.resize((neighbour.*written).size() * n);
          neighbour.received.resize((neighbour.*to_read).size() * n);
          double *numbers = neighbour.sent.data();
          for (const unsigned int node : neighbour.*written)
            {
              write(node, numbers);
              numbers += n;
            }
        }
      send_and_receive();
      for (const Neighbour &neighbour : neighbours)
        {
          const double *numbers = neighbour.received.data();
          for (const unsigned int node : neighbour.*to_read)
            {
              read(node, numbers);
              numbers += n;
            }
        }
    }

    /// Messages without numbers are not sent.
    void send_and_receive();

    const NodeNumbering<dim> &numbering;
    std::vector<Neighbour> neighbours;
    std::vector<MPI_Request> requests;
  };
} // namespace scree

#endif
