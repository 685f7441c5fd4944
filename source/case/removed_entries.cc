// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/removed_entries.h>
#include <scree/input/input_error.h>

#include <map>

namespace scree
{
  std::string removed_entry_remedy(const std::string &subsection, const std::string &entry, const std::string &value)
  {
    const std::string removed = "It was removed after version 0.9. ";
    const std::string source =
        " (measurements: doc/developer/development_log.md#choices-for-the-pressure-that-failed).";
    const std::string path = subsection_path(subsection, entry);
    if (path == "Water/Pressure/Previous pressure" && (value == "grid" || value == "dropped"))
      return removed + "Remove the line, or write affine, which is the default, or average" + source;
    static const std::map<std::string, std::string> remedies{
      { "Water/Pressure/Divergence", "The divergence is always that of \"expanded\". Remove the line" + source },
      { "Water/Pressure/Free surface",
        "The surface is always found inside the cells, as with \"distance\". Remove the line" + source },
      { "Water/Pressure/Splitting",
        "Pressure and drag are always solved together, as with \"drag in correction\". Remove the line" + source },
      { "Settling/Damping rate", "Settling stops all where the kinetic energy is largest. Remove the line." },
      { "Settling/Kinetic energy", "Settling ends by \"Unbalanced force\". Remove the line, or write that entry." },
    };
    const auto found = remedies.find(path);
    return found == remedies.end() ? "" : removed + found->second;
  }
} // namespace scree
