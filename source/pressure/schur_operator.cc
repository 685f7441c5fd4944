// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/schur_operator.h>
#include <scree/tensor/vector.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace scree
{
  using namespace dealii;

  template <int dim>
  SchurOperator<dim>::SchurOperator(const BackgroundGrid<dim> &grid,
                                    const NodeNumbering<dim> &vertices,
                                    FreeSurface<dim> &surface,
                                    const FilledPart<dim> &part,
                                    const PressurePair<dim> &pair)
      : grid(grid)
      , vertices(vertices)
      , surface(surface)
      , part(part)
      , pair(pair)
      , flow(grid.numbering())
  {
    reinit();
  }


  template <int dim>
  void SchurOperator<dim>::reinit()
  {
    flow.reinit();
    full.reinit(vertices.partitioner());
  }


  template <int dim>
  void SchurOperator<dim>::assemble(const Mixture<dim> &mixture,
                                    const PressedNodes<dim> &pressed_nodes,
                                    const GroundRows<dim> *of_ground,
                                    const double of_step)
  {
    // A pressure that does not change along an axis costs what it costs in 2D.
    constexpr double part_of_laplacian = dim == 2 ? 0.01 : 0.0025;
    nodes                              = &pressed_nodes;
    rows                               = of_ground;
    time_step                          = of_step;
    for (unsigned int k = 0; rows && k < rows->all.size(); ++k)
      flow.activate_cell(rows->cell(k));
    reached.clear();
    std::copy_if(nodes->all.begin(), nodes->all.end(), std::back_inserter(reached), [&](const PressedNode<dim> &node) {
      return flow.is_active_at(node.node);
    });
    stiffness.clear();
    const double scale = part_of_laplacian * time_step * std::pow(grid.cell_size(), dim - 2);
    for (const auto &cell : part.cells())
      stiffness.push_back(scale * cell.fraction * mixture.cells()[cell.record].mobility);
  }


  template <int dim>
  void SchurOperator<dim>::begin_step()
  {
    flow.clear();
    for (const auto &cell : part.cells())
      flow.activate_cell(cell.cell);
  }


  template <int dim>
  void SchurOperator<dim>::clear_flow()
  {
    for (const unsigned int node : flow.active_nodes())
      std::fill_n(flow[node], 2 * dim, 0.);
    flow.clear_ghosts();
  }


  template <int dim>
  void SchurOperator<dim>::add_hourglass(const double factor, const VertexVector &pressure, VertexVector &sums) const
  {
    constexpr unsigned int n_vertices = FilledPart<dim>::n_vertices;
    for (unsigned int k = 0; k < part.cells().size(); ++k)
      {
        const unsigned int *corners = vertices.nodes(part.cells()[k].cell);
        // Sums with the signs of the products of the axes in each subset, by Hadamard's transform and back.
        std::array<double, n_vertices> values;
        const auto transform = [&] {
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int v = 0; v < n_vertices; ++v)
              if ((v >> a & 1) == 0)
                {
                  const double lower = values[v], upper = values[v | 1u << a];
                  values[v]           = lower + upper;
                  values[v | 1u << a] = lower - upper;
                }
        };
        for (unsigned int v = 0; v < n_vertices; ++v)
          values[v] = pressure.local_element(corners[v]);
        transform();
        for (unsigned int m = 0; m < n_vertices; ++m)
          values[m] = (m & (m - 1)) == 0 ? 0. : factor * stiffness[k] * values[m]; // 1 and x_a are linear
        transform();
        for (unsigned int v = 0; v < n_vertices; ++v)
          sums.local_element(corners[v]) += values[v];
      }
  }


  template <int dim>
  const FlowField<dim> &SchurOperator<dim>::impulses(const VertexVector &pressure,
                                                     const double of_step,
                                                     const VertexVector *suction,
                                                     const RowVectors *tractions)
  {
    clear_flow();
    pair.add_force(pressure, flow);
    if (suction != nullptr)
      pair.add_suction(*suction, flow);
    if (tractions != nullptr)
      {
        nodes->pass_on_forces(flow);
        if (!tractions->empty())
          rows->add_forces(*tractions, flow);
      }
    flow.add_contributions();
    for (const unsigned int node : flow.active_nodes())
      for (unsigned int c = 0; c < 2 * dim; ++c)
        flow[node][c] *= of_step;
    return flow;
  }


  template <int dim>
  void SchurOperator<dim>::vmult(VertexVector &target,
                                 RowVectors &flows,
                                 const VertexVector &pressure,
                                 const RowVectors &tractions)
  {
    surface.clear(full);
    for (const unsigned int vertex : surface.wet_vertices())
      if (surface.kind(vertex) == PressureDofType::unknown)
        full.local_element(vertex) = pressure.local_element(vertex);
    full.update_ghost_values();
    surface.extend(full);

    clear_flow();
    pair.add_force(full, flow);
    nodes->pass_on_forces(flow);
    if (!tractions.empty())
      rows->add_forces(tractions, flow);
    flow.add_contributions();
    for (const PressedNode<dim> &node : reached)
      {
        SoilAndWater<dim> impulses = PressedNodes<dim>::forces(node, flow[node.node]);
        impulses.soil *= -time_step;
        impulses.water *= -time_step;
        PressedNodes<dim>::set_flow(node, nodes->solve(node, impulses), flow[node.node]);
      }
    flow.update_ghosts();
    flows.clear();
    if (!tractions.empty())
      rows->find_flows(flow, flows);
    nodes->pass_on_flow(flow);
    surface.clear(target);
    pair.add_divergence(flow, target);
    add_hourglass(1., full, target);
    target.compress(VectorOperation::add);
    surface.restrict_to_unknown(target);
  }


  template <int dim>
  void SchurOperator<dim>::find_diagonal(VertexVector &target)
  {
    constexpr unsigned int n_vertices = FilledPart<dim>::n_vertices;
    clear_flow();
    for (const PressedNode<dim> &node : reached)
      {
        std::array<double, dim> mobilities;
        for (unsigned int c = 0; c < dim; ++c)
          {
            std::array<double, 2 * dim> response{};
            response[c] = time_step; // a force on u along the axis
            PressedNodes<dim>::set_flow(
                node, nodes->solve(node, PressedNodes<dim>::forces(node, response.data())), response.data());
            mobilities[c] = response[c];
          }
        std::copy(mobilities.begin(), mobilities.end(), flow[node.node]);
      }
    flow.update_ghosts();
    surface.clear(target);
    pair.add_squares(flow, target);
    for (unsigned int k = 0; k < part.cells().size(); ++k)
      for (unsigned int v = 0; v < n_vertices; ++v)
        target.local_element(vertices.nodes(part.cells()[k].cell)[v]) += stiffness[k] * (n_vertices - dim - 1);
    target.compress(VectorOperation::add);
    surface.restrict_to_unknown(target, FreeSurface<dim>::Shares::squared);
  }


  template <int dim>
  const FlowField<dim> &SchurOperator<dim>::mobilities()
  {
    clear_flow();
    for (const PressedNode<dim> &node : reached)
      {
        flow[node.node][unsigned(Phase::soil)]  = time_step * node.mobility.soil;
        flow[node.node][unsigned(Phase::water)] = time_step * node.mobility.water;
      }
    flow.update_ghosts();
    return flow;
  }


  template <int dim>
  void SchurOperator<dim>::find_source(const MixtureNodes<dim> &of_mixture,
                                       const VertexVector &pressure,
                                       VertexVector &target)
  {
    clear_flow();
    for (const PressedNode<dim> &node : reached)
      PressedNodes<dim>::set_flow(node,
                                  { vector_of<dim>(of_mixture.soil[node.node] + NodalField<dim>::velocity),
                                    vector_of<dim>(of_mixture.water[node.node] + NodalField<dim>::velocity) },
                                  flow[node.node]);
    flow.update_ghosts();
    nodes->pass_on_flow(flow);
    surface.clear(target);
    pair.add_divergence(flow, target);
    for (const auto &cell : part.cells())
      for (unsigned int v = 0; v < FilledPart<dim>::n_vertices; ++v)
        target.local_element(vertices.nodes(cell.cell)[v]) -= cell.allowed[v];
    add_hourglass(-1., pressure, target);
    target.compress(VectorOperation::add);
    surface.restrict_to_unknown(target);
  }

  template class SchurOperator<2>;
  template class SchurOperator<3>;
} // namespace scree
