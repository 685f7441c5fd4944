// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case_changes.h>
#include <scree/input/input_error.h>
#include <scree/transfer/transfer_parameters.h>

#include <algorithm>

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
                                   { "Output", "", Change::free },
                                   { "Time step", "", Change::noted },
                                   { "Transfer", "Method", Change::noted, methods_of_same_points },
                                   { "Transfer", "PIC rate", Change::noted },
                                   { "Water/Pressure", "Relative tolerance", Change::noted },
                                   { "Water/Pressure", "Maximum iterations", Change::noted } };

    /// A null pointer stands for an entry that the case did not have, or has no more.
    struct ChangedEntry
    {
      const CaseEntry *before, *now;

      const CaseEntry &place() const
      {
        return now ? *now : *before;
      }

      Change kind() const
      {
        const auto rule = std::find_if(rules.begin(), rules.end(), [&](const Rule &r) {
          return r.subsection == place().subsection && (r.name.empty() || r.name == place().name);
        });
        if (rule == rules.end())
          return Change::refused;
        const bool bears_it =
            rule->change == Change::free || (before && now && rule->holds_for(before->value, now->value));
        return bears_it ? rule->change : Change::refused;
      }
    };


    std::vector<ChangedEntry> changed_entries(const CaseEntries &before, const CaseEntries &now)
    {
      std::vector<ChangedEntry> changed;
      for (const CaseEntry &entry : now.all())
        {
          const CaseEntry *old = before.find(entry.subsection, entry.name);
          if (!old || !same_value(old->value, entry.value))
            changed.push_back({ old, &entry });
        }
      for (const CaseEntry &entry : before.all())
        if (!now.find(entry.subsection, entry.name))
          changed.push_back({ &entry, nullptr });
      return changed;
    }


    std::string value_text(const CaseEntry *entry)
    {
      return !entry ? "(no such entry)" : entry->value.empty() ? "(empty)" : entry->value;
    }


    /// Throws EntryError if there are such entries: names the first with its values, and the others.
    void refuse(const std::vector<ChangedEntry> &changed, const Checkpoint &checkpoint)
    {
      if (changed.empty())
        return;
      const ChangedEntry &first = changed.front();
      std::string others;
      for (auto other = changed.begin() + 1; other != changed.end(); ++other)
        others +=
            (others.empty() ? " So have changed: " : "; ") + entry_name(other->place().subsection, other->place().name);
      throw EntryError(entry_message(first.place().subsection,
                                     first.place().name,
                                     value_text(first.now),
                                     "the run that wrote " + checkpoint.folder + " had " + value_text(first.before) +
                                         ", and --resume cannot change that. Write the old value, or run without "
                                         "--resume in another \"Output directory\"." +
                                         others + (others.empty() ? "" : ".")));
    }
  } // namespace


  std::vector<std::string> notes_on_changes(const Checkpoint &checkpoint, const CaseEntries &entries)
  {
    std::vector<std::string> notes;
    std::vector<ChangedEntry> refused;
    for (const ChangedEntry &changed : changed_entries(checkpoint.entries, entries))
      if (const Change kind = changed.kind(); kind == Change::refused)
        refused.push_back(changed);
      else if (kind == Change::noted)
        notes.push_back("Changed from here on: " + entry_name(changed.place().subsection, changed.place().name) +
                        " = " + value_text(changed.now) + ", before " + value_text(changed.before) + '.');
    refuse(refused, checkpoint);
    return notes;
  }
} // namespace scree
