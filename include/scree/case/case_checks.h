// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_case_checks_h
#define scree_case_case_checks_h

#include <scree/case/parameters.h>

namespace scree
{
  /// Throws EntryError at impossible entries of a case, and at entries that do not fit each other.
  void check_case(const Parameters &parameters);
} // namespace scree

#endif
