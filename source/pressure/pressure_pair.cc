// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pressure_pair.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// `dim` components of the nodes of a cell, from one on, in rows.
    template <int dim, int n>
    using Rows = NodeRow[dim][RowFactors<dim, n>::n_rows];

    template <int dim, int n>
    void read(const FlowField<dim> &field, const unsigned int *nodes, const unsigned int first, Rows<dim, n> &rows)
    {
      for (unsigned int r = 0; r < RowFactors<dim, n>::n_rows; ++r)
        for (unsigned int c = 0; c < dim; ++c)
          {
            rows[c][r] = NodeRow{};
            for (unsigned int i = 0; i < n; ++i)
              rows[c][r][i] = field[nodes[r * n + i]][first + c];
          }
    }
  } // namespace


  template <int dim>
  PressurePair<dim>::PressurePair(const BackgroundGrid<dim> &grid,
                                  const NodeNumbering<dim> &vertices,
                                  const FilledPart<dim> &part)
      : grid(grid)
      , vertices(vertices)
      , part(part)
      , defects(grid.numbering())
      , passed_on(grid.numbering())
  {
  }


  template <int dim>
  void PressurePair<dim>::reinit()
  {
    defects.reinit();
    passed_on.reinit();
    moments.clear();
  }


  template <int dim>
  void PressurePair<dim>::find_moments(const std::function<double(unsigned int node)> &volume_of_water)
  {
    const unsigned int n = grid.n_nodes_1d(), n_rows = part.n_rows;
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    defects.clear();
    passed_on.clear();
    for (const auto &cell : part.cells())
      {
        defects.activate_cell(cell.cell);
        passed_on.activate_cell(cell.cell);
        const unsigned int *nodes = grid.nodes(cell.cell);
        const NodeRow *volumes    = part.volumes(cell);
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int i = 0; i < n; ++i)
            defects[nodes[r * n + i]][volume] += volumes[r][i];
      }
    defects.add_contributions();
    for (const unsigned int node : defects.active_nodes())
      {
        double *defect         = defects[node];
        const double of_points = volume_of_water(node), most = largest_defect * defect[volume];
        defect[surplus] = std::clamp(of_points - defect[volume], -most, most);
      }
    moments.assign(part.cells().size() * n_rows, NodeRow{});
    for (unsigned int pass = 0; pass < n_passes; ++pass)
      {
        defects.update_ghosts();
        passed_on.clear_ghosts();
        for (const unsigned int node : passed_on.active_nodes())
          passed_on[node][surplus] = 0.;
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
                  passed_on[nodes[r * n + i]][surplus] += handed_on[i];
              }
          }
        passed_on.add_contributions();
        defects.clear_ghosts();
        for (const unsigned int node : defects.active_nodes())
          defects[node][surplus] = passed_on[node][surplus];
      }
  }


  template <int dim>
  template <int n>
  void PressurePair<dim>::add_divergence_of_cells(const FlowField<dim> &flow, VertexVector &sums) const
  {
    constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
    const NodeRow *of_moments     = moments.data();
    for (const auto &cell : part.cells())
      {
        const unsigned int *nodes = grid.nodes(cell.cell);
        Rows<dim, n> mixture, discharge;
        read<dim, n>(flow, nodes, 0, mixture);
        read<dim, n>(flow, nodes, dim, discharge);
        NodeRow drift[dim] = {};
        for (unsigned int r = 0; r < n_rows; ++r, ++of_moments)
          for (unsigned int c = 0; c < dim; ++c)
            drift[c] += *of_moments * discharge[c][r];
        for (unsigned int v = 0; v < FilledPart<dim>::n_vertices; ++v)
          {
            NodeRow divergence{};
            for (unsigned int c = 0; c < dim; ++c)
              {
                const NodeRow *integrals = part.divergence(cell, c, v);
                for (unsigned int r = 0; r < n_rows; ++r)
                  divergence -= integrals[r] * mixture[c][r];
                divergence += cell.hat_slopes[v][c] * drift[c];
              }
            sums.local_element(vertices.nodes(cell.cell)[v]) += sum(divergence);
          }
      }
  }


  template <int dim>
  template <int n>
  void PressurePair<dim>::add_force_of_cells(const VertexVector &pressure, FlowField<dim> &forces) const
  {
    constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
    const NodeRow *of_moments     = moments.data();
    for (const auto &cell : part.cells())
      {
        const unsigned int *nodes = grid.nodes(cell.cell);
        Rows<dim, n> of_mixture{};
        Tensor<1, dim> slope; // at the centre of the part
        for (unsigned int v = 0; v < FilledPart<dim>::n_vertices; ++v)
          {
            const double p = pressure.local_element(vertices.nodes(cell.cell)[v]);
            if (p == 0.)
              continue; // dry, or held in a step of the solver
            slope += p * cell.hat_slopes[v];
            for (unsigned int c = 0; c < dim; ++c)
              {
                const NodeRow *integrals = part.divergence(cell, c, v);
                for (unsigned int r = 0; r < n_rows; ++r)
                  of_mixture[c][r] += p * integrals[r];
              }
          }
        for (unsigned int r = 0; r < n_rows; ++r, ++of_moments)
          for (unsigned int i = 0; i < n; ++i)
            {
              double *force = forces[nodes[r * n + i]];
              for (unsigned int c = 0; c < dim; ++c)
                {
                  force[c] += of_mixture[c][r][i];
                  force[dim + c] -= (*of_moments)[i] * slope[c];
                }
            }
      }
  }


  template <int dim>
  void PressurePair<dim>::add_divergence(const FlowField<dim> &flow, VertexVector &sums) const
  {
    with_nodes_1d(grid, [&](auto n) { add_divergence_of_cells<n>(flow, sums); });
  }


  template <int dim>
  void PressurePair<dim>::add_force(const VertexVector &pressure, FlowField<dim> &forces) const
  {
    with_nodes_1d(grid, [&](auto n) { add_force_of_cells<n>(pressure, forces); });
  }


  template <int dim>
  void PressurePair<dim>::add_squares(const FlowField<dim> &mobilities, VertexVector &sums) const
  {
    const unsigned int n = grid.n_nodes_1d();
    for (const auto &cell : part.cells())
      for (unsigned int v = 0; v < FilledPart<dim>::n_vertices; ++v)
        for (unsigned int c = 0; c < dim; ++c)
          {
            const NodeRow *integrals = part.divergence(cell, c, v);
            double &of_vertex        = sums.local_element(vertices.nodes(cell.cell)[v]);
            for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
              of_vertex += std::pow(integrals[i / n][i % n], 2) * mobilities[grid.nodes(cell.cell)[i]][c];
          }
  }


  template <int dim>
  void PressurePair<dim>::add_suction(const VertexVector &pressure, FlowField<dim> &forces) const
  {
    const unsigned int n = grid.n_nodes_1d();
    for (const auto &cell : part.cells())
      {
        Tensor<1, dim> slope;
        for (unsigned int v = 0; v < FilledPart<dim>::n_vertices; ++v)
          slope += pressure.local_element(vertices.nodes(cell.cell)[v]) * cell.hat_slopes[v];
        if (slope.norm_square() == 0.)
          continue;
        const NodeRow *volumes = part.volumes(cell);
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            forces[grid.nodes(cell.cell)[i]][dim + c] -= volumes[i / n][i % n] * slope[c];
      }
  }

  template class PressurePair<2>;
  template class PressurePair<3>;
} // namespace scree
