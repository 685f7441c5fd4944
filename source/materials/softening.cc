// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/materials/softening.h>

namespace scree
{
  using namespace dealii;

  void SofteningParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Softening strain",
                      strain,
                      "Plastic shear strain kappa of the plane of shear (engineering strain: gamma in simple shear) at "
                      "which the fall from peak to residual strength has reached 63 %: strength = residual + (peak - "
                      "residual) exp(-kappa/this). 0: strength does not depend on strain.",
                      Patterns::Double(0));
    prm.add_parameter(
        "Residual cohesion", cohesion, "Pa; cohesion after much shear. -1: as \"Cohesion\".", Patterns::Double(-1));
    prm.add_parameter("Residual friction angle",
                      friction_angle,
                      "degrees; friction angle after much shear, of the kind of \"Friction angle\". -1: as \"Friction "
                      "angle\".",
                      Patterns::Double(-1, 89));
    prm.add_parameter("Residual dilation angle",
                      dilation_angle,
                      "degrees; dilation angle after much shear. -1: as \"Dilation angle\".",
                      Patterns::Double(-1, 89));
    prm.add_parameter(
        "Nonlocal length",
        nonlocal_length,
        "m; length l over which the strain that softens the soil is averaged. Shear bands are then about two l "
        "wide; cells must not be wider than l/2. 0: shear bands are one to two cells wide.",
        Patterns::Double(0));
  }


  void SofteningParameters::check(const std::string &subsection) const
  {
    const std::pair<const char *, double> residuals[] = { { "Residual cohesion", cohesion },
                                                          { "Residual friction angle", friction_angle },
                                                          { "Residual dilation angle", dilation_angle } };
    bool falls                                        = false;
    for (const auto &[entry, value] : residuals)
      {
        falls = falls || value != as_peak;
        require_entry(
            value >= 0 || value == as_peak, subsection, entry, value, "write 0 or more, or -1 for the peak value.");
        require_entry(is_active() || value == as_peak,
                      subsection,
                      entry,
                      value,
                      "this entry has no effect without \"Softening strain\". Add one, or remove the entry.");
      }
    require_entry(!is_active() || falls,
                  subsection,
                  "Softening strain",
                  strain,
                  "no strength falls. Add \"Residual cohesion\" or \"Residual friction angle\".");
    require_entry(is_active() || nonlocal_length == 0,
                  subsection,
                  "Nonlocal length",
                  nonlocal_length,
                  "this entry has no effect without \"Softening strain\". Add one, or remove the entry.");
  }
} // namespace scree
