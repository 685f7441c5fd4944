// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_contact_nodes_h
#define scree_scheme_contact_nodes_h

#include <scree/grid/constraints.h>
#include <scree/grid/nodal_field.h>
#include <scree/scheme/step_balance.h>

#include <vector>

namespace scree
{
  /// Stops what moves into walls that it could lift off from.
  /// @param inverse_mass 1/kg, above 0
  template <int dim>
  void stop_at_walls(const NodeConstraints<dim> &walls,
                     const double inverse_mass,
                     dealii::Tensor<1, dim> &velocity,
                     StepBalance<dim> &balance);

  /// The nodes at which points in contact act, numbered one behind the other, while impulses change their velocities.
  ///
  /// What ranks know of a node's velocity is made one by exchange(): until then, no two ranks may change a node's, or
  /// read what another has changed.
  template <int dim>
  class ContactNodes
  {
  public:
    struct Node
    {
      unsigned int node; ///< of the grid
      double inverse_mass;
      dealii::Tensor<1, dim> velocity; ///< m/s
      dealii::Tensor<1, dim> known;    ///< as all ranks know it
      unsigned int held;               ///< number of its directions that walls hold; ContactNodes::free without any
    };

    static constexpr unsigned int free = dealii::numbers::invalid_unsigned_int;

    ContactNodes(const BackgroundGrid<dim> &grid, const Constraints<dim> &constraints);

    /// Fits the nodes to the grid's current partition. Collective.
    void reinit();

    /// Begins with no nodes but those that other ranks may act on.
    void begin(const NodalField<dim> &field);

    /// The number here of a node of this rank's cells, from now on if it was not there.
    unsigned int add(const unsigned int node, const NodalField<dim> &field);

    Node &operator[](const unsigned int number)
    {
      return nodes[number];
    }
    const Node &operator[](const unsigned int number) const
    {
      return nodes[number];
    }

    /// The directions along which walls stop a node.
    const HeldDirections<dim> &held(const Node &node) const
    {
      return held_directions[node.held];
    }

    /// Whether other ranks know the node, too.
    bool is_shared(const unsigned int node) const
    {
      return shared[node];
    }

    /// Makes the velocities those of all ranks. Collective.
    void exchange();

    /// Stops what moves into walls that it could lift off from, and writes the velocities and their changes to the
    /// field, those of ghosts included. Collective.
    void write(NodalField<dim> &field, StepBalance<dim> &balance);

  private:
    /// Finds what walls hold of a node.
    void find_walls(Node &node);

    const BackgroundGrid<dim> &grid;
    const Constraints<dim> &constraints;
    const bool is_parallel;
    NodeValues<dim, dim> messages;
    std::vector<Node> nodes;
    std::vector<HeldDirections<dim>> held_directions;
    std::vector<unsigned int> number_of_node; // of the grid's nodes; `free`: not there
    std::vector<unsigned int> shared_owned;   // nodes of this rank that others know
    std::vector<char> shared;                 // whether others know a node
  };
} // namespace scree

#endif
