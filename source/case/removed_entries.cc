// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/removed_entries.h>
#include <scree/input/input_error.h>

#include <map>

namespace scree
{
  std::string removed_entry_remedy(const std::string &subsection, const std::string &entry)
  {
    static const std::map<std::string, std::string> remedies{
      { "Water/Pressure/Divergence", "The divergence is always that of \"expanded\"." },
      { "Water/Pressure/Free surface", "The surface is always found inside the cells, as with \"distance\"." },
      { "Water/Pressure/Splitting", "Pressure and drag are always solved together, as with \"drag in correction\"." },
    };
    const auto found = remedies.find(subsection_path(subsection, entry));
    return found == remedies.end() ? ""
                                   : "It was removed after version 0.9. " + found->second +
                                         " Remove the line (measurements: doc/developer/development_log.md#choices-for-the-pressure-that-failed).";
  }
} // namespace scree
