// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_measures_h
#define scree_postprocess_measures_h

#include <scree/mesh/discrete_level_set.h>
#include <scree/bodies/soil_body.h>
#include <scree/bodies/water_phase.h>

#include <list>
#include <vector>

namespace scree
{
  /// A mass, kg, and a number of it, such as a coordinate or a speed.
  struct PartOfMass
  {
    double place; ///< the number
    double mass;  ///< kg
  };

  /// The numbers below which the given fractions of the mass of all ranks lie; `lower` without mass. Collective.
  /// @param lower, upper all numbers are at least the first and less than the second
  std::vector<double> percentiles(const std::vector<PartOfMass> &parts,
                                  const double lower,
                                  const double upper,
                                  const std::vector<double> &fractions,
                                  const MPI_Comm communicator);

  /// The coordinates along `axis` below which the given fractions of the mass of all bodies lie, m. Collective.
  template <int dim>
  std::vector<double> mass_percentiles(const std::list<SoilBody<dim>> &bodies,
                                       const BackgroundGrid<dim> &grid,
                                       const unsigned int axis,
                                       const std::vector<double> &fractions);

  /// The same of the mass of the water. Collective.
  template <int dim>
  std::vector<double> mass_percentiles(const std::list<WaterPhase<dim>> &water,
                                       const BackgroundGrid<dim> &grid,
                                       const unsigned int axis,
                                       const std::vector<double> &fractions);

  /// Least distance of a point from the surface, m, see DiscreteLevelSet::distance_of(). Collective.
  template <int dim>
  double least_distance(const std::list<SoilBody<dim>> &bodies,
                        const std::list<WaterPhase<dim>> &water,
                        const DiscreteLevelSet<dim> &surface,
                        const MPI_Comm communicator);

  /// Oscillation of P: the rms, over the points of all bodies, of P minus a linear fit of P over the 3^dim cells around
  /// the point's cell, over the mean of P. 0 where the soil has no stress. Collective.
  template <int dim>
  double stress_oscillation(const std::list<SoilBody<dim>> &bodies, const BackgroundGrid<dim> &grid);

  /// The same of the pore pressure at the water points. 0 unless its mean is positive. Collective.
  template <int dim>
  double pressure_oscillation(const std::list<WaterPhase<dim>> &water, const BackgroundGrid<dim> &grid);

  /// What the statistics say of the water of all ranks (2D: per m).
  struct WaterMeasures
  {
    double n_points          = 0; ///< number of points
    double mass              = 0; ///< kg
    double mass_outside_soil = 0; ///< in cells without soil points, kg
    double smallest_pressure = 0; ///< p of points, Pa
    double largest_pressure  = 0; ///< Pa
    double tip               = 0; ///< largest x of points; the lower corner's x without points, m
    double volume_error      = 0; ///< grains and water beyond their cells' volume, over all grains and water
  };

  /// Collective.
  template <int dim>
  WaterMeasures measure_water(const std::list<SoilBody<dim>> &bodies,
                              const std::list<WaterPhase<dim>> &water,
                              const BackgroundGrid<dim> &grid);
} // namespace scree

#endif
