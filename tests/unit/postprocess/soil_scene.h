// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tests_unit_soil_scene_h
#define scree_tests_unit_soil_scene_h

#include <scree/bodies/water_phase.h>
#include <scree/materials/table.h>
#include <scree/mesh/background_grid.h>
#include <scree/seeding/seeding.h>

#include <list>
#include <string>

#include "../grid_box.h"

/// Linear elastic bodies of 1000 kg/m^3, and water, in a box with cells of 0.1 m.
template <int dim>
struct SoilScene
{
  scree::BackgroundGrid<dim> grid;
  std::list<scree::SoilBody<dim>> bodies;
  std::list<scree::WaterPhase<dim>> water;

  /// @param lower, upper coordinates of the corners along each axis, m
  SoilScene(const double lower, const double upper)
      : grid(grid_box<dim>(lower, upper), MPI_COMM_WORLD)
  {
  }

  /// A body without pores.
  void add_soil(const std::string &region)
  {
    add_body(region, 1000., 0, 2);
  }

  /// A body whose points carry water that is `part` of their volume.
  scree::SoilBody<dim> &
  add_wet_soil(const std::string &region, const double part, const unsigned int points_per_cell = 2)
  {
    const unsigned int n_water = scree::WaterLayout<dim>(0, false).n_properties();
    auto &soil                 = add_body(region, 2000., n_water, points_per_cell);
    water.emplace_back(1000., false, soil);
    const auto &layout = water.back().layout;
    for_each_point(soil.points, [&](const auto &point) {
      point.properties[layout.volume] = part * point.properties[soil.layout.volume];
      point.properties[layout.mass]   = 1000. * point.properties[layout.volume];
    });
    return soil;
  }

private:
  scree::SoilBody<dim> &add_body(const std::string &region,
                                 const double grain_density,
                                 const unsigned int n_water,
                                 const unsigned int points_per_cell)
  {
    scree::MaterialParameters material;
    material.law = "linear elastic";
    bodies.emplace_back("Soil",
                        1000.,
                        grain_density,
                        scree::make_material<dim>(material),
                        scree::PropertyLayout<dim>(0, false, n_water),
                        grid.triangulation(),
                        grid.mapping());
    scree::SeedingParameters seeding;
    seeding.region          = region;
    seeding.points_per_cell = points_per_cell;
    scree::seed(bodies.back(), seeding, { grid.triangulation(), grid.cell_size() });
    return bodies.back();
  }
};

#endif
