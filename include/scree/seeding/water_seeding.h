// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_seeding_water_seeding_h
#define scree_seeding_water_seeding_h

#include <scree/seeding/seeding.h>
#include <scree/bodies/water_parameters.h>
#include <scree/bodies/water_phase.h>

#include <vector>

namespace scree
{
  /// A part of the water's region, and how much room there is for water.
  template <int dim>
  struct WaterPart
  {
    Region<dim> region;     ///< place of the water
    double porosity;        ///< 1 outside the soil
    const SoilRegion *soil; ///< null outside
  };

  /// The water's region, cut along the surfaces of the soil. Refers to `soil`.
  template <int dim>
  std::vector<WaterPart<dim>> water_parts(const WaterParameters &parameters, const std::vector<SoilRegion> &soil);

  /// Throws EntryError unless a body in the water has pores.
  void require_pores(const SoilRegion &soil);

  /// Fills the pores of the points that carry the water: its volume is theirs less the grains', its velocity theirs.
  /// Water with points of its own: fills its region with them, on a lattice as seed() does. A point's volume is that of
  /// the water itself: porosity times the part of its cube in soil, plus the part outside; its mass is density times
  /// volume. They get the velocity of the entry; pressure is 0. Collective; throws EntryError if the region holds no
  /// volume, or covers a body without pores.
  /// @param ground only what is in its open is filled; null: all
  template <int dim>
  void seed_water(WaterPhase<dim> &water,
                  const WaterParameters &parameters,
                  const std::vector<SoilRegion> &soil,
                  const dealii::Triangulation<dim> &triangulation,
                  const double cell_size,
                  const LevelSet<dim> *ground = nullptr);
} // namespace scree

#endif
