// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mixture_closures_h
#define scree_mixture_closures_h

#include <algorithm>
#include <cmath>

namespace scree
{
  /// Where soil, water and gaps are, from points that scatter: thresholds, each with its unit and, where it was
  /// switched off by itself, what a scene then shows. They are fractions of a cell, of pores or of a spacing; none is a
  /// length or a time of a case.
  namespace closures
  {
    /// How far the volume of water in a cell may differ from that of the soil's pores by the scatter of points alone,
    /// over the latter: of four points an axis three or five may be in a cell. Without it a saturated soil settles
    /// under its own weight by 2 % too much.
    constexpr double point_scatter = 0.3;

    /// Solid and pore volume over cell volume from which on, and up to which, soil fills a cell or ends in it, as far
    /// as the scatter of points can tell. Without the share of drag that follows, water infiltrates 10 % too fast.
    constexpr double cell_full_of_soil = 0.9,  ///< soil that takes more fills the cell
        cell_at_end_of_soil            = 0.75; ///< soil that takes less ends in the cell

    /// Water that the wet pores lack, over their volume: up to the first by scatter, from the second on for sure.
    /// Without it the tip of a wetting front is 1.13 times as far as it should be (h = .05 m).
    constexpr double lack_by_scatter = 0.15, ///< a smaller lack is scatter of points
        lack_for_sure                = 0.25; ///< a larger lack is one of water

    /// Smallest porosity in the flow between grains: where grains crowd, water shall not race.
    constexpr double least_porosity = 0.1;

    /// Fill of a cell from which on its whole, and up to which only the filled part enters the divergence. Without it
    /// water at low stress makes energy, 134 % of what is released.
    constexpr double full_cell_in_divergence = 0.95, ///< a fuller cell enters as a whole
        partly_full_cell_in_divergence       = 0.85; ///< of an emptier cell the filled part enters

    /// Inertia of a phase that the pressure moves at a node, over that of water that would fill its surroundings as far
    /// as B integrates. Without it points that lie on a floor leave nodes above them next to no mass, which p drives
    /// to 1e6 m/s: their gradient is not small.
    constexpr double least_inertia = 1e-3;

    /// Open fraction of a cut cell; less counts as so much.
    constexpr double least_open_fraction = 1e-6;

    /// Depth, cells, of a pressure vertex below the free surface; less counts as so much.
    constexpr double least_vertex_depth = 0.25;

    /// Solid fraction of the filled volume about a vertex from which on it counts as soil: excludes stray points in a
    /// jet. Without it water between bodies of soil makes energy, 13.5 %.
    constexpr double least_solid_fraction = 0.2;

    /// Dry soil about a vertex beside the water's surface, over the volume there: up to the first by the scatter of
    /// points, from the second on the surface lies in soil.
    constexpr double least_dry_soil = 0.1,  ///< less is scatter of points
        surely_dry_soil             = 0.25; ///< more is soil behind the surface

    /// Fill about a vertex on the ground below which there is no depth of water.
    constexpr double least_fill_above_ground = 0.25;

    /// Fill of a cell from which on its soil reaches all of its sides, so that there is no gap between bodies. Without
    /// these gaps soil that falls on soil makes energy, 1.5 %.
    constexpr double full_cell_beside_gap = 0.95;

    /// Distance, cells, of the centre of what fills a cell from its middle, from which on there may be a gap beside it.
    constexpr double least_offset_beside_gap = 0.1;

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

    /// V/V_0 from which on soil has come apart: no node tells its points of their neighbours.
    constexpr double loose = 1.2;
  } // namespace closures


  /// Speed, m/s, after a fall through `height` cells of this size, m, with gravity in m/s^2.
  inline double speed_after_fall(const double height, const double gravity, const double cell_size)
  {
    return std::sqrt(2. * height * gravity * cell_size);
  }

  /// Effective saturation: part of the pores that water fills; 1 also where the scatter of points explains what is
  /// missing (CellContents::saturation() is the part itself). Without this the scatter takes buoyancy from the grains:
  /// a saturated soil settles under its own weight by 2 % too much.
  inline double effective_saturation_of(const double water_volume, const double pore_volume)
  {
    const double full = (1. - closures::point_scatter) * pore_volume;
    return water_volume < full ? water_volume / full : (water_volume > 0 ? 1. : 0.);
  }

  /// Drag on the water of a cell's soil over that on water that fills its pores: in proportion to the water's volume,
  /// as the force of the pressure on it is, within the scatter of points. Bounded by 1 it is biased low, as an
  /// excess of water gets no extra drag while a deficit gets less, and soil consolidates 4 % too fast. Water outside
  /// the soil has no part in it: that of the room that soil leaves of a full cell, but none where grains lack that no
  /// water has taken the place of.
  inline double
  drag_share_of(const double cell_volume, const double grains, const double pore_volume, const double water_volume)
  {
    using closures::cell_full_of_soil, closures::cell_at_end_of_soil;
    if (pore_volume <= 0.)
      return 0.;
    const double soil = grains + pore_volume;
    const double room = cell_volume - soil * std::max(1., (cell_volume - water_volume) / grains);
    const double ends =
        std::clamp((cell_full_of_soil - soil / cell_volume) / (cell_full_of_soil - cell_at_end_of_soil), 0., 1.);
    const double outside = ends * std::max(0., room);
    return std::clamp((water_volume - outside) / pore_volume, 0., 1. + closures::point_scatter);
  }

  /// Part of a node or cell that grains take of the mixture there: its velocity is this part of the soil's, the rest of
  /// the water's. Between the grains is the water, but the wet pores where water lacks more of these than the scatter
  /// of points explains. There few points would lend the flow their own porosity, which is too small: the tip of a
  /// wetting front would run ahead.
  inline double grain_fraction_of(const double grains, const double water_volume, const double wet_pores)
  {
    using closures::lack_by_scatter, closures::lack_for_sure;
    if (grains <= 0.)
      return 0.;
    double between = water_volume;
    if (wet_pores > 0.)
      {
        const double lack = wet_pores - water_volume;
        between += lack * std::clamp((lack / wet_pores - lack_by_scatter) / (lack_for_sure - lack_by_scatter), 0., 1.);
      }
    return grains / (grains + between);
  }
} // namespace scree

#endif
