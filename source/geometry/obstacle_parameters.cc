// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/obstacle_parameters.h>
#include <scree/input/expression.h>
#include <scree/input/input_error.h>

#include <deal.II/base/utilities.h>

namespace scree
{
  using namespace dealii;

  const std::string ObstacleParameters::prefix = "Obstacle ";


  ObstacleParameters::ObstacleParameters(const std::string &subsection)
  {
    surface.subsection = subsection;
  }


  std::string ObstacleParameters::name() const
  {
    return surface.subsection.substr(prefix.size());
  }


  void ObstacleParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection(surface.subsection);
    surface.add_entries(prm);
    prm.add_parameter("Velocity",
                      velocity,
                      "m/s; velocity from t = 0 on: one expression of t per axis, separated by semicolons, such as 0; "
                      "if(t < 1, 0.5, 0). The obstacle translates without rotation. Empty: at rest.",
                      Patterns::Anything());
    prm.add_parameter("Moment about",
                      pivot,
                      "m; place about which the moment on the obstacle is computed, one coordinate per axis. Empty: "
                      "the middle of the floor of the box.",
                      Patterns::List(Patterns::Double(), 0, 3));
    prm.leave_subsection();
  }


  void ObstacleParameters::check(const unsigned int dim) const
  {
    surface.check(dim);
    if (!velocity.empty())
      parse_expression<1>(entry_name(surface.subsection, "Velocity"), velocity, dim);
    require_entry(pivot.empty() || Utilities::split_string_list(pivot).size() == dim,
                  surface.subsection,
                  "Moment about",
                  pivot,
                  "write " + std::to_string(dim) + " numbers in m, separated by commas.");
  }
} // namespace scree
