// SPDX-License-Identifier: LGPL-2.1-or-later
// Orders of convergence and errors of velocity and stress.
//
// A bar between two fixed walls swings in its first mode; small strain, so that
//   v = V sin(pi x) cos(pi c t),  sigma = E V/c cos(pi x) sin(pi c t),  c = sqrt(E/rho).
// At an eighth of the second period velocity and stress are both far from 0. The step shrinks with the square of the
// cell, because symplectic Euler holds velocities half a step late: the order seen is that of space.
//
// A manufactured solution at large strain whose points cross cells: a closed box in which, along each axis,
//   X = x - A sin(pi x) sin(omega t)          (where a point at x came from)
//   g = dX/dx = 1/F,   v = -X_t/g,   sigma_xx = E ln(F_x)/(F_x F_y)      (Hencky, Poisson's ratio 0)
// solves the equation of motion with the acceleration b = Dv/Dt + E/(rho_0 g) g' (1 + ln g). Displacements reach 0.1,
// that is 0.8 to 3.2 cells. With a fixed number of points in a cell the sum over points stops to resolve the integrals
// (as it is known of material point methods: Steffen, Kirby & Berzins 2008): the error levels out. With points that
// grow denser than the cells it falls on.
#include "../test.h"

#include <scree/run/simulation.h>

#include <array>
#include <fstream>
#include <functional>

