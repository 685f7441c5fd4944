// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/ground_gaps.h>
#include <scree/mixture/mixture.h>

#include <algorithm>
#include <limits>

namespace scree
{
  using namespace dealii;

  template <int dim>
  GroundGaps<dim>::GroundGaps(const BackgroundGrid<dim> &grid, const CutCells<dim> *cut_cells, const double gravity)
      : grid(grid)
      , cut_cells(cut_cells)
      , slow(speed_after_fall(closures::fall_of_wet_soil, gravity, grid.cell_size()))
  {
  }


  template <int dim>
  void GroundGaps<dim>::clear()
  {
    if (cut_cells == nullptr)
      return;
    const unsigned int n_facets = cut_cells->segments().size();
    gaps.assign(n_facets, grid.cell_size()); // a cell without particles
    closing_gaps.assign(n_facets, 0.);
    closing_times.assign(n_facets, std::numeric_limits<double>::infinity());
  }


  template <int dim>
  void GroundGaps<dim>::add(const PointSet<dim> &points, const unsigned int velocity, const double spacing)
  {
    if (cut_cells == nullptr)
      return;
    const double reach = closures::reach_of_a_point * spacing;
    for (const auto &cell : points.cells())
      if (const CutCell<dim> *cut = cut_cells->find(cell.cell))
        for (unsigned int s = cut->first_segment; s < cut->first_segment + cut->n_segments; ++s)
          {
            const CutFacet<dim> &facet = cut_cells->segments()[s];
            const double of_ground     = facet.normal * cut_cells->velocity(facet);
            for_each_point(cell, [&](const auto &point) {
              const double gap = (facet.middle - point.location) * facet.normal - reach;
              gaps[s]          = std::min(gaps[s], gap);
              double speed     = -of_ground;
              for (unsigned int a = 0; a < dim; ++a)
                speed += facet.normal[a] * point.properties[velocity + a];
              if (const double time = gap <= 0. || speed <= slow ? 0. : gap / speed; time < closing_times[s])
                {
                  closing_times[s] = time;
                  closing_gaps[s]  = gap;
                }
            });
          }
  }

  template class GroundGaps<2>;
  template class GroundGaps<3>;
} // namespace scree
