// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_cut_cells_delassus_operator_h
#define scree_contact_cut_cells_delassus_operator_h

#include <scree/mesh/node_messages.h>
#include <scree/momentum/two_phase_momentum.h>
#include <scree/mesh/node_rows.h>

#include <array>
#include <utility>
#include <vector>

namespace scree
{
  /// Soil or water, of which a node has both.
  enum class Phase : unsigned int
  {
    soil,
    water
  };

  /// What impulses on soil and water at segments of rigid ground do to their velocities there: N A^-1 N^T, with the
  /// means N of the shape functions over the segments, and masses, drag and walls of the nodes in A. The nodes that
  /// contacts act on lie together.
  template <int dim>
  class DelassusOperator
  {
  public:
    /// Both are kept by reference.
    DelassusOperator(const BackgroundGrid<dim> &grid, const CutCells<dim> &cut_cells);

    /// Fits the nodes to the grid's current partition.
    void reinit();

    /// Forgets contacts and nodes. Each rank must do so for each rank's contacts.
    void begin_step();

    /// Forgets the contacts.
    void clear()
    {
      contacts.clear();
    }

    /// Adds a contact of a phase with a segment, with the next number.
    void add(const unsigned int segment, const Phase phase);

    /// Looks at nodes that are new in this step, after all contacts have been added. What the nodes weigh, their drag
    /// and what walls hold of them stays the same in a step. Collective.
    void start(const MixtureNodes<dim> &nodes, const TwoPhaseMomentum<dim> &step);

    /// What an impulse of 1 at a contact, in any direction, gives to the velocity there, 1/kg, without walls.
    double mobility_at(const unsigned int contact) const;

    /// Finds what `impulses`, N s, at the contacts give to the velocities of the nodes. Collective.
    void move_nodes(const std::vector<dealii::Tensor<1, dim>> &impulses);

    /// The same, and the `velocities`, m/s, at the contacts. Collective.
    void apply(const std::vector<dealii::Tensor<1, dim>> &impulses, std::vector<dealii::Tensor<1, dim>> &velocities);

    /// The velocity at a contact, m/s, that move_nodes() has found and change() has changed.
    dealii::Tensor<1, dim> velocity_at(const unsigned int contact) const;

    /// Adds what a change of the impulse at a contact, N s, gives to the velocities of the nodes, as this rank knows
    /// them.
    void change(const unsigned int contact, const dealii::Tensor<1, dim> &impulse);

    /// Finds the `velocities` again, m/s, after changes on all ranks; `impulses`, N s, are the whole of them.
    /// Collective.
    void finish_changes(const std::vector<dealii::Tensor<1, dim>> &impulses,
                        std::vector<dealii::Tensor<1, dim>> &velocities);

    /// Takes `impulses`, N s, at the contacts from the nodes. Collective.
    void take(const std::vector<dealii::Tensor<1, dim>> &impulses,
              const MixtureNodes<dim> &nodes,
              const TwoPhaseMomentum<dim> &step,
              Budget<dim> &balance);

  private:
    struct Contact
    {
      Phase phase;
      unsigned int first; // of its nodes
      const double *shapes;
    };

    /// Velocities of soil and water, m/s, at a node that walls hold, by impulses of 1 N s on soil, then on water, along
    /// each axis.
    using HeldResponse = std::array<std::array<NodeRow, 2>, 2 * dim>;

    struct Node
    {
      DragMobility mobility; // without walls
      unsigned int node;
      unsigned int held = dealii::numbers::invalid_unsigned_int; // number among those that walls hold

      bool is_held() const
      {
        return held != dealii::numbers::invalid_unsigned_int;
      }
    };

    bool is_owned(const Node &node) const
    {
      return node.node < grid.n_owned_nodes();
    }

    /// A node's number in the list, to which it is added if it is not there.
    unsigned int number_of(const unsigned int node)
    {
      unsigned int &number = numbers[node];
      if (number == dealii::numbers::invalid_unsigned_int)
        {
          number = nodes.size();
          nodes.push_back({ {}, node });
        }
      return number;
    }

    /// Sums impulses at the nodes, owned ones hold the whole. Collective.
    void sum(const std::vector<dealii::Tensor<1, dim>> &impulses);

    /// The same of this rank's contacts, with `n` nodes a cell and axis.
    template <int n>
    void add_shares(const std::vector<dealii::Tensor<1, dim>> &impulses);

    /// The mean of the nodes' values over a contact's segment, with `n` nodes a cell and axis.
    template <int n>
    NodeRow mean(const Contact &contact) const;

    /// Sets `velocities` to the means of the nodes' values over the contacts' segments.
    void find_means(std::vector<dealii::Tensor<1, dim>> &velocities) const;

    /// The same of one contact, whatever the number of nodes.
    dealii::Tensor<1, dim> mean_of(const Contact &contact) const;

    /// The velocities of soil and water at a node, m/s, that impulses on them, N s, give.
    std::pair<NodeRow, NodeRow> motion_of(const Node &node, const NodeRow &soil, const NodeRow &water) const;

    static HeldResponse response_of(const DragBlock<dim> &pair);

    /// Copies values of nodes to what other ranks get.
    void write_message(const unsigned int node, double *message) const;

    const BackgroundGrid<dim> &grid;
    const CutCells<dim> &cut_cells;
    const bool is_parallel;
    NodeMessages<dim> messages;
    std::vector<unsigned int> shared_owned; // this rank's nodes that others know
    std::vector<unsigned int> numbers;      // by node
    std::vector<Node> nodes;
    std::array<std::vector<NodeRow>, 2> values; // of soil and water by node: impulses, N s; then what they do, m/s
    std::vector<Contact> contacts;
    std::vector<unsigned int> nodes_of_segments; // a cell's nodes behind each other
    std::vector<unsigned int> first_of_segment;  // of those, by segment
    std::vector<HeldResponse> held;              // by walls, of this rank
    unsigned int n_started = 0;                  // nodes that have been looked at in this step
  };
} // namespace scree

#endif