namespace test_order
{
constexpr double E = 1e4, pi = numbers::PI;

std::string text(const double x)
{
  return Utilities::to_string(x, 12);
}

/// Velocity and stress along x at a place.
using Exact = std::function<std::pair<double, double>(const Point<2> &)>;

/// Relative errors of velocity and stress of elastic soil of 1000 kg/m^3 that fills the box.
std::array<double, 2>
errors_of(const std::string &method, const std::string &entries, const std::string &of_soil, const Exact &exact)
{
  std::ofstream("case.prm")
      << entries
      << "\nset Gravity = 0, 0\nset Output directory = results\nsubsection Transfer\n set Method = " << method
      << "\n set PIC rate = " << (method == "FLIP" ? "0" : "auto")
      << "\nend\nsubsection Stabilisation\n set F-bar = none\nend\n"
         "subsection Boundaries\n set Bottom = free slip\n set Top = free slip\nend\n"
         "subsection Output\n set Interval = 1e6\n set Screen = nothing\n set Graphics = none\nend\n"
         "subsection Soil\n set Region = 1\n set Material = linear elastic\n set Grain density = 1e3\n"
      << of_soil << "\n subsection Linear elastic\n  set Young's modulus = 1e4\n  set Poisson's ratio = 0\n end\nend\n";
  Parameters parameters("case.prm");
  Simulation<2> simulation(parameters, Start::fresh, MPI_COMM_WORLD);
  simulation.run();
  std::array<double, 2> errors{}, values{};
  for (const auto &body : simulation.state_of_scene().bodies)
    for_each_point(body.points, [&](const auto &point) {
      const auto [velocity, stress] = exact(point.location);
      const double wanted[2]        = { velocity, stress };
      const double found[2]         = { point.properties[body.layout.velocity], point.properties[body.layout.stress] };
      for (unsigned int i = 0; i < 2; ++i)
        {
          errors[i] += std::pow(found[i] - wanted[i], 2);
          values[i] += std::pow(wanted[i], 2);
        }
    });
  return { { std::sqrt(errors[0] / values[0]), std::sqrt(errors[1] / values[1]) } };
}


std::array<double, 2> bar(const std::string &method, const unsigned int n)
{
  const double V = 1e-3, c = std::sqrt(E / 1e3), time = 2.25 / c;
  return errors_of(method,
                   "set End time = " + text(time) + "\nsubsection Mesh\n set Upper corner = 1, " + text(1. / n) +
                       "\n set Cell size = " + text(1. / n) + "\nend\nsubsection Time step\n set Courant number = " +
                       text(2. / n) + "\nend\nsubsection Boundaries\n set Left = fixed\n set Right = fixed\nend",
                   " set Points per cell = 4\n set Initial velocity = 1e-3*sin(pi*x); 0",
                   [&](const Point<2> &x) {
                     return std::make_pair(V * std::sin(pi * x[0]) * std::cos(pi * c * time),
                                           E * V / c * std::cos(pi * x[0]) * std::sin(pi * c * time));
                   });
}


/// The acceleration of the manufactured solution along axis `x` ("x" or "y").
std::string body_force(const std::string &x)
{
  const std::string s = "(0.1*sin(pi*" + x + "))", c = "(0.1*pi*cos(pi*" + x + "))"; // A sin, its derivative
  const std::string g = "(1-" + c + "*sin(pi*t))", g_x = "(pi*pi*" + s + "*sin(pi*t))",
                    g_t = "(-pi*" + c + "*cos(pi*t))";
  const std::string n = "(pi*" + s + "*cos(pi*t))", n_x = "(pi*" + c + "*cos(pi*t))",
                    n_t = "(-pi*pi*" + s + "*sin(pi*t))";
  return n_t + "/" + g + "-" + n + "*" + g_t + "/" + g + "^2+" + n + "/" + g + "*(" + n_x + "/" + g + "-" + n + "*" +
         g_x + "/" + g + "^2)+10/" + g + "*" + g_x + "*(1+ln(" + g + "))";
}

std::array<double, 2> manufactured(const std::string &method, const unsigned int n, const unsigned int points_per_cell)
{
  const double A = 0.1, omega = pi, time = 0.6;
  const auto stretch = [&](const double x) { return 1. / (1. - A * pi * std::cos(pi * x) * std::sin(omega * time)); };
  return errors_of(method,
                   "set End time = " + text(time) + "\nset Body force = " + body_force("x") + ";" + body_force("y") +
                       "\nsubsection Mesh\n set Cell size = " + text(1. / n) +
                       "\nend\nsubsection Time step\n set Courant number = " + text(6.4 / n) + "\nend",
                   " set Initial velocity = 0.1*pi*sin(pi*x); 0.1*pi*sin(pi*y)\n set Points per cell = " +
                       std::to_string(points_per_cell),
                   [&](const Point<2> &x) {
                     const double F_x = stretch(x[0]), F_y = stretch(x[1]);
                     return std::make_pair(A * omega * std::sin(pi * x[0]) * std::cos(omega * time) * F_x,
                                           E * std::log(F_x) / (F_x * F_y));
                   });
}


/// Errors of ever halved cells: the last ones, of velocity and stress, to 1e-3; returns the last orders.
std::array<double, 2> last_orders(const std::string &name,
                                  const std::vector<std::array<double, 2>> &errors,
                                  const std::array<double, 2> &last)
{
  std::array<double, 2> orders;
  for (unsigned int i = 0; i < 2; ++i)
    {
      const double error = errors.back()[i];
      orders[i]          = std::log2(errors[errors.size() - 2][i] / error);
      expect(error / last[i], 1., 1e-3, name + ": error of " + (i == 0 ? "velocity" : "stress") + " over that before");
    }
  return orders;
}


void run()
{
  const std::map<std::string, std::array<double, 2>> of_bar = { { "FLIP", { { 6.654e-3, 4.533e-3 } } },
                                                                { "TPIC", { { 1.846e-3, 3.102e-3 } } },
                                                                { "AFLIP", { { 2.877e-3, 2.264e-3 } } } };
  for (const auto &[method, last] : of_bar)
    {
      std::vector<std::array<double, 2>> errors;
      for (const unsigned int n : { 32, 64 })
        errors.push_back(bar(method, n));
      for (const double order : last_orders(method, errors, last))
        require(order >= 1.7,
                method + " converges at an order of " + std::to_string(order) + ", and 1.7 at least is due");
    }

  // With FLIP and TPIC; 4 points in each cell along an axis, and 4, 8, 16.
  const std::map<std::string, std::array<double, 4>> of_solution = {
    { "FLIP", { { 1.069e-1, 1.334e-2, 2.344e-2, 3.120e-3 } } },
    { "TPIC", { { 2.975e-2, 6.937e-3, 4.057e-3, 2.531e-3 } } }
  };
  double mean_order = 0;
  for (const auto &[method, last] : of_solution)
    {
      std::vector<std::array<double, 2>> same, denser;
      for (const unsigned int n : { 16, 32 })
        {
          same.push_back(manufactured(method, n, 4));
          denser.push_back(manufactured(method, n, n / 2));
        }
      last_orders(method + ", 4 points", same, { { last[0], last[1] } });
      for (const double order : last_orders(method + ", more points", denser, { { last[2], last[3] } }))
        mean_order += order / 4;
    }
  require(mean_order > 1.5, "The error must fall with the cell if the points grow denser, too.");
}

const UnitTest registered("order", run);
} // namespace test_order
