// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tests_unit_soil_h
#define scree_tests_unit_soil_h

#include "test.h"

#include <scree/bodies/phases.h>
#include <scree/materials/table.h>
#include <scree/seeding/seeding.h>
#include <scree/transfer/water_transfer.h>

#include <list>

template <int dim>
std::unique_ptr<Material<dim>> elastic_material()
{
  MaterialParameters parameters;
  parameters.law = "linear elastic";
  return make_material<dim>(parameters);
}

template <int dim>
void seed_region(SoilBody<dim> &body,
                 const BackgroundGrid<dim> &grid,
                 const std::string &region,
                 const unsigned int points_per_cell)
{
  SeedingParameters seeding;
  seeding.region          = region;
  seeding.points_per_cell = points_per_cell;
  seed(body, seeding, { grid.triangulation(), grid.cell_size() });
}


/// Linear elastic soil, of grains of 2500 kg/m^3 unless another density is given, in a region of a grid.
template <int dim>
struct ElasticSoil : SoilBody<dim>
{
  ElasticSoil(const BackgroundGrid<dim> &grid,
              const std::string &region,
              const unsigned int points_per_cell,
              const double porosity,
              const double density_of_grains    = 2500.,
              const PropertyLayout<dim> &layout = PropertyLayout<dim>(0, false))
      : SoilBody<dim>("Soil",
                      density_of_grains * (1. - porosity),
                      density_of_grains,
                      elastic_material<dim>(),
                      layout,
                      grid.triangulation(),
                      grid.mapping())
  {
    seed_region(*this, grid, region, points_per_cell);
  }
};


/// Linear elastic bodies of 1000 kg/m^3 in a box with cells of 0.1 m, without water.
template <int dim>
struct SoilScene
{
  BackgroundGrid<dim> grid;
  std::list<SoilBody<dim>> bodies;
  const std::list<WaterPhase<dim>> water;

  /// @param lower, upper coordinates of the corners along each axis, m
  SoilScene(const double lower, const double upper)
      : grid(grid_box<dim>(lower, upper), MPI_COMM_WORLD)
  {
  }

  /// A body without pores.
  SoilBody<dim> &add_soil(const std::string &region, const unsigned int points_per_cell = 2)
  {
    bodies.emplace_back("Soil",
                        1000.,
                        1000.,
                        elastic_material<dim>(),
                        PropertyLayout<dim>(0, false),
                        grid.triangulation(),
                        grid.mapping());
    seed_region(bodies.back(), grid, region, points_per_cell);
    return bodies.back();
  }
};

#endif
