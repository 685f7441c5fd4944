// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/transfer/nonlocal_average.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Variance that passes have to add to that of the two transfers, h^2.
    double variance_of_passes(const double ratio)
    {
      return std::max(0., ratio * ratio - 1. / 3.);
    }
  } // namespace


  template <int dim>
  NonlocalAverage<dim>::NonlocalAverage(const BackgroundGrid<dim> &grid)
      : grid(grid)
      , corners(grid.vertices())
      , sums(corners)
      , changes(corners)
  {
  }


  template <int dim>
  void NonlocalAverage<dim>::reinit()
  {
    sums.reinit();
    changes.reinit();
  }


  template <int dim>
  void NonlocalAverage<dim>::update(SoilBody<dim> &body)
  {
    const NonlocalVariable variable = body.material->nonlocal_variable;
    constexpr unsigned int first    = PropertyLayout<dim>::internal_variables;
    add_points(body.points, first + variable.own);
    smooth(body.points, variable.length / grid.cell_size());
    set_points(body.points, first + variable.own, first + variable.averaged);
  }


  template <int dim>
  unsigned int NonlocalAverage<dim>::n_passes(const double ratio)
  {
    constexpr double of_a_pass = 0.5, rounding = 1e-9;
    return static_cast<unsigned int>(std::ceil(variance_of_passes(ratio) / of_a_pass - rounding));
  }


  template <int dim>
  void NonlocalAverage<dim>::add_points(const PointSet<dim> &points, const unsigned int offset)
  {
    sums.clear();
    for (const auto &cell : points.cells())
      {
        VertexRow<dim> of_value{}, of_mass{};
        for_each_point(cell, [&](const auto &point) {
          const VertexRow<dim> masses =
              vertex_values(point.reference_location) * point.properties[PropertyLayout<dim>::mass];
          of_value += masses * point.properties[offset];
          of_mass += masses;
        });
        sums.activate_cell(cell.cell);
        const unsigned int *nodes = corners.nodes(cell.cell);
        for (unsigned int corner = 0; corner < n_corners; ++corner)
          {
            double *sum = sums[nodes[corner]];
            sum[value] += of_value[corner];
            sum[mass] += of_mass[corner];
          }
      }
    sums.add_contributions();
    sums.update_ghosts();
  }


  template <int dim>
  void NonlocalAverage<dim>::smooth(const PointSet<dim> &points, const double ratio)
  {
    const unsigned int n = n_passes(ratio);
    const double part    = n == 0 ? 0. : 2. * variance_of_passes(ratio) / n;
    for (unsigned int pass = 0; pass < n; ++pass)
      {
        for (const unsigned int node : sums.active_nodes())
          std::fill_n(changes[node], 2, 0.);
        changes.clear_ghosts();
        for (const auto &cell : points.cells())
          {
            const unsigned int *nodes = corners.nodes(cell.cell);
            double mean_value = 0., mean_mass = 0.;
            for (unsigned int corner = 0; corner < n_corners; ++corner)
              {
                mean_value += sums[nodes[corner]][value] / n_corners;
                mean_mass += sums[nodes[corner]][mass] / n_corners;
              }
            for (unsigned int corner = 0; corner < n_corners; ++corner)
              {
                const double *sum = sums[nodes[corner]];
                double *change    = changes[nodes[corner]];
                change[value] += mean_value - sum[value];
                change[mass] += mean_mass - sum[mass];
              }
          }
        changes.add_contributions();
        for (const unsigned int node : sums.active_nodes())
          for (const unsigned int i : { value, mass })
            sums[node][i] += part / n_corners * changes[node][i];
        sums.update_ghosts();
      }
  }


  template <int dim>
  void NonlocalAverage<dim>::set_points(PointSet<dim> &points, const unsigned int from, const unsigned int to) const
  {
    constexpr double over = 2.; // m
    for (const auto &cell : points.cells())
      {
        const unsigned int *nodes = corners.nodes(cell.cell);
        VertexRow<dim> means;
        for (unsigned int corner = 0; corner < n_corners; ++corner)
          {
            const double *sum = sums[nodes[corner]];
            means[corner]     = sum[mass] > 0. ? sum[value] / sum[mass] : 0.;
          }
        for_each_point(cell, [&](const auto &point) {
          const VertexRow<dim> parts = vertex_values(point.reference_location) * means;
          double mean                = 0.;
          for (unsigned int corner = 0; corner < n_corners; ++corner)
            mean += parts[corner];
          point.properties[to] = (1. - over) * point.properties[from] + over * mean;
        });
      }
  }

  template class NonlocalAverage<2>;
  template class NonlocalAverage<3>;
} // namespace scree
