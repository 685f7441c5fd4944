// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/bodies/pressure_parameters.h>

#include <utility>

namespace scree
{
  using namespace dealii;

  void PressureParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Pressure");
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Ratio of the residual to the right-hand side at which a solve ends.",
                      Patterns::Double(1e-14, 0.1));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "Number of iterations after which a solve that has not converged stops the run.",
                      Patterns::Integer(1, 100000));
    prm.add_parameter("Step",
                      step,
                      "fractional: approximate projection. variational: the force of the pressure is the transpose of "
                      "the divergence, so that pressure makes no energy.",
                      Patterns::Selection("fractional|variational"));
    prm.add_parameter("Previous pressure",
                      previous_pressure,
                      "Pressure at the start of a time step, from the points. affine: with their pressure gradient. "
                      "average: without it.",
                      Patterns::Selection("affine|average"));
    prm.add_parameter("Fading",
                      fading,
                      "Coefficient that reduces the previous pressure where material converges, as in a closing "
                      "gap. After a relative change r, the next time step starts from the part 1 - (Fading r)^2, at "
                      "least 0.2. 0: no reduction. Incompressible water only.",
                      Patterns::Double(0, 1000));
    prm.add_parameter("Projection",
                      projection,
                      "Pressure projection tau in units of 1/(2 G), with the shear modulus G of the soil; 0: none.",
                      Patterns::Double(0));
    prm.add_parameter(
        "Cavitation pressure",
        cavitation_pressure,
        "Pa; pressure at which water cavitates: p does not fall below it. p = 0 is the atmospheric pressure.",
        Patterns::Double(-1e15, 0));
    prm.leave_subsection();
  }


  void PressureParameters::check(const unsigned int n_bodies, const double bulk_modulus) const
  {
    const PressureParameters defaults;
    const std::string remedy = "this entry has no effect, as there is no soil: entry \"Bodies\" is none. Remove it.";
    require_entry(
        bulk_modulus == 0. || fading == defaults.fading,
        "Water/Pressure",
        "Fading",
        fading,
        "the water is compressible (entry \"Bulk modulus\" of subsection Water), and its pressure stores energy. "
        "Remove one of them.");
    for (const auto &[name, value] : { std::make_pair("Fading", fading), std::make_pair("Projection", projection) })
      require_entry(!is_variational() || value == 0.,
                    "Water/Pressure",
                    name,
                    value,
                    "with \"Step = variational\" it has no effect. Remove it.");
    require_entry(
        n_bodies > 0 || projection == defaults.projection, "Water/Pressure", "Projection", projection, remedy);
  }

} // namespace scree
