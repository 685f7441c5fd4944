// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs of a case text in unit tests, and orders of convergence from their errors.
#ifndef tests_order_h
#define tests_order_h

#include <scree/run/simulation.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>

/// Runs the case and hands each point's location and properties to `inspect`.
template <int dim>
void run_case(
    const std::string &text,
    const std::function<void(const scree::SoilBody<dim> &, const dealii::Point<dim> &, const double *)> &inspect)
{
  const std::string file = "case.prm";
  std::ofstream(file) << text << "\nset Output directory = results\n"
                      << "subsection Output\n set Interval = 1e6\n set Screen = nothing\n set Graphics = none\nend\n";
  scree::Parameters parameters(file);
  scree::Simulation<dim> simulation(parameters, scree::Start::fresh, MPI_COMM_WORLD);
  simulation.run();
  for (const auto &body : simulation.state_of_scene().bodies)
    for_each_point(body.points, [&](const auto &point) { inspect(body, point.location, point.properties); });
}

/// Root of mean squared errors over that of mean squared values.
struct RelativeError
{
  double error = 0, value = 0;

  void add(const double computed, const double exact)
  {
    error += (computed - exact) * (computed - exact);
    value += exact * exact;
  }
  double norm() const
  {
    return std::sqrt(error / value);
  }
};

/// Prints the errors of ever halved cells and the orders between them; returns the last order.
inline double print_orders(const std::string &name, const std::vector<double> &errors)
{
  std::printf("%s: errors", name.c_str());
  for (const double error : errors)
    std::printf(" %.3e", error);
  std::printf(", orders");
  double order = 0;
  for (unsigned int i = 1; i < errors.size(); ++i)
    std::printf(" %.2f", order = std::log2(errors[i - 1] / errors[i]));
  std::printf("\n");
  return order;
}

#endif
