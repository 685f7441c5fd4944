// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/divergence.h>
#include <scree/mixture/closures.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  template <unsigned int n_1d>
  MixtureDivergence<dim>::Rule<n_1d>::Rule()
  {
    const QGauss<dim> gauss(n_1d);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        points[q]  = gauss.point(q);
        weights[q] = gauss.weight(q);
      }
    find_shapes();
  }


  template <int dim>
  template <unsigned int n_1d>
  void MixtureDivergence<dim>::Rule<n_1d>::find_shapes()
  {
    for (unsigned int q = 0; q < n_points; ++q)
      for (unsigned int v = 0; v < n_vertices; ++v)
        shapes[q][v] = GeometryInfo<dim>::d_linear_shape_function(points[q], v);
  }


  template <int dim>
  MixtureDivergence<dim>::MixtureDivergence(const BackgroundGrid<dim> &grid,
                                            const NodeNumbering<dim> &vertices,
                                            const FreeSurface<dim> &surface,
                                            const double gravity,
                                            const CutCells<dim> *cut_cells,
                                            const GroundGaps<dim> &ground_gaps)
      : grid(grid)
      , vertices(vertices)
      , surface(surface)
      , square_of_slow(gravity / grid.cell_size())
      , cut_cells(cut_cells)
      , ground_gaps(ground_gaps)
  {
  }


  template <int dim>
  Tensor<1, dim> MixtureDivergence<dim>::off_middle(const MixtureCell<dim> &cell) const
  {
    const Point<dim> centre = cell.centre();
    const double fill       = cell.fill * cell.volume / Utilities::fixed_power<dim>(grid.cell_size()); // of the whole
    constexpr double full   = closures::full_cell_in_divergence;
    const double share      = std::clamp((full - fill) / (full - closures::partly_full_cell_in_divergence), 0., 1.);
    Tensor<1, dim> off;
    for (unsigned int a = 0; a < dim; ++a)
      off[a] = share * (centre[a] - 0.5);
    return off;
  }


  template <int dim>
  typename MixtureDivergence<dim>::template Rule<2> MixtureDivergence<dim>::rule_in(const MixtureCell<dim> &cell) const
  {
    const Tensor<1, dim> off = off_middle(cell);
    Rule<2> rule             = whole;
    for (Point<dim> &point : rule.points)
      for (unsigned int a = 0; a < dim; ++a)
        point[a] = in_box(point[a], off[a]);
    rule.find_shapes();
    return rule;
  }


  namespace
  {
    /// One component of a field at the nodes of a cell, in rows.
    template <int dim, int n, typename Function>
    void gather(const unsigned int *nodes, const Function &value_of_node, NodeRow (&rows)[RowFactors<dim, n>::n_rows])
    {
      for (unsigned int r = 0; r < RowFactors<dim, n>::n_rows; ++r)
        {
          std::array<double, n> row;
          for (unsigned int i = 0; i < n; ++i)
            row[i] = value_of_node(nodes[r * n + i]);
          rows[r] = make_row(row);
        }
    }
  } // namespace


  template <int dim>
  template <int n, unsigned int n_1d>
  void MixtureDivergence<dim>::add_integrals(const Rule<n_1d> &rule,
                                             const double *weights,
                                             const double scale,
                                             const OpenKnots open,
                                             const Flow<n> &flow,
                                             AtVertices &integrals) const
  {
    constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
    const double inverse_width    = 1. / grid.cell_size();
    for (unsigned int q = 0; q < rule.n_points; ++q)
      {
        const CellBasis<dim, n> basis(rule.points[q], open);
        const RowFactors<dim, n> rows(basis);
        const NodeRow value_x = make_row(basis.value[0]), derivative_x = make_row(basis.derivative[0]);
        const auto slope = [&](const NodeRow(&field)[n_rows], const unsigned int a) {
          return inverse_width * (a == 0 ? sum(contract(rows.value, field) * derivative_x)
                                         : sum(contract(rows.derivative[a - 1], field) * value_x));
        };
        double divergence = 0;
        for (unsigned int c = 0; c < dim; ++c)
          divergence += slope(flow.rows[c], c);
        const double weighted = -scale * weights[q] * divergence;
        for (unsigned int v = 0; v < n_vertices; ++v)
          integrals[v] += weighted * rule.shapes[q][v];
      }
  }


  template <int dim>
  template <int n>
  void MixtureDivergence<dim>::add_ground(const unsigned int number,
                                          const Flow<n> &flow,
                                          const double time_step,
                                          AtVertices &integrals) const
  {
    const CutFacet<dim> &segment = cut_cells->segments()[number];
    double speed                 = -(segment.normal * cut_cells->velocity(segment)); // out of the open, from the ground
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < segment.shapes.size(); ++i)
        speed += segment.normal[c] * segment.shapes[i] * flow.rows[c][i / n][i % n];
    if (speed < 0. && !surface.has_unknown(segment.cell))
      return; // Water may leave ground that it does not press on.
    if (const double allowed = ground_gaps.allowed_approach(number, speed, time_step); allowed > 0.)
      speed = std::max(0., speed - allowed);
    for (unsigned int v = 0; v < n_vertices; ++v)
      integrals[v] += segment.area * speed * segment.vertex_weights[v];
  }


  template <int dim>
  template <int n>
  typename MixtureDivergence<dim>::template Flow<n> MixtureDivergence<dim>::flow_in(const unsigned int cell,
                                                                                    const NodalField<dim> &soil,
                                                                                    const NodalField<dim> &water,
                                                                                    const PoreField<dim> &pores) const
  {
    constexpr unsigned int velocity = NodalField<dim>::velocity;
    // Form the mixture's velocity at the nodes: interpolating the fraction of grains separately gives light nodes,
    // whose soil is fast where points have just entered a cell, the wrong weight.
    Flow<n> flow;
    for (unsigned int c = 0; c < dim; ++c)
      gather<dim, n>(
          grid.nodes(cell),
          [&](const unsigned int node) {
            const double grains = pores[node][PoreField<dim>::grain_fraction];
            return grains * soil[node][velocity + c] + (1. - grains) * water[node][velocity + c];
          },
          flow.rows[c]);
    return flow;
  }


  template <int dim>
  template <int n>
  void MixtureDivergence<dim>::integrate_cells(const Mixture<dim> &mixture,
                                               const NodalField<dim> &soil,
                                               const NodalField<dim> &water,
                                               const PoreField<dim> &pores,
                                               const double time_step,
                                               VertexVector &sums)
  {
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    for (const MixtureCell<dim> &cell : mixture.cells())
      {
        if (cell.water_volume == 0)
          continue;
        const Flow<n> flow   = flow_in<n>(cell.cell, soil, water, pores);
        const OpenKnots open = grid.open_knots(cell.cell);
        const double scale   = cell_volume * std::min(cell.fill, 1.);
        AtVertices integrals{};
        if (const CutCell<dim> *cut = cut_cells ? cut_cells->find(cell.cell) : nullptr)
          {
            add_integrals<n>(cut_rule, cut->weights.data(), scale, open, flow, integrals);
            for (unsigned int s = cut->first_segment; s < cut->first_segment + cut->n_segments; ++s)
              add_ground<n>(s, flow, time_step, integrals);
          }
        else if (cell.fill < closures::full_cell_in_divergence && cell.soil_mass > 0.)
          add_integrals<n>(rule_in(cell), whole.weights.data(), scale, open, flow, integrals);
        else
          add_integrals<n>(whole, whole.weights.data(), scale, open, flow, integrals);
        for (unsigned int v = 0; v < n_vertices; ++v)
          sums.local_element(vertices.nodes(cell.cell)[v]) += integrals[v];
      }
  }


  template <int dim>
  void MixtureDivergence<dim>::integrate(const Mixture<dim> &mixture,
                                         const NodalField<dim> &soil,
                                         const NodalField<dim> &water,
                                         const PoreField<dim> &pores,
                                         const double time_step,
                                         VertexVector &sums)
  {
    sums = 0.;
    if (grid.n_nodes_1d() == 2)
      integrate_cells<2>(mixture, soil, water, pores, time_step, sums);
    else
      integrate_cells<3>(mixture, soil, water, pores, time_step, sums);
    sums.compress(VectorOperation::add);
  }


  template <int dim>
  template <int n>
  double MixtureDivergence<dim>::mean_divergence(const MixtureCell<dim> &cell, const Flow<n> &flow) const
  {
    // Means over a box of products are products of means along the axes, for which two Gauss points are exact.
    const Tensor<1, dim> off = off_middle(cell);
    Point<dim> lower, upper;
    for (unsigned int a = 0; a < dim; ++a)
      {
        lower[a] = in_box(whole.points[0][a], off[a]);
        upper[a] = in_box(whole.points[Rule<2>::n_points - 1][a], off[a]);
      }
    const OpenKnots open = grid.open_knots(cell.cell);
    CellBasis<dim, n> mean(lower, open);
    const CellBasis<dim, n> other(upper, open);
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int i = 0; i < n; ++i)
        {
          mean.value[a][i]      = 0.5 * (mean.value[a][i] + other.value[a][i]);
          mean.derivative[a][i] = 0.5 * (mean.derivative[a][i] + other.derivative[a][i]);
        }
    const RowFactors<dim, n> rows(mean);
    double divergence = sum(contract(rows.value, flow.rows[0]) * make_row(mean.derivative[0]));
    for (unsigned int c = 1; c < dim; ++c)
      divergence += sum(contract(rows.derivative[c - 1], flow.rows[c]) * make_row(mean.value[0]));
    return divergence / grid.cell_size();
  }


  template <int dim>
  template <int n>
  void MixtureDivergence<dim>::set_volume_factors(Mixture<dim> &mixture,
                                                  const NodalField<dim> &soil,
                                                  const NodalField<dim> &water,
                                                  const PoreField<dim> &pores,
                                                  const SoilGaps<dim> &gaps,
                                                  const double time_step) const
  {
    for (unsigned int record = 0; record < mixture.cells().size(); ++record)
      {
        MixtureCell<dim> &cell   = mixture.cells()[record];
        const bool is_beside_gap = gaps.is_beside(record);
        if (cell.soil_mass == 0. || cell.is_rigid || !surface.has_unknown(cell.cell) ||
            (cell.effective_saturation < 1. && !is_beside_gap))
          continue;
        const double rate = mean_divergence<n>(cell, flow_in<n>(cell.cell, soil, water, pores));
        if (rate >= 0.)
          continue;
        const double drag = cell.drag * time_step, square = rate * rate;
        const double part  = is_beside_gap ? 1. : drag / (drag + cell.water_mass) * square / (square + square_of_slow);
        cell.volume_factor = std::exp(-part * rate * time_step);
      }
  }


  template <int dim>
  void MixtureDivergence<dim>::find_volume_factors(Mixture<dim> &mixture,
                                                   const NodalField<dim> &soil,
                                                   const NodalField<dim> &water,
                                                   const PoreField<dim> &pores,
                                                   const SoilGaps<dim> &gaps,
                                                   const double time_step) const
  {
    if (grid.n_nodes_1d() == 2)
      set_volume_factors<2>(mixture, soil, water, pores, gaps, time_step);
    else
      set_volume_factors<3>(mixture, soil, water, pores, gaps, time_step);
  }

  template class MixtureDivergence<2>;
  template class MixtureDivergence<3>;
} // namespace scree
