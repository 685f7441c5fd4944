// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_points_contact_dofs_h
#define scree_contact_points_contact_dofs_h

#include <scree/boundary/constraints.h>
#include <scree/mesh/node_values.h>
#include <scree/step/budget.h>
#include <scree/mesh/node_rows.h>

#include <cstdint>
#include <vector>

namespace scree
{
  /// Stops what moves into walls that it could lift off from.
  /// @param inverse_mass 1/kg, above 0
  template <int dim>
  void stop_at_walls(const NodeConstraints<dim> &walls,
                     const double inverse_mass,
                     dealii::Tensor<1, dim> &velocity,
                     Budget<dim> &balance);

  /// The nodes at which points in contact act, numbered one behind the other, while impulses change their velocities.
  ///
  /// What ranks know of a node's velocity is made one by ContactExchange.
  template <int dim>
  class ContactDofs
  {
  public:
    /// The lane beside a vector in a row.
    static constexpr unsigned int beside = 3;

    static constexpr unsigned int free = dealii::numbers::invalid_unsigned_int; ///< stands for a node that is not there

    /// A bit for each turn of a sweep.
    using Turns = std::uint64_t;

    /// Keeps references to both.
    ContactDofs(const BackgroundGrid<dim> &grid, const Constraints<dim> &constraints);

    /// Fits the nodes to the grid's current partition.
    void reinit();

    /// Begins with no nodes.
    void begin();

    /// Number of nodes.
    unsigned int size() const
    {
      return nodes.size();
    }

    /// The number here of a node of this rank's cells, `free` if it is not there.
    unsigned int find(const unsigned int node) const
    {
      return number_of_node[node];
    }

    /// The number here of a node of this rank's cells, from now on if it was not there.
    unsigned int add(const unsigned int node, const NodalField<dim> &field)
    {
      if (number_of_node[node] == free)
        append(node, field);
      return number_of_node[node];
    }

    /// The node of the grid.
    unsigned int node(const unsigned int number) const
    {
      return nodes[number].node;
    }

    /// The velocity, m/s, which impulses change, and beside it 1 where there is soil, else 0.
    NodeRow &motion(const unsigned int number)
    {
      return motions[number];
    }

    /// What an impulse along each axis does to it, 1/kg: 1/mass, but 0 where walls hold the node (walls are faces of
    /// the box); and 1/mass beside. All are 0 without soil.
    const NodeRow &mobility(const unsigned int number) const
    {
      return mobilities[number];
    }

    /// Whether walls hold the node along any axis.
    bool is_held(const unsigned int number) const
    {
      return nodes[number].is_held;
    }

    /// The velocity without the impulses, m/s.
    const dealii::Tensor<1, dim> &before(const unsigned int number) const
    {
      return nodes[number].before;
    }

    /// The turns in which this rank's cells change it.
    Turns turns(const unsigned int number) const
    {
      return nodes[number].turns;
    }

    /// Notes that this rank's cells change the node in a turn.
    void add_turn(const unsigned int number, const unsigned int turn)
    {
      nodes[number].turns |= Turns(1) << turn;
    }

    /// Stops what moves into walls that it could lift off from, and writes the velocities and their changes to the
    /// field, those of ghosts included, which all ranks know.
    void write(NodalField<dim> &field, Budget<dim> &balance);

    /// Puts the working_velocity() of the impulses on the nodes in the step, which write() has ended, into the records.
    void take_working_velocities(const NodalField<dim> &field);

  private:
    struct Node
    {
      unsigned int node; // of the grid
      bool is_held;
      Turns turns;
      dealii::Tensor<1, dim> before; // velocity without the impulses, m/s
    };

    void append(const unsigned int node, const NodalField<dim> &field);

    /// The axes along which walls hold a node with this velocity, m/s.
    static ConstrainedDirections<dim> held_by_walls(const NodeConstraints<dim> &walls,
                                                    const dealii::Tensor<1, dim> &velocity);

    const BackgroundGrid<dim> &grid;
    const Constraints<dim> &constraints;
    std::vector<Node> nodes;
    std::vector<NodeRow> motions, mobilities; // by number
    std::vector<unsigned int> number_of_node; // of the grid's nodes; `free`: not there
  };
} // namespace scree

#endif
