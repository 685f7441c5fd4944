// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_case_entries_h
#define scree_input_case_entries_h

#include <scree/input/named_file.h>

#include <string>
#include <vector>

namespace scree
{
  /// An entry of a case with its value, set or default.
  struct CaseEntry
  {
    std::string subsection, ///< path; empty at the top of the file
        name,               ///< of the entry
        value;              ///< as text
    std::string checksum;   ///< of the contents of the file it names; empty if it names none
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

    /// Writes the file that an entry names as the case has it, and adds its checksum.
    void set_file(const NamedFile &file);

    /// The entry, or nullptr if there is none.
    const CaseEntry *find(const std::string &subsection, const std::string &name) const;

    /// Whether there are entries of that subsection.
    bool has_subsection(const std::string &path) const;

    /// All entries, those of a subsection before those of its subsections.
    const std::vector<CaseEntry> &all() const
    {
      return entries;
    }

  private:
    std::vector<CaseEntry> entries;
  };

  /// Whether two values of an entry mean the same: 0.1 and 1e-1 do, and files of the same contents.
  bool same_value(const CaseEntry &first, const CaseEntry &second);
} // namespace scree

#endif
