// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/safety_parameters.h>
#include <scree/input/input_error.h>

namespace scree
{
  using namespace dealii;

  void SafetyParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Safety");
    prm.add_parameter("Strength factor",
                      strength_factor,
                      "Factor by which a run divides the strength of the soil, and the friction of bases, contacts and "
                      "walls, from the release on. --safety searches it; there it must be 1.",
                      Patterns::Double(1e-3, 1e3));
    prm.add_parameter("Lower factor",
                      lower,
                      "--safety: lower end of the range of the factor. Before the search the slope settles with the "
                      "strength divided by half of it.",
                      Patterns::Double(1e-3, 1e3));
    prm.add_parameter(
        "Upper factor", upper, "--safety: upper end of the range of the factor.", Patterns::Double(1e-3, 1e3));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "--safety: largest difference between the smallest factor that fails and the largest one that "
                      "rests.",
                      Patterns::Double(1e-4, 1));
    prm.add_parameter("Displacement",
                      displacement,
                      "--safety: the slope fails where 1 % of the soil has moved by more than this, over the height of "
                      "the slope. Write more for soil so soft that it deforms as much without failure. It also bounds "
                      "the displacement while the soil settles.",
                      Patterns::Double(1e-6, 10));
    prm.leave_subsection();
  }


  void SafetyParameters::check() const
  {
    require_entry(lower + tolerance < upper,
                  "Safety",
                  "Upper factor",
                  upper,
                  "it must exceed \"Lower factor\" = " + number_text(lower) + " by more than the tolerance.");
  }
} // namespace scree
