// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_stl_file_h
#define scree_geometry_stl_file_h

#include <scree/geometry/triangle.h>

#include <string>
#include <vector>

namespace scree
{
  /// Reads the triangles of an STL file, as text or binary; the normals that stand there are not used. Throws
  /// EntryError if it is none or ends too soon.
  /// @param name of entry and file, for messages
  std::vector<Triangle> read_stl(const std::string &file, const std::string &name);
} // namespace scree

#endif
