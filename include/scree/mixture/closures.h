// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mixture_closures_h
#define scree_mixture_closures_h

#include <cmath>

namespace scree
{
  /// Where soil, water and gaps are, from points that scatter: thresholds, each with its unit and, where it was
  /// switched off by itself, what a scene then shows. They are fractions of a cell, of pores or of a spacing; none is a
  /// length or a time of a case.
  namespace closures
  {
    /// Smallest porosity in the flow between grains: where grains crowd, water shall not race.
    constexpr double least_porosity = 0.01;

    /// Inertia that the pressure moves at a node, over that of water that would fill its surroundings as far as B
    /// integrates: a lighter phase shares the motion of the other; where both are lighter, they count as so much.
    /// Without it points that lie on a floor leave nodes above them next to no mass, which p drives to 1e6 m/s: their
    /// gradient is not small; and soil at such nodes comes to ground at 80 m/s, which gains energy.
    constexpr double least_inertia = 0.01;

    /// Open fraction of a cut cell; less counts as so much.
    constexpr double least_open_fraction = 1e-6;

    /// Distance from a wall, point spacings, at which a point touches it: a little more than the half that it fills.
    constexpr double reach_of_a_point = 0.6;

    /// Fill of a wet cell from which on there is no gap between it and a wall.
    constexpr double full_cell_at_wall = 0.9;

    /// Heights of a fall, cells: what is slower than after it is stopped once it is in the cells beside a wall.
    constexpr double fall_of_wet_soil = 0.125, ///< in scenes with water
        fall_onto_fixed_wall          = 0.5;   ///< in dry scenes, at fixed walls

    /// Surplus of volume, cells, below which a vertex is full: water at rest must not follow its rounding.
    constexpr double least_surplus = 1e-6;

    /// Thickness, cells, of the layer in which water slips over ground whose wall is no slip.
    constexpr double slip_length = 0.01;

    /// Area of a patch of load that a column of nodes must have from the soil's points to be its surface, over the
    /// patch's. Inside a body it is some hundredths, from the scatter of points.
    constexpr double least_area_of_surface = 0.25;

    /// V/V_0 from which on soil has come apart: no node connects its points.
    constexpr double loose = 1.2;
  } // namespace closures


  /// Speed, m/s, after a fall through `height` cells of this size, m, with gravity in m/s^2.
  inline double speed_after_fall(const double height, const double gravity, const double cell_size)
  {
    return std::sqrt(2. * height * gravity * cell_size);
  }

} // namespace scree

#endif
