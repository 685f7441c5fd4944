// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/constraints.h>

#include <tuple>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Constraints<dim>::Constraints(const BackgroundGrid<dim> &grid,
                                const BoundaryConditions<dim> &walls,
                                const BoundaryConditions<dim> *water_walls)
      : grid(grid)
      , walls(walls)
      , water_walls(water_walls)
      , is_unilateral(std::any_of(walls.walls().begin(), walls.walls().end(), [](const Wall &wall) {
        return wall.lets_lift_off;
      }))
  {
    reinit();
  }


  template <int dim>
  NodeConstraints<dim>
  Constraints<dim>::of_faces(const std::uint8_t faces, const bool is_rigid, const bool is_moved) const
  {
    NodeConstraints<dim> result;
    result.is_rigid = is_rigid;
    if (is_rigid || is_moved) // holds the soil in place of the walls
      for (unsigned int a = 0; a < dim; ++a)
        result.add({ Point<dim>::unit_vector(a) });
    else
      {
        for (const NodeConstraint<dim> &constraint : walls.constraints(faces))
          result.add(constraint);
        result.soil_faces = walls.bearing_faces(faces);
      }
    if (water_walls)
      {
        result.water_constraint = water_walls->held_directions(faces);
        result.water_faces      = water_walls->bearing_faces(faces);
      }
    return result;
  }


  template <int dim>
  void Constraints<dim>::set_inflows(const std::vector<unsigned int> &of_node,
                                     const std::vector<MovedByInflow> &all_inflows)
  {
    inflow_of_node = of_node;
    inflows        = all_inflows;
    reinit();
  }


  template <int dim>
  void Constraints<dim>::reinit()
  {
    set_of_node.assign(grid.numbering().n_local(), free);
    sets.clear();
    inflow_of_set.clear();
    faces_of_set.clear();
    set_of_faces.clear();
    covered.clear();
    released.clear();
    // Nodes on the same faces share a set.
    std::map<std::tuple<std::uint8_t, bool, unsigned int>, unsigned int> set_of_kind;
    for (unsigned int node = 0; node < set_of_node.size(); ++node)
      {
        const std::uint8_t faces  = grid.node_faces(node);
        const bool is_rigid       = !rigid.empty() && rigid[node];
        const unsigned int inflow = inflow_of_node.empty() ? free : inflow_of_node[node];
        if (faces == 0 && !is_rigid)
          continue;
        const auto [entry, is_new] = set_of_kind.emplace(std::make_tuple(faces, is_rigid, inflow), free);
        if (is_new)
          {
            NodeConstraints<dim> constraints = of_faces(faces, is_rigid, inflow != free && inflows[inflow].soil);
            if (inflow != free)
              add_inflow(inflows[inflow], constraints);
            if (constraints.any())
              entry->second = add_set(constraints, inflow, is_rigid || inflow != free ? 0 : faces);
            if (!is_rigid && inflow == free)
              set_of_faces[faces] = entry->second;
          }
        set_of_node[node] = entry->second;
      }
    if (!gate)
      return;
    NodeConstraints<dim> held;
    for (unsigned int a = 0; a < dim; ++a)
      held.add({ Point<dim>::unit_vector(a) });
    held.water_constraint.hold_all();
    const unsigned int set_of_gate = add_set(held, free, 0);
    for (unsigned int node = 0; node < set_of_node.size(); ++node)
      if (gate->contains(grid.node_position(node)))
        set_of_node[node] = set_of_gate;
  }


  template class Constraints<2>;
  template class Constraints<3>;
} // namespace scree
