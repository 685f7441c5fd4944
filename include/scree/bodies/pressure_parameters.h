// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_pressure_parameters_h
#define scree_bodies_pressure_parameters_h

#include <deal.II/base/parameter_handler.h>

namespace scree
{
  /// Subsection Pressure of subsection Water.
  struct PressureParameters
  {
    double relative_tolerance       = 1e-4; ///< of the residual, over the larger of |b| and |S p|
    unsigned int maximum_iterations = 500;  ///< the run ends with an error beyond them
    double cavitation_pressure      = -1e5; ///< Pa

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);
  };
} // namespace scree

#endif
