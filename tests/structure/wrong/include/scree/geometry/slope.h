// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_slope_h
#define scree_geometry_slope_h

namespace scree
{
  /// A slope, whose source is not in doc/references.bib (@source{nobody2000}).
  struct Slope
  {
    double angle;
  };
} // namespace scree

#endif
