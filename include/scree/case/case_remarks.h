// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_case_remarks_h
#define scree_case_case_remarks_h

#include <scree/case/parameters.h>

#include <string>
#include <vector>

namespace scree
{
  /// Lines for the log on entries that are possible, but without the effect that they suggest: bases stronger than the
  /// soil, shear bands that the cells do not resolve, laws that no body has.
  std::vector<std::string> remarks_on(const Parameters &parameters);
} // namespace scree

#endif
