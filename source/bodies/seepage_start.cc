// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/bodies/seepage_start.h>
#include <scree/input/input_error.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  void SeepageStart::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Steady seepage",
                      is_steady,
                      "Whether the pore pressure at the start is that of steady flow through the soil, with a free "
                      "surface, between the heads of \"Reservoir level\" and \"Heads at walls\". Pores are full where "
                      "it is not negative. Water leaves through faces in air. Alternative to \"Phreatic surface\".");
    prm.add_parameter("Heads at walls",
                      wall_heads,
                      "m; elevations of the water table at walls of the box for \"Steady seepage\", such as Left: 12, "
                      "Right: 4. They hold at the start only; in the run the wall is as in subsection "
                      "Boundaries/Water. Empty: none.",
                      Patterns::Anything());
  }


  void SeepageStart::check(const unsigned int n_bodies,
                           const std::pair<std::string, std::string> &phreatic,
                           const std::string &reservoir_level,
                           const std::string &initial_pressure) const
  {
    require_entry(is_steady || wall_heads.empty(),
                  "Water",
                  "Heads at walls",
                  wall_heads,
                  "this entry has no effect. Remove it, or write \"Steady seepage = true\".");
    heads();
    if (!is_steady)
      return;
    require_entry(n_bodies > 0,
                  "Water",
                  "Steady seepage",
                  "true",
                  "there is no soil, as entry \"Bodies\" is none. Remove this entry.");
    require_entry(phreatic.second.empty(),
                  "Water",
                  phreatic.first,
                  phreatic.second,
                  "the water table follows from \"Steady seepage\". Keep one of the two.");
    require_entry(!reservoir_level.empty() || !wall_heads.empty(),
                  "Water",
                  "Steady seepage",
                  "true",
                  "no head is given. Write a \"Reservoir level\" or \"Heads at walls\".");
    require_entry(initial_pressure != "none",
                  "Water",
                  "Initial pressure",
                  initial_pressure,
                  "the pressure is that of \"Steady seepage\". Keep one of the two.");
  }


  void SeepageStart::check_heads(const std::vector<double> &lower, const std::vector<double> &upper) const
  {
    const double bottom = lower.back(), top = upper.back();
    for (const auto &[wall, head] : heads())
      {
        require_entry(wall != "Top",
                      "Water",
                      "Heads at walls",
                      wall_heads,
                      "no soil at the top wall is below a head in the box. Remove \"Top\".");
        require_entry(head > bottom && head <= top,
                      "Water",
                      "Heads at walls",
                      wall_heads,
                      "the head of " + number_text(head) + " m is not in the box of subsection Mesh. Write one above " +
                          number_text(bottom) + " and up to " + number_text(top) + " m, or a larger box.");
      }
  }


  std::vector<std::pair<std::string, double>> SeepageStart::heads() const
  {
    std::vector<std::pair<std::string, double>> heads;
    for (const std::string &part : Utilities::split_string_list(wall_heads, ','))
      {
        const std::vector<std::string> words = Utilities::split_string_list(part, ':');
        const double head                    = words.size() == 2 ? number_of(words[1]) : std::nan("");
        require_entry(std::isfinite(head),
                      "Water",
                      "Heads at walls",
                      wall_heads,
                      "write walls with their heads in m, such as Left: 12, Right: 4.");
        heads.emplace_back(words.front(), head);
      }
    return heads;
  }
} // namespace scree
