// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_case_entries_h
#define scree_input_case_entries_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace scree
{
  /// An entry of a case with its value, set or default.
  struct CaseEntry
  {
    std::string subsection, name, value;
  };

  /// All entries of a case, those of a subsection before those of the subsections in it.
  class CaseEntries
  {
  public:
    CaseEntries() = default;

    /// The entries that `prm` declares.
    explicit CaseEntries(const dealii::ParameterHandler &prm);

    /// From what text() gave.
    explicit CaseEntries(const std::string &text);

    /// A line an entry.
    std::string text() const;

    /// The entry, or nullptr if there is none.
    const CaseEntry *find(const std::string &subsection, const std::string &name) const;

    /// Whether there are entries of that subsection.
    bool has_subsection(const std::string &path) const;

    const std::vector<CaseEntry> &all() const
    {
      return entries;
    }

  private:
    std::vector<CaseEntry> entries;
  };

  /// Whether two values of an entry mean the same: 0.1 and 1e-1 do.
  bool same_value(const std::string &first, const std::string &second);
} // namespace scree

#endif
