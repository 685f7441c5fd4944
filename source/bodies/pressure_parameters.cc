// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/bodies/pressure_parameters.h>

namespace scree
{
  using namespace dealii;

  void PressureParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Pressure");
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Residual at which a solve ends, over the larger of the right-hand side and the product of the "
                      "matrix with the whole pressure.",
                      Patterns::Double(1e-14, 0.1));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "Number of iterations after which a solve that has not converged stops the run.",
                      Patterns::Integer(1, 100000));
    prm.add_parameter(
        "Cavitation pressure",
        cavitation_pressure,
        "Pa; pressure at which water cavitates: p does not fall below it. p = 0 is the atmospheric pressure.",
        Patterns::Double(-1e15, 0));
    prm.leave_subsection();
  }
} // namespace scree
