// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_unusual_units_h
#define scree_case_unusual_units_h

#include <scree/case/parameters.h>

#include <string>
#include <vector>

namespace scree
{
  /// A question about each value that is possible, but usual in another unit only (angles in radians, moduli in MPa),
  /// and about each base that is stronger than the soil on it.
  std::vector<std::string> unusual_units(const Parameters &parameters);
} // namespace scree

#endif
