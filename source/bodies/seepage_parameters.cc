// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/bodies/seepage_parameters.h>

namespace scree
{
  using namespace dealii;

  void SeepageParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Hydraulic conductivity",
                      conductivity,
                      "m/s; conductivity (Darcy) of this body at its initial porosity; 0: as in subsection Water.",
                      Patterns::Double(0));
  }


  void SeepageParameters::check(const std::string &body, const WaterParameters *water) const
  {
    const std::string dry =
        "this entry has no effect, as the file has no subsection Water. Add one, or remove the entry.";
    require_entry(water != nullptr || conductivity == 0, body, "Hydraulic conductivity", conductivity, dry);
  }


  WaterParameters SeepageParameters::in_place_of(const WaterParameters &water) const
  {
    WaterParameters result = water;
    if (conductivity > 0)
      {
        result.conductivity   = conductivity;
        result.grain_diameter = 0;
      }
    return result;
  }
} // namespace scree
