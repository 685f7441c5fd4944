// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_constraints_h
#define scree_boundary_constraints_h

#include <scree/boundary/boundary_conditions.h>
#include <scree/particles/region.h>

namespace scree
{
  /// The constraints of the nodes of this rank: of the walls of the box, of rigid bodies, of inflows and, while it
  /// stands, of a gate.
  template <int dim>
  class Constraints
  {
  public:
    /// @param water_walls null in a dry scene
    Constraints(const BackgroundGrid<dim> &grid,
                const BoundaryConditions<dim> &walls,
                const BoundaryConditions<dim> *water_walls);

    /// Fits the constraints to the grid's current nodes.
    void reinit();

    /// The same, with nodes at which soil does not move from here on. Inflows have to be set after that.
    /// @param is_rigid of the nodes of this rank's cells, ghosts included; empty: none
    void hold_soil(const std::vector<char> &is_rigid)
    {
      rigid = is_rigid;
      inflow_of_node.clear();
      reinit();
    }

    /// Soil and water do not move at the nodes in this region until the gate is opened.
    void close_gate(std::unique_ptr<Region<dim>> region)
    {
      gate = std::move(region);
      on_all_ranks(grid.communicator(), [&] { reinit(); });
    }

    /// Removes the constraints of close_gate().
    void open_gate()
    {
      close_gate(nullptr);
    }

    /// What an inflow moves, in place of what walls do to it.
    struct MovedByInflow
    {
      dealii::Tensor<1, dim> velocity; ///< m/s
      bool soil;                       ///< or only the water
    };

    /// From here on these nodes move as inflows do.
    /// @param inflow_of_node of the nodes of this rank's cells, ghosts included: the number of the inflow, or `free`;
    /// empty: none
    void set_inflows(const std::vector<unsigned int> &inflow_of_node, const std::vector<MovedByInflow> &inflows);

    /// Velocity of an inflow, m/s.
    void set_inflow_velocity(const unsigned int inflow, const dealii::Tensor<1, dim> &velocity)
    {
      inflows[inflow].velocity = velocity;
      for (unsigned int set = 0; set < inflow_of_set.size(); ++set)
        if (inflow_of_set[set] == inflow)
          add_inflow(inflows[inflow], sets[set]);
    }

    /// Stands for no inflow, and for no constraint.
    static constexpr unsigned int free = dealii::numbers::invalid_unsigned_int;

    /// Whether walls hold a node, and nothing else does: no inflow, rigid body or gate.
    bool has_walls_alone(const unsigned int node) const
    {
      return set_of_node[node] != free && faces_of_set[set_of_node[node]] != 0;
    }

    /// These walls (bit f: face f) do not act until hold_all() on a node that has walls alone.
    void release(const unsigned int node, const std::uint8_t faces)
    {
      take_walls(node, faces, released);
    }

    /// Makes all walls act again after release().
    void hold_all()
    {
      give_back(released);
    }

    /// These walls (bit f: face f) do not act on these nodes, where walls alone do, until the next call.
    /// @param nodes of this rank's cells, ghosts included
    void cover(const std::vector<std::pair<unsigned int, std::uint8_t>> &nodes)
    {
      hold_all();
      give_back(covered);
      for (const auto &[node, faces] : nodes)
        if (has_walls_alone(node))
          take_walls(node, faces, covered);
    }

    /// Faces of the box that are not open to soil, bit f: face f.
    std::uint8_t faces_closed_to_soil() const
    {
      return walls.closed_faces();
    }

    /// The same, and faces that are not open to water, if there is any.
    std::uint8_t closed_faces() const
    {
      return faces_closed_to_soil() | (water_walls ? water_walls->closed_faces() : 0);
    }

    /// Faces of the box that let waves out, bit f: face f.
    std::uint8_t absorbing_faces() const
    {
      std::uint8_t faces = 0;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        faces |= (walls.walls()[f].absorbs ? 1u : 0u) << f;
      return faces;
    }

    /// Whether there are walls that act on water.
    bool has_water() const
    {
      return water_walls != nullptr;
    }

    /// Whether soil sticks to a face of the box.
    bool is_fixed(const unsigned int face) const
    {
      return walls.walls()[face].holds == Wall::Holds::all;
    }

    /// Those of a node of this rank's cells; null where there are none.
    const NodeConstraints<dim> *at(const unsigned int node) const
    {
      const unsigned int set = set_of_node[node];
      return set == free ? nullptr : &sets[set];
    }

    /// Whether any wall is one that soil can lift off.
    bool has_unilateral() const
    {
      return is_unilateral;
    }

  private:
    NodeConstraints<dim> of_faces(const std::uint8_t faces, const bool is_rigid, const bool is_moved) const;

    using NodesAndSets = std::vector<std::pair<unsigned int, unsigned int>>;

    /// Takes walls from a node; `before` gets its set.
    void take_walls(const unsigned int node, const std::uint8_t faces, NodesAndSets &before)
    {
      const unsigned int set     = set_of_node[node];
      const std::uint8_t left    = faces_of_set[set] & ~faces;
      const auto [entry, is_new] = set_of_faces.emplace(left, free);
      if (is_new && left != 0)
        if (const NodeConstraints<dim> constraints = of_faces(left, false, false); constraints.any())
          entry->second = add_set(constraints, free, left);
      before.emplace_back(node, set);
      set_of_node[node] = entry->second;
    }
    void give_back(NodesAndSets &before)
    {
      for (; !before.empty(); before.pop_back()) // A node may be there twice.
        set_of_node[before.back().first] = before.back().second;
    }

    /// Adds to `sets`; returns the number there.
    /// @param faces see faces_of_set
    unsigned int add_set(const NodeConstraints<dim> &constraints, const unsigned int inflow, const std::uint8_t faces)
    {
      sets.push_back(constraints);
      inflow_of_set.push_back(inflow);
      faces_of_set.push_back(faces);
      return sets.size() - 1;
    }

    /// What an inflow does to a node.
    void add_inflow(const MovedByInflow &inflow, NodeConstraints<dim> &constraints) const
    {
      if (inflow.soil && !constraints.is_rigid)
        constraints.soil_velocity = inflow.velocity;
      if (!water_walls)
        return;
      constraints.water_velocity = inflow.velocity;
      constraints.water_faces    = BearingFaces<dim>();
      constraints.water_constraint.hold_all();
    }

    const BackgroundGrid<dim> &grid;
    const BoundaryConditions<dim> &walls;
    const BoundaryConditions<dim> *water_walls;
    const bool is_unilateral;
    std::unique_ptr<Region<dim>> gate;
    std::vector<char> rigid;                  // by node; empty: none
    std::vector<unsigned int> inflow_of_node; // by node; empty: none
    std::vector<MovedByInflow> inflows;

    std::vector<unsigned int> set_of_node; // by node, ghosts included
    std::vector<NodeConstraints<dim>> sets;
    std::vector<unsigned int> inflow_of_set;           // `free`: none
    std::vector<std::uint8_t> faces_of_set;            // 0: not of walls alone
    std::map<std::uint8_t, unsigned int> set_of_faces; // those of walls alone; `free`: they hold nothing
    NodesAndSets covered, released;                    // what they had before; released later than covered
  };
} // namespace scree

#endif
