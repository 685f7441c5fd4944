// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tests_unit_elastic_soil_h
#define scree_tests_unit_elastic_soil_h

#include <scree/mesh/background_grid.h>
#include <scree/materials/table.h>
#include <scree/seeding/seeding.h>

#include <string>

/// Linear elastic soil, of grains of 2500 kg/m^3 unless told, in a region of a grid; "none" has no points.
template <int dim>
struct ElasticSoil : scree::SoilBody<dim>
{
  ElasticSoil(const scree::BackgroundGrid<dim> &grid,
              const std::string &region,
              const unsigned int points_per_cell,
              const double porosity,
              const double density_of_grains           = grain_density,
              const scree::PropertyLayout<dim> &layout = scree::PropertyLayout<dim>(0, false),
              const std::string &velocity              = "")
      : scree::SoilBody<dim>("Soil",
                             density_of_grains * (1. - porosity),
                             density_of_grains,
                             scree::make_material<dim>(material()),
                             layout,
                             grid.triangulation(),
                             grid.mapping())
  {
    scree::SeedingParameters seeding;
    seeding.region           = region;
    seeding.points_per_cell  = points_per_cell;
    seeding.initial_porosity = porosity;
    seeding.initial_velocity = velocity;
    if (region != "none")
      scree::seed(*this, seeding, { grid.triangulation(), grid.cell_size() });
  }

  static constexpr double grain_density = 2500.;

private:
  static scree::MaterialParameters material()
  {
    scree::MaterialParameters parameters;
    parameters.law = "linear elastic";
    return parameters;
  }
};

#endif
