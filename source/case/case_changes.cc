// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/case_changes.h>
#include <scree/input/input_error.h>
#include <scree/transfer/transfer_parameters.h>

#include <algorithm>
#include <map>

namespace scree
{
  namespace
  {
    /// What --resume does with an entry that has changed.
    enum class Change
    {
      free,   ///< goes on
      noted,  ///< goes on, and the log says so
      refused ///< stops
    };

    bool any_values(const std::string &, const std::string &)
    {
      return true;
    }

    /// Points carry an affine field of velocity with some methods only.
    bool methods_of_same_points(const std::string &before, const std::string &now)
    {
      TransferParameters one, other;
      one.method   = before;
      other.method = now;
      return one.carries_affine_field() == other.carries_affine_field();
    }

    struct Rule
    {
      std::string subsection, name; // no name: all entries of the subsection
      Change change;
      bool (*holds_for)(const std::string &before, const std::string &now) = any_values;
    };

    /// Entries without a rule must not change.
    const std::vector<Rule> rules{ { "", "End time", Change::free },
                                   { "", "Output directory", Change::free },
                                   { "", "Coordinate system", Change::free },
                                   { "Output", "", Change::free },
                                   { "Output/Maps", "Format", Change::free },
                                   { "Time step", "Mass scaling", Change::refused },
                                   { "Time step", "", Change::noted },
                                   { "Safety", "", Change::noted },
                                   { "Transfer", "Method", Change::noted, methods_of_same_points },
                                   { "Transfer", "PIC rate", Change::noted },
                                   { "Water/Pressure", "Relative tolerance", Change::noted },
                                   { "Water/Pressure", "Maximum iterations", Change::noted } };

    Change kind_of(const CaseEntry &entry, const CaseEntry *before, const CaseEntry *now)
    {
      const auto rule = std::find_if(rules.begin(), rules.end(), [&](const Rule &r) {
        return r.subsection == entry.subsection && (r.name.empty() || r.name == entry.name);
      });
      if (rule == rules.end())
        return Change::refused;
      const bool bears_it =
          rule->change == Change::free || (before && now && rule->holds_for(before->value, now->value));
      return bears_it ? rule->change : Change::refused;
    }


    /// An entry whose value has changed, or a subsection that only one of the cases has.
    struct Difference
    {
      Change kind;
      std::string name;   ///< of entry or subsection, as messages begin
      std::string now;    ///< ` = 3`; of a subsection nothing
      std::string before; ///< `2`; of a subsection whether there was one
    };


    std::string value_text(const CaseEntry *entry)
    {
      return !entry ? "no such entry" : entry->value.empty() ? "(empty)" : entry->value;
    }


    std::string text_before(const CaseEntry *before, const CaseEntry *now)
    {
      const bool are_files = before && now && !before->checksum.empty() && !now->checksum.empty();
      return value_text(before) + (are_files ? " with other contents" : "");
    }


    /// The differences, those of whole subsections last.
    class Differences
    {
    public:
      Differences(const CaseEntries &before, const CaseEntries &now)
      {
        for (const CaseEntry &entry : now.all())
          compare(entry, before.find(entry.subsection, entry.name), &entry, before.has_subsection(entry.subsection));
        for (const CaseEntry &entry : before.all())
          if (!now.find(entry.subsection, entry.name))
            compare(entry, &entry, nullptr, now.has_subsection(entry.subsection));
      }

      std::vector<Difference> of_kind(const Change kind) const
      {
        std::vector<Difference> result;
        for (const Difference &difference : entries)
          if (difference.kind == kind)
            result.push_back(difference);
        // Those at the top say what has happened.
        for (const bool at_top : { true, false })
          for (const auto &[path, before] : subsections)
            if (kind == Change::refused && at_top == (path.find('/') == std::string::npos))
              result.push_back({ kind, "subsection " + path, "", before });
        return result;
      }

    private:
      void compare(const CaseEntry &entry,
                   const CaseEntry *before,
                   const CaseEntry *now,
                   const bool both_have_its_subsection)
      {
        if (before && now && same_value(*before, *now))
          return;
        const Change kind = kind_of(entry, before, now);
        if (both_have_its_subsection)
          entries.push_back(
              { kind, entry_name(entry.subsection, entry.name), " = " + value_text(now), text_before(before, now) });
        else if (kind == Change::refused)
          subsections[entry.subsection] = now ? "none" : "one";
      }

      std::vector<Difference> entries;
      std::map<std::string, std::string> subsections; // and whether there was one
    };


    /// Throws EntryError if there are differences: names the first and a few others.
    void refuse(const std::vector<Difference> &differences, const Checkpoint &checkpoint)
    {
      if (differences.empty())
        return;
      constexpr unsigned int most_names = 4;
      std::string others;
      for (unsigned int d = 1; d < std::min<std::size_t>(differences.size(), most_names); ++d)
        others += (others.empty() ? " Changed, too: " : "; ") + differences[d].name;
      if (differences.size() > most_names)
        others += "; and " + std::to_string(differences.size() - most_names) + " more";
      const Difference &first = differences.front();
      throw EntryError(first.name + first.now + ": the run that wrote " + checkpoint.folder + " had " + first.before +
                       ", and --resume cannot change that. Write it as it was, or run without --resume in another "
                       "\"Output directory\"." +
                       others + (others.empty() ? "" : "."));
    }
  } // namespace


  std::vector<std::string> notes_on_changes(const Checkpoint &checkpoint, const CaseEntries &entries)
  {
    const Differences differences(checkpoint.entries, entries);
    refuse(differences.of_kind(Change::refused), checkpoint);
    std::vector<std::string> notes;
    for (const Difference &difference : differences.of_kind(Change::noted))
      notes.push_back("Changed from here on: " + difference.name + difference.now + ", before " + difference.before +
                      '.');
    return notes;
  }
} // namespace scree
