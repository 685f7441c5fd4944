// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/pressure/pressure_parameters.h>

namespace scree
{
  using namespace dealii;

  void PressureParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Pressure");
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "The solve ends when the residual is below this part of the right-hand side.",
                      Patterns::Double(1e-14, 0.1));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "A solve that has not converged by then ends the run.",
                      Patterns::Integer(1, 100000));
    prm.add_parameter(
        "Previous pressure",
        previous_pressure,
        "Pressure at the start of a step, from the points: affine (with their pressure gradient); average (without).",
        Patterns::Selection("affine|average"));
    prm.add_parameter(
        "Fading",
        fading,
        "Where the pressure changes by a part r of itself in a step as matter comes together, as where a gap "
        "closes, the next step starts from 1 - (Fading r)^2 of it, at least from .2; 0: from all of it. Incompressible "
        "water only.",
        Patterns::Double(0, 1000));
    prm.add_parameter("Projection",
                      projection,
                      "Pressure projection tau, in units of 1/(2 G) of the soil's shear modulus G; 0: none.",
                      Patterns::Double(0));
    prm.add_parameter("Cavitation pressure",
                      cavitation_pressure,
                      "Water tears at this pressure, Pa: p does not fall below it. p = 0 is the atmosphere's.",
                      Patterns::Double(-1e15, 0));
    prm.leave_subsection();
  }


  void PressureParameters::check(const unsigned int n_bodies, const double bulk_modulus) const
  {
    const PressureParameters defaults;
    const std::string remedy = "nothing reads it, as there is no soil: entry \"Bodies\" is none. Remove it.";
    require_entry(bulk_modulus == 0. || fading == defaults.fading,
                  "Water/Pressure",
                  "Fading",
                  fading,
                  "the water is compressible (entry \"Bulk modulus\" of subsection Water), and its pressure a spring "
                  "indeed. Remove one of them.");
    require_entry(
        n_bodies > 0 || projection == defaults.projection, "Water/Pressure", "Projection", projection, remedy);
  }

} // namespace scree
