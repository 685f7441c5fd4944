// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_removed_entries_h
#define scree_case_removed_entries_h

#include <string>

namespace scree
{
  /// What to write instead of an entry or subsection, or of a value, that earlier versions had; empty if there was
  /// none.
  std::string removed_entry_remedy(const std::string &subsection, const std::string &entry, const std::string &value);
} // namespace scree

#endif
