// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/operators.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Sums over the vertices of `dim` numbers, in a row; the other lanes are 0.
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline NodeRow sums_over_vertices(const std::array<VertexRow<dim>, dim> &numbers)
    {
      const NodeRow none{};
      NodeRow rows[3]{};
      for (unsigned int c = 0; c < dim; ++c)
        if constexpr (dim == 2)
          rows[c] = numbers[c];
        else
          rows[c] = __builtin_shufflevector(numbers[c], numbers[c], 0, 1, 2, 3) +
                    __builtin_shufflevector(numbers[c], numbers[c], 4, 5, 6, 7);
      const NodeRow a = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6) +
                        __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7),
                    b = __builtin_shufflevector(rows[2], none, 0, 4, 2, 6) +
                        __builtin_shufflevector(rows[2], none, 1, 5, 3, 7);
      return __builtin_shufflevector(a, b, 0, 1, 4, 5) + __builtin_shufflevector(a, b, 2, 3, 6, 7);
    }
  } // namespace


  template <int dim>
  PressureOperators<dim>::PressureOperators(const BackgroundGrid<dim> &grid,
                                            const NodeNumbering<dim> &vertices,
                                            FreeSurface<dim> &surface,
                                            const CutCells<dim> *cut_cells,
                                            const GroundGaps<dim> &gaps)
      : grid(grid)
      , vertices(vertices)
      , surface(surface)
      , part(grid, vertices, surface, cut_cells, gaps)
      , defects(grid.numbering())
      , passed_on(grid.numbering())
      , flow(grid.numbering())
  {
    reinit();
  }


  template <int dim>
  void PressureOperators<dim>::reinit()
  {
    defects.reinit();
    passed_on.reinit();
    moments.clear();
    flow.reinit();
    full.reinit(vertices.partitioner());
    sums.reinit(vertices.partitioner());
  }


  template <int dim>
  void PressureOperators<dim>::integrate(const Mixture<dim> &mixture,
                                         const AtNode &bulk_volume,
                                         const typename FilledPart<dim>::HoldsNode &holds,
                                         const double of_step)
  {
    part.find(mixture, holds, of_step);
    defects.clear();
    passed_on.clear();
    flow.clear();
    for (const auto &cell : part.cells())
      {
        defects.activate_cell(cell.cell);
        passed_on.activate_cell(cell.cell);
        flow.activate_cell(cell.cell);
      }
    find_moments(bulk_volume);
  }


  template <int dim>
  void PressureOperators<dim>::find_moments(const AtNode &bulk_volume)
  {
    constexpr unsigned int n_passes = 8;   // of what cells do not take to the nodes
    constexpr double largest_defect = 0.5; // of Delta_i, over int phi_i
    const unsigned int n            = grid.n_nodes_1d();
    for (const auto &cell : part.cells())
      for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
        defects[grid.nodes(cell.cell)[i]][volume] += part.volumes(cell)[i / n][i % n];
    defects.add_contributions();
    for (const unsigned int node : defects.active_nodes())
      {
        double *defect    = defects[node];
        const double most = largest_defect * defect[volume];
        defect[surplus]   = std::clamp(bulk_volume(node) - defect[volume], -most, most);
      }
    moments.assign(part.cells().size() * part.n_rows, NodeRow{});
    share_surplus();
    for (unsigned int pass = 1; pass < n_passes; ++pass)
      {
        passed_on.add_contributions();
        for (const unsigned int node : defects.active_nodes())
          defects[node][surplus] = *passed_on[node];
        share_surplus();
      }
  }


  template <int dim>
  void PressureOperators<dim>::share_surplus()
  {
    const unsigned int n = grid.n_nodes_1d(), n_rows = part.n_rows;
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    defects.update_ghosts();
    passed_on.clear_ghosts();
    for (const unsigned int node : passed_on.active_nodes())
      *passed_on[node] = 0.;
    NodeRow *of_cell = moments.data();
    for (const auto &cell : part.cells())
      {
        const unsigned int *nodes = grid.nodes(cell.cell);
        const NodeRow *volumes    = part.volumes(cell);
        NodeRow shares[9]{};
        double sum_of_shares = 0.;
        for (unsigned int r = 0; r < n_rows; ++r)
          {
            for (unsigned int i = 0; i < n; ++i)
              if (const double *defect = defects[nodes[r * n + i]]; defect[volume] > 0.)
                shares[r][i] = defect[surplus] / defect[volume] * volumes[r][i];
            sum_of_shares += sum(shares[r]);
          }
        const double mean = sum_of_shares / (cell.fraction * cell_volume);
        for (unsigned int r = 0; r < n_rows; ++r, ++of_cell)
          {
            const NodeRow handed_on = mean * volumes[r];
            *of_cell += shares[r] - handed_on;
            for (unsigned int i = 0; i < n; ++i)
              *passed_on[nodes[r * n + i]] += handed_on[i];
          }
      }
    defects.clear_ghosts();
  }


  template <int dim>
  void PressureOperators<dim>::add_divergence(const FlowField<dim> &of_nodes, VertexVector &result) const
  {
    with_nodes_1d(grid, [&](auto n) {
      const NodeRow *of_moments = moments.data();
      for (const auto &cell : part.cells())
        {
          const unsigned int *node        = grid.nodes(cell.cell);
          const VertexRow<dim> *integrals = part.divergence(cell);
          std::array<VertexRow<dim>, dim> sums_of_axes{};
          std::array<double, dim> drift{};
          for (unsigned int r = 0; r < RowFactors<dim, n>::n_rows; ++r, ++of_moments)
            for (unsigned int i = 0; i < n; ++i, ++node, integrals += dim)
              {
                const double *of_node = of_nodes[*node];
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    sums_of_axes[c] -= integrals[c] * of_node[c];
                    drift[c] += (*of_moments)[i] * of_node[dim + c];
                  }
              }
          VertexRow<dim> divergence{};
          for (unsigned int c = 0; c < dim; ++c)
            divergence += sums_of_axes[c] + cell.hat_slopes[c] * drift[c];
          for (unsigned int v = 0; v < FilledPart<dim>::n_vertices; ++v)
            result.local_element(vertices.nodes(cell.cell)[v]) += divergence[v];
        }
    });
  }


  template <int dim>
  void PressureOperators<dim>::add_force(const VertexVector &pressure, FlowField<dim> &forces) const
  {
    with_nodes_1d(grid, [&](auto n) {
      constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
      const NodeRow *of_moments     = moments.data();
      for (const auto &cell : part.cells())
        {
          VertexRow<dim> p;
          bool acts = false;
          for (unsigned int v = 0; v < FilledPart<dim>::n_vertices; ++v)
            {
              p[v] = pressure.local_element(vertices.nodes(cell.cell)[v]);
              acts = acts || p[v] != 0.;
            }
          if (!acts) // dry, or held in a step of the solver
            {
              of_moments += n_rows;
              continue;
            }
          const unsigned int *node        = grid.nodes(cell.cell);
          const VertexRow<dim> *integrals = part.divergence(cell);
          std::array<VertexRow<dim>, dim> products;
          for (unsigned int c = 0; c < dim; ++c)
            products[c] = p * cell.hat_slopes[c];
          const NodeRow slope = sums_over_vertices<dim>(products); // at the centre of the part
          for (unsigned int r = 0; r < n_rows; ++r, ++of_moments)
            for (unsigned int i = 0; i < n; ++i, ++node, integrals += dim)
              {
                for (unsigned int c = 0; c < dim; ++c)
                  products[c] = p * integrals[c];
                const NodeRow of_mixture = sums_over_vertices<dim>(products), of_flux = (*of_moments)[i] * slope;
                double *force = forces[*node];
                add_row(dim == 2 ? __builtin_shufflevector(of_mixture, -of_flux, 0, 1, 4, 5)
                                 : __builtin_shufflevector(of_mixture, -of_flux, 0, 1, 2, 4),
                        force);
                for (unsigned int c = 1; dim == 3 && c < dim; ++c)
                  force[dim + c] -= of_flux[c];
              }
        }
    });
  }


  template <int dim>
  void PressureOperators<dim>::add_suction(const VertexVector &pressure, FlowField<dim> &forces) const
  {
    const unsigned int n = grid.n_nodes_1d();
    for (const auto &cell : part.cells())
      {
        Tensor<1, dim> slope;
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int v = 0; v < FilledPart<dim>::n_vertices; ++v)
            slope[c] += pressure.local_element(vertices.nodes(cell.cell)[v]) * cell.hat_slopes[c][v];
        if (slope.norm_square() == 0.)
          continue;
        const NodeRow *volumes = part.volumes(cell);
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            forces[grid.nodes(cell.cell)[i]][dim + c] -= volumes[i / n][i % n] * slope[c];
      }
  }


  template <int dim>
  void PressureOperators<dim>::assemble(const Mixture<dim> &mixture,
                                        const WetNodes<dim> &nodes,
                                        const BlockAt &block_at,
                                        const GroundRows<dim> *of_ground,
                                        const double of_step)
  {
    // A pressure that does not change along an axis costs what it costs in 2D.
    constexpr double part_of_laplacian = dim == 2 ? 0.01 : 0.0025;
    rows                               = of_ground;
    time_step                          = of_step;
    for (unsigned int k = 0; rows && k < rows->all.size(); ++k)
      flow.activate_cell(rows->cell(k));
    reached.clear();
    held.clear();
    without_grains.clear();
    nodes.for_occupied([&](const unsigned int node) {
      if (!flow.is_active_at(node))
        return;
      const DragBlock<dim> pair = block_at(node);
      reached.push_back({ node,
                          nodes.porosity(node),
                          scree::inverse_masses(pair.soil_mass, pair.water_mass, pair.drag),
                          pair.is_held() ? unsigned(held.size()) : Node::free });
      if (pair.is_held())
        held.push_back(pair);
    });
    without_mass.clear();
    for (const unsigned int node : flow.active_nodes())
      if (nodes.is_empty(node))
        without_mass.push_back(node);
    const auto look_for_grains = [&](const unsigned int node) {
      if (nodes.has_soil(node) && nodes.has_water(node) && nodes.pores[node][Pores::grain_fraction] <= 0.)
        without_grains.push_back(node);
    };
    for (const unsigned int node : nodes.active())
      look_for_grains(node);
    for (unsigned int node = grid.n_owned_nodes(); node < grid.numbering().n_local(); ++node)
      look_for_grains(node);
    stiffness.clear();
    const double scale = part_of_laplacian * time_step * std::pow(grid.cell_size(), dim - 2);
    for (const auto &cell : part.cells())
      stiffness.push_back(scale * cell.fraction * mixture.cells()[cell.record].mobility);
  }


  template <int dim>
  void
  PressureOperators<dim>::add_hourglass(const double factor, const VertexVector &pressure, VertexVector &result) const
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
          result.local_element(corners[v]) += values[v];
      }
  }


  template <int dim>
  SoilAndWater<dim> PressureOperators<dim>::solve(const Node &node, const SoilAndWater<dim> &impulses) const
  {
    if (node.held != Node::free)
      return held[node.held].solve(impulses);
    return { node.inverse.soil * impulses.soil + node.inverse.other * impulses.water,
             node.inverse.other * impulses.soil + node.inverse.water * impulses.water };
  }


  template <int dim>
  void PressureOperators<dim>::clear_flow()
  {
    for (const unsigned int node : flow.active_nodes())
      std::fill_n(flow[node], 2 * dim, 0.);
    flow.clear_ghosts();
  }


  template <int dim>
  void PressureOperators<dim>::find_forces(const VertexVector &pressure,
                                           const VertexVector *suction,
                                           const typename GroundRows<dim>::Vectors *tractions)
  {
    clear_flow();
    add_force(pressure, flow);
    if (suction != nullptr)
      add_suction(*suction, flow);
    if (tractions != nullptr)
      {
        // As a force on u, where that of rows on soil would else be mixed with it: there q of B is that of water alone.
        for (const unsigned int node : without_grains)
          for (unsigned int c = 0; c < dim; ++c)
            {
              flow[node][c] += flow[node][dim + c];
              flow[node][dim + c] = 0.;
            }
        if (!tractions->empty())
          rows->add_forces(*tractions, flow);
      }
    flow.add_contributions();
  }


  template <int dim>
  template <typename Function>
  void PressureOperators<dim>::find_flow(const Function &write)
  {
    for (const Node &node : reached)
      write(node, flow[node.node]);
    for (const unsigned int node : without_mass)
      std::fill_n(flow[node], 2 * dim, 0.);
    flow.update_ghosts();
  }


  template <int dim>
  void PressureOperators<dim>::find_divergence()
  {
    for (const unsigned int node : without_grains) // The transpose of what find_forces() does there.
      std::copy_n(flow[node], dim, flow[node] + dim);
    surface.clear(sums);
    add_divergence(flow, sums);
  }


  template <int dim>
  const FlowField<dim> &PressureOperators<dim>::impulses(const VertexVector &pressure,
                                                         const double of_step,
                                                         const VertexVector *suction,
                                                         const typename GroundRows<dim>::Vectors *tractions)
  {
    find_forces(pressure, suction, tractions);
    for (const unsigned int node : flow.active_nodes())
      for (unsigned int c = 0; c < 2 * dim; ++c)
        flow[node][c] *= of_step;
    return flow;
  }


  template <int dim>
  void PressureOperators<dim>::vmult(Vector &target, const Vector &source)
  {
    surface.extend(source.pressures, full);
    find_forces(full, nullptr, &source.tractions); // -(B^T p + N^T t)
    find_flow([&](const Node &node, double *of_node) {
      const bool has_soil              = node.inverse.soil > 0.;
      const SoilAndWater<dim> impulses = -time_step * forces_of_flow<dim>(of_node, node.porosity, has_soil);
      write_flow(solve(node, impulses), node.porosity, has_soil, of_node); // A^-1
    });
    target.tractions.clear();
    if (!source.tractions.empty())
      rows->find_flows(flow, target.tractions); // N
    find_divergence();                          // B
    add_hourglass(1., full, sums);
    surface.restrict_to_unknown(sums, target.pressures);
  }


  template <int dim>
  void PressureOperators<dim>::find_source(const WetNodes<dim> &nodes,
                                           const VertexVector &pressure,
                                           std::vector<double> &target)
  {
    clear_flow();
    find_flow([&](const Node &node, double *of_node) {
      write_flow(nodes.velocities(node.node), node.porosity, node.inverse.soil > 0., of_node);
    });
    find_divergence();
    for (const auto &cell : part.cells())
      for (unsigned int v = 0; v < FilledPart<dim>::n_vertices; ++v)
        sums.local_element(vertices.nodes(cell.cell)[v]) -= cell.allowed[v];
    add_hourglass(-1., pressure, sums);
    surface.restrict_to_unknown(sums, target);
  }


  template <int dim>
  void PressureOperators<dim>::find_diagonal(std::vector<double> &target)
  {
    constexpr unsigned int n_vertices = FilledPart<dim>::n_vertices;
    clear_flow();
    find_flow([&](const Node &node, double *responses) { // of u at the nodes
      const bool has_soil = node.inverse.soil > 0.;
      for (unsigned int c = 0; c < dim; ++c)
        {
          std::array<double, 2 * dim> response{};
          response[c]                      = time_step; // a force on u along the axis
          const SoilAndWater<dim> impulses = forces_of_flow<dim>(response.data(), node.porosity, has_soil);
          write_flow(solve(node, impulses), node.porosity, has_soil, response.data());
          responses[c] = response[c];
        }
    });
    surface.clear(sums);
    for (unsigned int k = 0; k < part.cells().size(); ++k)
      {
        const auto &cell                = part.cells()[k];
        const VertexRow<dim> *integrals = part.divergence(cell);
        VertexRow<dim> sum              = VertexRow<dim>{} + stiffness[k] * (n_vertices - dim - 1);
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i, integrals += dim)
          for (unsigned int c = 0; c < dim; ++c)
            sum += integrals[c] * integrals[c] * flow[grid.nodes(cell.cell)[i]][c];
        for (unsigned int v = 0; v < n_vertices; ++v)
          sums.local_element(vertices.nodes(cell.cell)[v]) += sum[v];
      }
    surface.restrict_to_unknown(sums, target, FreeSurface<dim>::Shares::squared);
  }


  template <int dim>
  const FlowField<dim> &PressureOperators<dim>::inverse_masses()
  {
    clear_flow();
    find_flow([&](const Node &node, double *of_node) {
      of_node[unsigned(Phase::soil)]  = node.inverse.soil;
      of_node[unsigned(Phase::water)] = node.inverse.water;
    });
    return flow;
  }

  template class PressureOperators<2>;
  template class PressureOperators<3>;
} // namespace scree
