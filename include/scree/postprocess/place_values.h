// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_place_values_h
#define scree_postprocess_place_values_h

#include <scree/mesh/background_grid.h>
#include <scree/bodies/soil_body.h>
#include <scree/bodies/water_phase.h>

#include <array>
#include <list>
#include <map>
#include <string>
#include <vector>

namespace scree
{
  /// The state of soil and water at given places: of each quantity a linear fit by least squares to the points around
  /// (@source{lancaster1981}), weighted by mass and by 1 - |distance|/(cell size) along each axis. Exact for
  /// linear fields, at walls and surfaces, too; the same on any number of ranks but for rounding.
  template <int dim>
  class PlaceValues
  {
  public:
    /// Lists the places, m.
    PlaceValues(const BackgroundGrid<dim> &grid, const std::vector<dealii::Point<dim>> &places);

    /// Names with units of the quantities of soil: velocity, effective stress (tension positive), P, porosity.
    static std::vector<std::string> names_of_soil();

    /// Names with units of the quantities of water: pore pressure, velocity.
    static std::vector<std::string> names_of_water();

    /// Their values, a row a place; nan where no such point lies within half a cell along each axis. Collective.
    std::vector<std::vector<double>> of_soil(const std::list<SoilBody<dim>> &bodies) const;

    /// The same of the water.
    std::vector<std::vector<double>> of_water(const std::list<WaterPhase<dim>> &water) const;

    /// The places, m, in the order of the rows.
    const std::vector<dealii::Point<dim>> &places() const
    {
      return place_list;
    }

  private:
    using CellPlace = std::array<int, dim>; // numbers of a cell along the axes
    struct Sums;

    /// The places whose values the points of a cell touch.
    const std::vector<unsigned int> &near(const ConstCellPoints<dim> &cell) const;

    /// Adds a point to the sums of a place, unless it is too far.
    void add(Sums &sums,
             const unsigned int place,
             const dealii::Point<dim> &x,
             const double mass,
             const std::vector<double> &values) const;

    std::vector<std::vector<double>> fit(Sums &sums) const;

    const BackgroundGrid<dim> &grid;
    const std::vector<dealii::Point<dim>> place_list;
    std::map<CellPlace, std::vector<unsigned int>> places_near_cell;
  };
} // namespace scree

#endif
