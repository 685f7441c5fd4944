// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/face_entries.h>
#include <scree/input/input_error.h>

#include <tuple>

namespace scree
{
  using namespace dealii;

  std::vector<std::string> FaceEntries::names(const unsigned int dim)
  {
    if (dim == 2)
      return { "Left", "Right", "Bottom", "Top" };
    return { "Left", "Right", "Front", "Back", "Bottom", "Top" };
  }


  std::vector<std::string> FaceEntries::texts(const unsigned int dim) const
  {
    if (dim == 2)
      return { left, right, bottom, top };
    return { left, right, front, back, bottom, top };
  }


  void FaceEntries::add_parameters(ParameterHandler &prm, const std::string &what)
  {
    prm.add_parameter("Left", left, "Lower x face" + what);
    prm.add_parameter("Right", right, "Upper x face" + what);
    prm.add_parameter("Front", front, "Lower y face (3D only)" + what);
    prm.add_parameter("Back", back, "Upper y face (3D only)" + what);
    prm.add_parameter("Bottom", bottom, "Lower face of the last axis" + what);
    prm.add_parameter("Top", top, "Upper face of the last axis" + what);
  }


  void FaceEntries::check(const std::string &subsection, const unsigned int dim, const FaceEntries &defaults) const
  {
    if (dim == 2)
      for (const auto &[name, wall, otherwise] :
           { std::make_tuple("Front", front, defaults.front), std::make_tuple("Back", back, defaults.back) })
        require_entry(wall == otherwise,
                      subsection,
                      name,
                      wall,
                      "a plane strain run has no such wall. Remove the entry, or write \"Dimension = 3\".");
  }
} // namespace scree
