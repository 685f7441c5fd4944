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
                 const unsigned int points_per_cell,
                 const std::string &velocity = "")
{
  SeedingParameters seeding;
  seeding.region           = region;
  seeding.points_per_cell  = points_per_cell;
  seeding.initial_velocity = velocity;
  seed(body, seeding, { grid.triangulation(), grid.cell_size() });
}


/// Moves points out of their lattice, by up to a centimetre.
template <int dim>
void shake(PointSet<dim> &points)
{
  for_each_point(points, [&](const auto &point) {
    const Point<dim> x = point.location;
    for (unsigned int a = 0; a < dim; ++a)
      point.location[a] += 0.01 * pattern(x + Point<dim>::unit_vector(a));
  });
  points.hand_over();
}


/// Linear elastic soil, of grains of 2500 kg/m^3 unless another density is given, in a region of a grid; "none" has no
/// points.
template <int dim>
struct ElasticSoil : SoilBody<dim>
{
  ElasticSoil(const BackgroundGrid<dim> &grid,
              const std::string &region,
              const unsigned int points_per_cell,
              const double porosity,
              const double density_of_grains    = 2500.,
              const PropertyLayout<dim> &layout = PropertyLayout<dim>(0, false),
              const std::string &velocity       = "")
      : SoilBody<dim>("Soil",
                      density_of_grains * (1. - porosity),
                      density_of_grains,
                      elastic_material<dim>(),
                      layout,
                      grid.triangulation(),
                      grid.mapping())
  {
    if (region != "none")
      seed_region(*this, grid, region, points_per_cell, velocity);
  }
};


/// Water up to y = 0.44 m in a box of 6 cells an axis, with elastic soil of porosity 0.4 where an expression says, and
/// their nodes.
template <int dim>
struct WetScene
{
  /// @param points_of_soil in a cell, along each axis
  WetScene(const std::string &basis,
           const std::string &method,
           const std::string &soil_region,
           const unsigned int points_of_soil)
      : grid(grid_box<dim>(0., 0.6, 0.1, basis), MPI_COMM_WORLD)
      , soil(grid, soil_region, points_of_soil, 0.4)
      , water(1000., true, grid.triangulation(), grid.mapping())
      , mixture(grid, points_of_soil)
  {
    water_parameters.region          = "y < 0.44";
    water_parameters.points_per_cell = 3;
    const SoilRegion region{ "Soil", soil_region == "none" ? "0" : soil_region, 0.4, soil.density };
    seed_water(water, water_parameters, { region }, { grid.triangulation(), grid.cell_size() });
    transfer_parameters.method   = method;
    transfer_parameters.pic_rate = 0;
    soil.drag.emplace(water_parameters, 0.4);
    transfer = std::make_unique<WaterTransfer<dim>>(grid, transfer_parameters, water_parameters);
  }

  /// Points to nodes, summed over ranks.
  void gather()
  {
    transfer->soil_to_grid(soil, mixture);
    transfer->to_grid(water, mixture, nodes);
    for (const auto &cell : mixture.cells())
      nodes.activate_cell(cell.cell);
    nodes.add_contributions(1.);
  }

  const BackgroundGrid<dim> grid;
  ElasticSoil<dim> soil;
  WaterPhase<dim> water;
  WaterParameters water_parameters;
  TransferParameters transfer_parameters;
  std::unique_ptr<WaterTransfer<dim>> transfer;
  Mixture<dim> mixture;
  NodalField<dim> soil_field{ grid };
  WetNodes<dim> nodes{ grid, soil_field };
};


/// Linear elastic bodies of 1000 kg/m^3, and water, in a box with cells of 0.1 m.
template <int dim>
struct SoilScene
{
  BackgroundGrid<dim> grid;
  std::list<SoilBody<dim>> bodies;
  std::list<WaterPhase<dim>> water;

  /// @param lower, upper coordinates of the corners along each axis, m
  SoilScene(const double lower, const double upper)
      : grid(grid_box<dim>(lower, upper), MPI_COMM_WORLD)
  {
  }

  /// A body without pores.
  SoilBody<dim> &add_soil(const std::string &region, const unsigned int points_per_cell = 2)
  {
    return add_body(region, 1000., 0, points_per_cell);
  }

  /// A body whose points carry water that is `part` of their volume.
  SoilBody<dim> &add_wet_soil(const std::string &region, const double part, const unsigned int points_per_cell = 2)
  {
    auto &soil = add_body(region, 2000., WaterLayout<dim>(0, false).n_properties(), points_per_cell);
    water.emplace_back(1000., false, soil);
    const auto &layout = water.back().layout;
    for_each_point(soil.points, [&](const auto &point) {
      point.properties[layout.volume] = part * point.properties[soil.layout.volume];
      point.properties[layout.mass]   = 1000. * point.properties[layout.volume];
    });
    return soil;
  }

private:
  SoilBody<dim> &add_body(const std::string &region,
                          const double grain_density,
                          const unsigned int n_water,
                          const unsigned int points_per_cell)
  {
    bodies.emplace_back("Soil",
                        1000.,
                        grain_density,
                        elastic_material<dim>(),
                        PropertyLayout<dim>(0, false, n_water),
                        grid.triangulation(),
                        grid.mapping());
    seed_region(bodies.back(), grid, region, points_per_cell);
    return bodies.back();
  }
};

#endif
