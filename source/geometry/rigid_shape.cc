// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/rigid_shape.h>
#include <scree/input/input_error.h>

#include <algorithm>

namespace scree
{
  namespace
  {
    /// Made at the first call, whichever source file registers first.
    auto &shapes()
    {
      static std::vector<std::pair<std::string, RigidShape>> all;
      return all;
    }


    /// 0: all, 1: plane ones, 2: those in space.
    int scenes_of(const RigidShape &shape)
    {
      return !shape.make_3d ? 1 : !shape.make_2d ? 2 : 0;
    }
  } // namespace


  std::string ShapeRequest::where() const
  {
    return entry_name(subsection, entry);
  }


  void ShapeRequest::require(const bool possible, const std::string &remedy) const
  {
    require_entry(possible, subsection, entry, value, remedy);
  }


  void ShapeRequest::require_cover(const unsigned int axis,
                                   const double first,
                                   const double last,
                                   const double rounding) const
  {
    require(first <= lower[axis] + rounding && last >= upper[axis] - rounding,
            std::string("the ground reaches from ") + "xyz"[axis] + " = " + number_text(first) + " to " +
                number_text(last) +
                " m only and does not cover the box of subsection Mesh. Write a longer ground or a smaller box.");
  }


  const std::vector<std::pair<std::string, RigidShape>> &rigid_shapes()
  {
    return shapes();
  }


  std::string names_of_shapes()
  {
    const std::string scenes[] = { "", " (2D)", " (3D)" };
    std::string names;
    for (const auto &one : shapes())
      names += (&one == &shapes().front()  ? ""
                : &one == &shapes().back() ? " and "
                                           : ", ") +
               quoted(one.first) + scenes[scenes_of(one.second)];
    return names;
  }


  RegisterShape::RegisterShape(const std::string &entry, RigidShape shape)
  {
    shapes().emplace_back(entry, std::move(shape));
    std::sort(shapes().begin(), shapes().end(), [](const auto &a, const auto &b) {
      return std::make_pair(scenes_of(a.second), a.first) < std::make_pair(scenes_of(b.second), b.first);
    });
  }
} // namespace scree
