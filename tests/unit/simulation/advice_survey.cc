// SPDX-License-Identifier: LGPL-2.1-or-later

// What an advice finds in the points of a case: sizes, counts, stiffness and fall of the centre of mass, against hand
// calculation; the same on 1 and 2 ranks.
#include "../test.h"

#include <scree/materials/laws/linear_elastic.h>
#include <scree/advice/advise.h>
#include <scree/advice/scene_numbers.h>

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
void tell(Parameters &parameters, const std::string &name)
{
  Simulation<dim> simulation(parameters, Start::fresh, MPI_COMM_WORLD);
  const SceneNumbers scene = survey(simulation, parameters, MPI_COMM_WORLD);
  const Observation seen   = measure_first_steps(simulation, 1e-3, MPI_COMM_WORLD);
  double parts             = 0;
  for (const auto &part : seen.first.parts)
    parts += part.second;
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return;
  std::cout << dim << "D " << name << ": height " << scene.height << ", fall " << scene.fall << ", cells "
            << scene.n_cells << ", occupied " << scene.n_occupied << ", soil points " << scene.n_soil_points
            << ", water points " << scene.n_water_points << ", porosity " << scene.porosity << ", density / 1000 "
            << scene.density() / 1000 << ", M / 1e6 " << scene.constrained_modulus() / 1e6 << ", c / 10 "
            << scene.fastest.speed() / 10 << ", elastic " << scene.is_elastic << ", points of all sets "
            << seen.n_points << '\n';
  require(seen.first.seconds > 0 && parts > 0 && parts < 1.05 * seen.first.seconds && seen.memory > 1e7,
          "A step's cost is not that of its parts.");
}

template <int dim>
void test()
{
  {
    Parameters parameters;
    make_block<dim>(parameters);
    parameters.bodies[0].seeding.initial_velocity = dim == 2 ? "0.03 * x; 0" : "0.03 * x; 0; 0";
    tell<dim>(parameters, "dry");
  }
  {
    Parameters parameters;
    make_block<dim>(parameters);
    parameters.has_water             = true;
    parameters.water.region          = dim == 2 ? "x < 1 && y < 1.5" : "x < 1 && y < 1 && z < 1.5";
    parameters.transfer.method       = "TPIC";
    parameters.water.points_per_cell = 2;
    tell<dim>(parameters, "submerged");
  }
  {
    Parameters parameters;
    make_block<dim>(parameters);
    parameters.has_water        = true;
    parameters.water.point_sets = "single";
    parameters.transfer.method  = "TPIC";
    tell<dim>(parameters, "single-point");
  }
  {
    Parameters parameters;
    make_block<dim>(parameters);
    parameters.bodies[0].material.law           = "Nor-Sand";
    parameters.bodies[0].initial_state.type     = "isotropic";
    parameters.bodies[0].initial_state.pressure = 1e4;
    tell<dim>(parameters, "Nor-Sand"); // K = P/kappa = 5 MPa, G = 4 MPa, rho = 1500 kg/m^3
  }
}

void run()
{
  test<2>();
  test<3>();
}

const UnitTest registered("advice_survey", run);
} // namespace test_advice_survey


// clang-format off
// Output of mpirun=1,2:
// 2D dry: height 1, fall 0.25, cells 400, occupied 100, soil points 400, water points 0, porosity 0.4, density / 1000 1.5, M / 1e6 1.11111, c / 10 2.72166, elastic 1, points of all sets 400
// 2D submerged: height 1, fall 0.28125, cells 400, occupied 150, soil points 400, water points 600, porosity 0.4, density / 1000 1.9, M / 1e6 1.11111, c / 10 2.72166, elastic 1, points of all sets 1000
// 2D single-point: height 1, fall 0.25, cells 400, occupied 100, soil points 400, water points 0, porosity 0.4, density / 1000 1.9, M / 1e6 1.11111, c / 10 2.72166, elastic 1, points of all sets 400
// 2D Nor-Sand: height 1, fall 0.25, cells 400, occupied 100, soil points 400, water points 0, porosity 0.4, density / 1000 1.5, M / 1e6 10.3333, c / 10 8.29993, elastic 0, points of all sets 400
// 3D dry: height 1, fall 0.375, cells 8000, occupied 1000, soil points 8000, water points 0, porosity 0.4, density / 1000 1.5, M / 1e6 1.11111, c / 10 2.72166, elastic 1, points of all sets 8000
// 3D submerged: height 1, fall 0.46875, cells 8000, occupied 1500, soil points 8000, water points 12000, porosity 0.4, density / 1000 1.9, M / 1e6 1.11111, c / 10 2.72166, elastic 1, points of all sets 20000
// 3D single-point: height 1, fall 0.375, cells 8000, occupied 1000, soil points 8000, water points 0, porosity 0.4, density / 1000 1.9, M / 1e6 1.11111, c / 10 2.72166, elastic 1, points of all sets 8000
// 3D Nor-Sand: height 1, fall 0.375, cells 8000, occupied 1000, soil points 8000, water points 0, porosity 0.4, density / 1000 1.5, M / 1e6 10.3333, c / 10 8.29993, elastic 0, points of all sets 8000
