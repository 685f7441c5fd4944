// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/cell_contents.h>

#include <scree/tensor/invariants.h>

#include <algorithm>

namespace scree
{
  double CellContents::saturation(const double cell_volume) const
  {
    const double pores = n_soil_points > 0 ? soil_volume - grain_volume : cell_volume;
    if (pores <= 0) // soil crushed to its grains: what water there is overflows
      return water_volume > 0 ? 1. : 0.;
    return std::min(1., water_volume / pores);
  }


  template <int dim>
  std::vector<CellContents> contents_of_cells(const std::list<SoilBody<dim>> &bodies,
                                              const std::list<WaterPhase<dim>> &water,
                                              const BackgroundGrid<dim> &grid)
  {
    std::vector<CellContents> contents(grid.triangulation().n_active_cells());
    for (const auto &body : bodies)
      for_each_point(body.points, [&](const auto &point) {
        CellContents &sums       = contents[point.cell];
        const double *properties = point.properties;
        const double volume      = properties[body.layout.volume];
        ++sums.n_soil_points;
        sums.soil_mass += properties[body.layout.mass];
        sums.soil_volume += volume;
        sums.grain_volume += properties[body.layout.mass] / body.grain_density;
        sums.soil_pressure += volume * mean_effective_stress(properties + body.layout.stress);
      });
    for (const auto &one : water)
      for_each_point(one.points(), [&](const auto &point) {
        CellContents &sums = contents[point.cell];
        ++sums.n_water_points;
        sums.water_mass += point.properties[one.layout.mass];
        sums.water_volume += point.properties[one.layout.volume];
      });
    return contents;
  }

  template std::vector<CellContents>
  contents_of_cells(const std::list<SoilBody<2>> &, const std::list<WaterPhase<2>> &, const BackgroundGrid<2> &);
  template std::vector<CellContents>
  contents_of_cells(const std::list<SoilBody<3>> &, const std::list<WaterPhase<3>> &, const BackgroundGrid<3> &);
} // namespace scree
