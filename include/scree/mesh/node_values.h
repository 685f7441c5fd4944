// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_node_values_h
#define scree_mesh_node_values_h

#include <scree/mesh/background_grid.h>

#include <deal.II/lac/la_parallel_vector.h>

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

  /// `n` numbers a node. The components of a node lie together, so that a node is one cache line and one message
  /// carries all of them. Only active nodes are touched: an empty cell costs nothing.
  template <int dim, int n>
  class NodeValues
  {
  public:
    /// Makes room on the nodes of the numbering, which must live on.
    explicit NodeValues(const NodeNumbering<dim> &numbering);

    /// Fits the values to the current nodes.
    void reinit();

    /// Empties the values and deactivates their nodes, before a new step.
    void clear();

    /// Marks the nodes of a locally owned cell as active.
    void activate_cell(const unsigned int cell)
    {
      const unsigned int *nodes = numbering.nodes(cell);
      for (unsigned int i = 0; i < numbering.n_nodes_per_cell(); ++i)
        if (!is_active[nodes[i]])
          activate(nodes[i]);
    }

    /// Sums over ranks: owned nodes hold the whole afterwards. Collective.
    void add_contributions();

    /// Takes the largest of the ranks' values, none of which is negative: owned nodes hold it then. Collective.
    void take_largest();

    /// Hands the owners' values to the ranks that see the node as a ghost. Collective.
    void update_ghosts();

    /// Drops what this rank holds of the ghosts, before it adds to them again.
    void clear_ghosts();

    /// The owned nodes on which any rank's points act.
    const std::vector<unsigned int> &active_nodes() const
    {
      return active_owned;
    }

    /// Whether a node of this rank's cells, ghosts included, is active.
    bool is_active_at(const unsigned int node) const
    {
      return is_active[node];
    }

    /// The `n` numbers of a node of this rank's cells, ghosts included.
    double *operator[](const unsigned int node)
    {
      return values.begin() + std::size_t(node) * n;
    }

    /// Read-only access.
    const double *operator[](const unsigned int node) const
    {
      return values.begin() + std::size_t(node) * n;
    }

  private:
    void activate(const unsigned int node)
    {
      is_active[node] = true;
      if (node < numbering.n_owned())
        active_owned.push_back(node);
    }

    const NodeNumbering<dim> &numbering;
    dealii::LinearAlgebra::distributed::Vector<double> values;
    std::vector<unsigned int> active_owned;
    std::vector<unsigned int> shared_owned; // owned nodes that are ghosts of other ranks
    std::vector<char> is_active;
  };

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
