// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/schemes/time_step.h>

namespace scree
{
  using namespace dealii;

  void TimeStepParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Time step");
    prm.add_parameter("Courant number",
                      courant,
                      "Time step times (wave speed + velocity), over the cell size; from 1e-6 to 2. Above auto the "
                      "stress may oscillate or the run diverge. auto: 0.8 in dry cases with AFLIP, else 0.6.");
    prm.add_parameter("Advection number",
                      advection_number,
                      "Largest distance that a point moves in a time step, over the cell size.",
                      Patterns::Double(1e-6, 1));
    prm.add_parameter("Maximum time step",
                      maximum,
                      "s; upper bound of the time step. auto: with water sqrt(0.0005 h/g), but at least 0.01 s; "
                      "in dry cases sqrt(0.2 h/g) with gravity, none without.");
    prm.add_parameter(
        "Mass scaling",
        mass_scaling,
        "Inertia of soil and water over the true one, for consolidation and other slow motion; weight and "
        "all other forces are true. Time steps are longer by its square root, also the maximum of auto; a PIC rate of "
        "auto is smaller by it. Keep 4 H/c times this root below 0.05 H^2/c_v, with layer height H, wave speed c and "
        "coefficient "
        "of consolidation c_v.",
        Patterns::Double(1));
    prm.leave_subsection();
  }


  void TimeStepParameters::check() const
  {
    if (courant != "auto")
      {
        const double number = number_of(courant);
        require_entry(number >= 1e-6 && number <= 2.,
                      { "Time step", "Courant number", courant },
                      "write auto, or a number from 1e-6 to 2.");
      }
    if (maximum == "auto")
      return;
    const double number = number_of(maximum);
    require_entry(number >= 1e-12 && std::isfinite(number),
                  { "Time step", "Maximum time step", maximum },
                  "write auto, or a number from 1e-12 on, in s.");
  }


} // namespace scree
