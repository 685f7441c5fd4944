// SPDX-License-Identifier: LGPL-2.1-or-later

// K0 start: the vertical stress of every point is the weight above it, below an inclined surface and through a second
// layer; horizontal stresses are K0 times that, shear is none. On one rank and on two.
#include "../test.h"

#include <scree/run/simulation.h>

namespace test_points_k0_start
{
constexpr double K0 = 0.683, gravity = 9.81;

/// Starts the bodies of Nor-Sand and compares with `weight_above(x)`.
template <int dim, typename Weight>
void test(const std::string &name,
          const std::vector<double> &upper_corner,
          const std::vector<std::pair<std::string, std::string>> &bodies,
          const Weight &weight_above)
{
  // Bodies beyond the first need names, which only a file gives.
  std::string names, sections;
  for (const auto &[body, entries] : bodies)
    {
      names += (names.empty() ? "" : ", ") + body;
      sections += "subsection " + body + "\n" + entries +
                  "\nsubsection Initial state\nset Type = K0\nset K0 = 0.683\nend\nend\n";
    }
  std::string corner;
  for (const double x : upper_corner)
    corner += (corner.empty() ? "" : ", ") + Utilities::to_string(x);
  const std::string zeros = dim == 3 ? "0, 0, " : "0, ";
  RunFolder("results", false, MPI_COMM_WORLD)
      .write("start.prm",
             "set Dimension = " + std::to_string(dim) + "\nset Output directory = results\nset Bodies = " + names +
                 "\nset Gravity = " + zeros + "-9.81\nsubsection Mesh\nset Lower corner = " + zeros +
                 "0\nset Upper corner = " + corner +
                 "\nend\nsubsection Output\nset Graphics = none\nset Screen = nothing\nend\n" + sections);
  MPI_Barrier(MPI_COMM_WORLD);
  Parameters parameters("results/start.prm");
  const Simulation<dim> simulation(parameters, Start::fresh, MPI_COMM_WORLD);

  double largest_weight = 0, error = 0;
  for (const auto &body : simulation.state_of_scene().bodies)
    for_each_point(body.points, [&](const auto &point) {
      const double *stress = point.properties + body.layout.stress;
      const double weight  = weight_above(point.location);
      largest_weight       = std::max(largest_weight, weight);
      for (unsigned int c = 0; c < n_symmetric_components<dim>; ++c)
        error = std::max(error, std::abs(stress[c] + (c == dim - 1 ? 1. : c < 3 ? K0 : 0.) * weight));
    });
  error = Utilities::MPI::max(error, MPI_COMM_WORLD) / Utilities::MPI::max(largest_weight, MPI_COMM_WORLD);

  // Columns are shared by points closer than a hundred thousandth of a cell; surfaces are found to 1e-9 of the height.
  require(error < 1e-5, name + ": the stress is wrong by " + Utilities::to_string(error));
  std::cout << dim << "D " << name << ": OK, " << Utilities::MPI::max(largest_weight, MPI_COMM_WORLD) << " Pa"
            << std::endl;
}


void run()
{
  const double dense           = gravity * 2500 / 1.629; // unit weight, N/m^3, at the default specific volume
  const double light           = gravity * 0.6 * 1500;
  const std::string light_soil = "\nset Grain density = 1500\nset Initial porosity = 0.4";

  test<2>("slope",
          { 5, 2.5 },
          { { "Soil", "set Region = if(x < 2, y < 2, y < 4 - x)\nset Points per cell = 4" } },
          [&](const Point<2> &x) { return dense * ((x[0] < 2 ? 2 : 4 - x[0]) - x[1]); });
  test<3>("slope",
          { 2, 0.2, 1 },
          { { "Soil", "set Region = z < 1 - 0.5 * x\nset Points per cell = 2" } },
          [&](const Point<3> &x) { return dense * (1 - 0.5 * x[0] - x[2]); });
  // The lower layer's surface rises by a fifth; the upper one's is level. A layer thinner than a quarter of a cell may
  // be overlooked, so this one does not run out.
  const auto interface = [](const Point<2> &x) { return 0.3 + 0.2 * x[0]; };
  test<2>("layers",
          { 2, 1.5 },
          { { "Lower", "set Region = y < 1 && y < 0.3 + 0.2 * x\nset Points per cell = 4" },
            { "Upper", "set Region = y < 1 && y >= 0.3 + 0.2 * x\nset Points per cell = 4" + light_soil } },
          [&](const Point<2> &x) {
            return dense * std::max(0., interface(x) - x[1]) + light * (1 - std::max(x[1], interface(x)));
          });
}

const UnitTest registered("points_k0_start", run);
} // namespace test_points_k0_start


// Output of mpirun=1,2:
// 2D slope: OK, 29922.3 Pa
// 3D slope: OK, 14490.7 Pa
// 2D layers: OK, 12983.6 Pa
