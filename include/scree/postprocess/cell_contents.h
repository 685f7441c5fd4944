// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_cell_contents_h
#define scree_postprocess_cell_contents_h

#include <scree/mesh/background_grid.h>
#include <scree/bodies/soil_body.h>
#include <scree/bodies/water_phase.h>

#include <list>
#include <vector>

namespace scree
{
  /// Sums over the points of one cell (2D: per m).
  struct CellContents
  {
    unsigned int n_soil_points = 0, ///< number of points of soil
        n_water_points         = 0; ///< number of points of water
    double soil_mass           = 0; ///< kg
    double soil_volume         = 0; ///< with pores, m^3
    double grain_volume        = 0; ///< m^3
    double soil_pressure       = 0; ///< volume times P, J
    double water_mass          = 0; ///< kg
    double water_volume        = 0; ///< m^3

    /// Whether no point lies in the cell.
    bool is_empty() const
    {
      return n_soil_points == 0 && n_water_points == 0;
    }

    /// Of the soil; 1 without soil.
    double porosity() const
    {
      return soil_volume > 0 ? 1. - grain_volume / soil_volume : 1.;
    }

    /// Water volume over pore volume, at most 1; without soil the whole cell, m^3, is pore.
    double saturation(const double cell_volume) const;
  };

  /// What the cells of this rank hold, by active cell index; other ranks' cells are empty.
  template <int dim>
  std::vector<CellContents> contents_of_cells(const std::list<SoilBody<dim>> &bodies,
                                              const std::list<WaterPhase<dim>> &water,
                                              const BackgroundGrid<dim> &grid);
} // namespace scree

#endif
