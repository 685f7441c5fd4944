// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/ground_gaps.h>
#include <scree/mixture/closures.h>

#include <algorithm>

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
    if (cut_cells != nullptr)
      gaps.assign(cut_cells->segments().size(), grid.cell_size()); // a cell without particles
  }


  template <int dim>
  void GroundGaps<dim>::add(const PointSet<dim> &points, const double spacing)
  {
    if (cut_cells == nullptr)
      return;
    const double reach = closures::reach_of_a_point * spacing;
    for (const auto &cell : points.cells())
      if (const CutCell<dim> *cut = cut_cells->find(cell.cell))
        for (unsigned int s = cut->first_segment; s < cut->first_segment + cut->n_segments; ++s)
          {
            const CutFacet<dim> &facet = cut_cells->segments()[s];
            for (unsigned int p = 0; p < cell.n_points; ++p)
              gaps[s] = std::min(gaps[s], (facet.middle - cell.location_of(p)) * facet.normal - reach);
          }
  }

  template class GroundGaps<2>;
  template class GroundGaps<3>;
} // namespace scree
