// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_case_changes_h
#define scree_case_case_changes_h

#include <scree/io/checkpoint.h>

namespace scree
{
  /// Compares the entries of a case with those of the checkpoint it is to go on from. Returns a line for the log for
  /// each change that the results will show; throws EntryError at changes that the state in the checkpoint does not
  /// bear.
  std::vector<std::string> notes_on_changes(const Checkpoint &checkpoint, const CaseEntries &entries);
} // namespace scree

#endif
