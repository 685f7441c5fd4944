// SPDX-License-Identifier: LGPL-2.1-or-later
// A bar between two fixed walls swings in its first mode; small strain, so that
//   v = V sin(pi x) cos(pi c t),  sigma = E V/c cos(pi x) sin(pi c t),  c = sqrt(E/rho).
// At an eighth of the second period velocity and stress are both far from 0. The step shrinks with the square of the
// cell, because symplectic Euler holds velocities half a step late: the order seen is that of space.
#include "../order.h"

#include "../unit_test.h"

namespace test_order_vibrating_bar
{
void run()
{
  const double V = 1e-3, E = 1e4, rho = 1e3, c = std::sqrt(E / rho), time = 2.25 / c, pi = dealii::numbers::PI;
  for (const std::string method : { "FLIP", "TPIC", "AFLIP" })
    {
      std::vector<double> velocity_errors, stress_errors;
      for (const unsigned int n : { 8, 16, 32, 64 })
        {
          const auto number = [](const double x) { return dealii::Utilities::to_string(x, 12); };
          RelativeError velocity, stress;
          run_case<2>(
              "set Gravity = 0, 0\nset End time = " + number(time) + "\nsubsection Mesh\n set Upper corner = 1, " +
                  number(1. / n) + "\n set Cell size = " + number(1. / n) +
                  "\nend\nsubsection Time step\n set Courant number = " + number(2. / n) +
                  "\nend\nsubsection Transfer\n set Method = " + method +
                  "\n set PIC rate = " + (method == "FLIP" ? "0" : "auto") +
                  "\nend\nsubsection Stabilisation\n set F-bar = none\nend\n"
                  "subsection Boundaries\n set Left = fixed\n set Right = fixed\n set Bottom = free slip\n"
                  " set Top = free slip\nend\n"
                  "subsection Soil\n set Region = 1\n set Points per cell = 4\n set Material = linear elastic\n set "
                  "Grain density = 1e3\n"
                  " set Initial velocity = 1e-3*sin(pi*x); 0\n"
                  " subsection Linear elastic\n  set Young's modulus = 1e4\n  set Poisson's ratio = 0\n end\nend\n",
              [&](const auto &body, const auto &x, const double *properties) {
                velocity.add(properties[body.layout.velocity], V * std::sin(pi * x[0]) * std::cos(pi * c * time));
                stress.add(properties[body.layout.stress], E * V / c * std::cos(pi * x[0]) * std::sin(pi * c * time));
              });
          velocity_errors.push_back(velocity.norm());
          stress_errors.push_back(stress.norm());
        }
      for (const double order :
           { print_orders(method + " velocity", velocity_errors), print_orders(method + " stress", stress_errors) })
        AssertThrow(order >= 1.7, dealii::ExcMessage(method + " must converge at an order of 1.7 at least."));
    }
}

const UnitTest registered("order_vibrating_bar", run);
} // namespace test_order_vibrating_bar


// Output:
// FLIP velocity: errors 2.503e-01 8.519e-02 2.329e-02 6.654e-03, orders 1.55 1.87 1.81
// FLIP stress: errors 3.034e-01 7.164e-02 1.754e-02 4.533e-03, orders 2.08 2.03 1.95
// TPIC velocity: errors 8.186e-02 2.643e-02 7.186e-03 1.846e-03, orders 1.63 1.88 1.96
// TPIC stress: errors 1.505e-01 4.211e-02 1.110e-02 3.102e-03, orders 1.84 1.92 1.84
// AFLIP velocity: errors 1.411e-01 4.212e-02 1.122e-02 2.877e-03, orders 1.74 1.91 1.96
// AFLIP stress: errors 1.141e-01 2.905e-02 7.463e-03 2.264e-03, orders 1.97 1.96 1.72
