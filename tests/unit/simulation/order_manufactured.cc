// SPDX-License-Identifier: LGPL-2.1-or-later
// A manufactured solution at large strain whose points cross cells: a closed box in which, along each axis,
//   X = x - A sin(pi x) sin(omega t)          (where a point at x came from)
//   g = dX/dx = 1/F,   v = -X_t/g,   sigma_xx = E ln(F_x)/(F_x F_y)      (Hencky, Poisson's ratio 0)
// solves the equation of motion with the acceleration b = Dv/Dt + E/(rho_0 g) g' (1 + ln g). Displacements reach 0.1,
// that is 0.8 to 3.2 cells. With a fixed number of points in a cell the sum over points stops to resolve the integrals
// (as it is known of material point methods: Steffen, Kirby & Berzins 2008): the error levels out. With points that
// grow denser than the cells it falls on.
#include "../order.h"

#include "../unit_test.h"

namespace test_order_manufactured
{
namespace
{
  const double A = 0.1, omega = dealii::numbers::PI, E = 1e4, pi = dealii::numbers::PI;

  /// The acceleration along axis `x` ("x" or "y") as text.
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

  double stretch(const double x, const double t)
  {
    return 1. / (1. - A * pi * std::cos(pi * x) * std::sin(omega * t));
  }

  double velocity(const double x, const double t)
  {
    return A * omega * std::sin(pi * x) * std::cos(omega * t) * stretch(x, t);
  }
} // namespace


void run()
{
  const double time = 0.6;
  double orders[2]  = { 0, 0 };
  for (const bool more_points : { false, true })
    for (const std::string method : { "FLIP", "TPIC" })
      {
        std::vector<double> velocity_errors, stress_errors;
        for (const unsigned int n : { 8, 16, 32 })
          {
            const auto number = [](const double x) { return dealii::Utilities::to_string(x, 12); };
            RelativeError velocities, stresses;
            run_case<2>(
                "set Gravity = 0, 0\nset End time = " + number(time) + "\nset Body force = " + body_force("x") + ";" +
                    body_force("y") + "\nsubsection Mesh\n set Cell size = " + number(1. / n) +
                    "\nend\nsubsection Time step\n set Courant number = " + number(6.4 / n) +
                    "\nend\nsubsection Transfer\n set Method = " + method +
                    "\n set PIC rate = " + (method == "FLIP" ? "0" : "auto") +
                    "\nend\nsubsection Stabilisation\n set F-bar = none\nend\n"
                    "subsection Boundaries\n set Bottom = free slip\n set Top = free slip\nend\n"
                    "subsection Soil\n set Region = 1\n set Points per cell = " +
                    std::to_string(more_points ? n / 2 : 4) +
                    "\n set Material = linear elastic\n set Grain density = 1e3\n"
                    " set Initial velocity = 0.1*pi*sin(pi*x); 0.1*pi*sin(pi*y)\n"
                    " subsection Linear elastic\n  set Young's modulus = 1e4\n  set Poisson's ratio = 0\n end\nend\n",
                [&](const auto &body, const auto &x, const double *properties) {
                  const double F_x = stretch(x[0], time), F_y = stretch(x[1], time);
                  velocities.add(properties[body.layout.velocity], velocity(x[0], time));
                  stresses.add(properties[body.layout.stress], E * std::log(F_x) / (F_x * F_y));
                });
            velocity_errors.push_back(velocities.norm());
            stress_errors.push_back(stresses.norm());
          }
        const std::string name = method + (more_points ? ", 4, 8, 16 points" : ", 4 points");
        orders[more_points] += print_orders(name + ", velocity", velocity_errors) / 4;
        orders[more_points] += print_orders(name + ", stress", stress_errors) / 4;
      }
  AssertThrow(orders[1] > 1.5, dealii::ExcMessage("The error must fall with the cell if the points grow denser, too."));
}

const UnitTest registered("order_manufactured", run);
} // namespace test_order_manufactured


// Output:
// FLIP, 4 points, velocity: errors 1.049e-01 1.192e-01 1.069e-01, orders -0.18 0.16
// FLIP, 4 points, stress: errors 4.955e-02 1.494e-02 1.334e-02, orders 1.73 0.16
// TPIC, 4 points, velocity: errors 6.186e-02 3.689e-02 2.975e-02, orders 0.75 0.31
// TPIC, 4 points, stress: errors 3.752e-02 1.205e-02 6.937e-03, orders 1.64 0.80
// FLIP, 4, 8, 16 points, velocity: errors 1.049e-01 5.613e-02 2.344e-02, orders 0.90 1.26
// FLIP, 4, 8, 16 points, stress: errors 4.955e-02 1.202e-02 3.120e-03, orders 2.04 1.95
// TPIC, 4, 8, 16 points, velocity: errors 6.186e-02 1.692e-02 4.057e-03, orders 1.87 2.06
// TPIC, 4, 8, 16 points, stress: errors 3.752e-02 1.012e-02 2.531e-03, orders 1.89 2.00
