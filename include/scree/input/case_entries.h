// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_input_case_entries_h
#define scree_input_case_entries_h

#include <scree/input/input_error.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <cstdint>

namespace scree
{
  /// CRC-64 as of ECMA-182, reflected: that of xz.
  using Checksum = boost::crc_optimal<64, 0x42F0E1EBA9EA3693, 0xFFFFFFFFFFFFFFFF, 0xFFFFFFFFFFFFFFFF, true, true>;

  /// A file that an entry of a case names.
  struct NamedFile
  {
    std::string subsection, ///< path of the entry's subsection
        entry;              ///< its name
    std::string path;       ///< from the working folder
    std::string written;    ///< as the entry has it: from the folder of the file in which it stands
    std::string checksum;   ///< of the contents; empty if it is no regular file
  };

  /// Declares an entry that names a file to be read; `path` gets its path from the working folder. All such entries are
  /// declared so: their paths count from the case, and a checkpoint holds a checksum.
  void add_file_entry(dealii::ParameterHandler &prm,
                      const std::string &entry,
                      std::string &path,
                      const std::string &documentation);

  /// Declares an entry that may differ from place to place: a number, an expression of x, y (z) of the place at the
  /// start and of `depth`, or a file of values, see PlaceField. Where it is a number, `number` is set and `of_place` is
  /// empty; else `of_place` is the text, with the path of a file from the working folder, and `number` is left as it
  /// is.
  void add_place_entry(dealii::ParameterHandler &prm,
                       const std::string &entry,
                       double &number,
                       std::string &of_place,
                       const std::string &documentation);

  /// Whether the value of such an entry names a file, by the end of its name.
  bool names_place_file(const std::string &value);

  /// Whether this file is a raster, by the end of its name; else it is a table.
  bool is_raster(const std::string &file);

  /// Whether the text of such an entry has the variable `depth`.
  bool uses_depth(const std::string &text);

  /// An entry of a case with its value, set or default.
  struct CaseEntry
  {
    std::string subsection,   ///< path; empty at the top of the file
        name,                 ///< of the entry
        value           = "", ///< as text
        checksum        = ""; ///< of the contents of the file it names; empty if it names none
    std::string pattern = "", ///< deal.II's description of allowed values, if `prm` has declared the entry
        documentation   = ""; ///< text of the manual, if `prm` has declared the entry

    /// Whether this value of the entry names a file to be read, see add_file_entry() and add_place_entry().
    bool names_file(const std::string &value) const;
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
    void set_file(const NamedFile &file)
    {
      for (CaseEntry &entry : entries)
        if (entry.subsection == file.subsection && entry.name == file.entry)
          {
            entry.value    = file.written;
            entry.checksum = file.checksum;
          }
    }

    /// Appends an entry that no file sets.
    void add(const CaseEntry &entry)
    {
      entries.push_back(entry);
    }

    /// The entry, or nullptr if there is none.
    const CaseEntry *find(const std::string &subsection, const std::string &name) const
    {
      const auto found = std::find_if(entries.begin(), entries.end(), [&](const CaseEntry &entry) {
        return entry.subsection == subsection && entry.name == name;
      });
      return found == entries.end() ? nullptr : &*found;
    }

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
