// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/removed_entries.h>
#include <scree/input/input_error.h>

#include <map>

namespace scree
{
  std::string removed_entry_remedy(const std::string &subsection, const std::string &entry, const std::string &value)
  {
    const auto measured = [](const std::string &section) {
      return " (measurements: doc/developer/development_log.md#" + section + ").";
    };
    const std::string pressure = measured("choices-for-the-pressure-that-failed");
    const std::string transfer = measured("removed-transfers"), step = measured("variational-pressure-step");
    // Entries, or values of entries that are still there.
    const std::map<std::string, std::string> remedies{
      { "Water/Pressure/Divergence", "The divergence is always that of \"expanded\". Remove the line" + pressure },
      { "Water/Pressure/Free surface",
        "The surface is always found inside the cells, as with \"distance\". Remove the line" + pressure },
      { "Water/Pressure/Splitting",
        "Pressure and drag are always solved together, as with \"drag in correction\". Remove the line" + pressure },
      { "Water/Pressure/Step", "The step is always that of \"variational\". Remove the line" + step },
      { "Water/Pressure/Previous pressure",
        "The pressure of the points always counts with its gradient. Remove the line" + step },
      { "Water/Pressure/Fading", "The pressure makes no energy that had to fade. Remove the line" + step },
      { "Water/Pressure/Projection", "The pressure needs no projection. Remove the line" + step },
      { "Settling/Damping rate", "Settling stops all where the kinetic energy is largest. Remove the line." },
      { "Settling/Kinetic energy", "Settling ends by \"Unbalanced force\". Remove the line, or write that entry." },
      { "Transfer/Method = auto", "Remove the line, or write AFLIP, which is the default" + transfer },
      { "Transfer/Method = PIC", "Write FLIP, which with \"PIC rate = 1e9\" is the same" + transfer },
      { "Transfer/Stress update",
        "The strain is always that of \"USL\". Remove the line, and a \"Courant number\" above 0.6" + transfer },
      { "Mesh/Basis = quadratic", "Write spline, which is the default" + transfer },
    };
    const std::string path = subsection_path(subsection, entry);
    for (const std::string &name : { path, path + " = " + value })
      if (const auto found = remedies.find(name); found != remedies.end())
        return "It was removed after version 0.9. " + found->second;
    return "";
  }
} // namespace scree
