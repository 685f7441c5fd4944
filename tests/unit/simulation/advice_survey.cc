// SPDX-License-Identifier: LGPL-2.1-or-later
// What an advice finds in the points of a case: sizes, counts, stiffness and fall of the centre of mass, against hand
// calculation.
#include "../test.h"

#include <scree/materials/laws/linear_elastic.h>
#include <scree/advice/advise.h>

namespace test_advice_survey
{
template <int dim>
void make_block(Parameters &parameters)
{
  parameters.dimension        = dim;
  parameters.output_directory = "results";
  parameters.output.graphics  = "none";
  parameters.output.screen    = "nothing";
  parameters.gravity.assign(dim, 0.);
  parameters.gravity.back() = -10;
  parameters.grid.lower_corner.assign(dim, 0.);
  parameters.grid.upper_corner.assign(dim, 2.);

  auto &body                                                = parameters.bodies[0];
  body.material.law                                         = "linear elastic";
  body.material.of<LinearElasticParameters>().young_modulus = 1e6;
  body.material.of<LinearElasticParameters>().poisson_ratio = 0.2;
  body.seeding.grain_density                                = 2500;
  body.seeding.initial_porosity                             = 0.4;
  body.seeding.points_per_cell                              = 2;
  body.seeding.region                                       = dim == 2 ? "x < 1 && y < 1" : "x < 1 && y < 1 && z < 1";
}

template <int dim>
void test(Parameters &parameters, const SceneNumbers &expected, const std::string &name)
{
  Simulation<dim> simulation(parameters, Start::fresh, MPI_COMM_WORLD);
  const SceneNumbers scene = survey(simulation, parameters, MPI_COMM_WORLD);
  const Observation seen   = measure_first_steps(simulation, 1e-3, MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return;
  const auto compare = [&](const double found, const double wanted, const std::string &what) {
    expect(found, wanted, 1e-9 * std::abs(wanted), std::to_string(dim) + "D, " + name + ": " + what);
  };
  compare(scene.height, 1, "height");
  compare(scene.fall, expected.fall, "fall");
  compare(scene.n_cells, dim == 2 ? 400 : 8000, "cells");
  compare(scene.n_occupied, expected.n_occupied, "occupied cells");
  compare(scene.n_soil_points, dim == 2 ? 400 : 8000, "soil points");
  compare(scene.n_water_points, expected.n_water_points, "water points");
  compare(seen.n_points, scene.n_soil_points + expected.n_water_points, "points of all sets");
  compare(scene.porosity, 0.4, "porosity");
  compare(scene.density(), expected.has_water ? 1900 : 1500, "density");
  compare(scene.is_elastic, expected.is_elastic, "elastic");
  // E (1 - nu)/((1 + nu)(1 - 2 nu)) of E = 1 MPa, nu = 0.2; K = P/kappa = 5 MPa and G = 4 MPa of Nor-Sand
  const double modulus = expected.is_elastic ? 1e6 / 0.9 : 5e6 + 4. / 3. * 4e6;
  compare(scene.constrained_modulus(), modulus, "M");
  compare(scene.largest_wave_speed, std::sqrt(modulus / 1500), "c");
  const double step = seconds_of(seen.first);
  require(seen.first.at(name_of(TimerSection::stress)) > 0 && seen.first.at(other_parts) < 0.95 * step,
          "A step's cost is not that of its parts.");
}

template <int dim>
void test()
{
  SceneNumbers expected;
  expected.fall       = dim == 2 ? 0.25 : 0.375;
  expected.n_occupied = dim == 2 ? 100 : 1000;
  expected.is_elastic = true;
  {
    Parameters parameters;
    make_block<dim>(parameters);
    parameters.bodies[0].seeding.initial_velocity = dim == 2 ? "0.03 * x; 0" : "0.03 * x; 0; 0";
    test<dim>(parameters, expected, "dry");
  }
  {
    Parameters parameters;
    make_block<dim>(parameters);
    parameters.bodies[0].material.law           = "Nor-Sand";
    parameters.bodies[0].initial_state.type     = "isotropic";
    parameters.bodies[0].initial_state.pressure = 1e4;
    expected.is_elastic                         = false;
    test<dim>(parameters, expected, "Nor-Sand");
  }
  expected.is_elastic = expected.has_water = true;
  for (const std::string sets : { "single", "double" })
    {
      Parameters parameters;
      make_block<dim>(parameters);
      parameters.has_water        = true;
      parameters.water.point_sets = sets;
      parameters.transfer.method  = "TPIC";
      if (sets == "double")
        {
          parameters.water.region          = dim == 2 ? "x < 1 && y < 1.5" : "x < 1 && y < 1 && z < 1.5";
          parameters.water.points_per_cell = 2;
          expected.fall                    = dim == 2 ? 0.28125 : 0.46875;
          expected.n_occupied *= 1.5;
          expected.n_water_points = dim == 2 ? 600 : 12000;
        }
      test<dim>(parameters, expected, sets);
    }
}

const UnitTest registered("advice_survey", [] {
  test<2>();
  test<3>();
});
} // namespace test_advice_survey

// Runs with mpirun=1,2.
