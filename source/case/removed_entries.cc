// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/removed_entries.h>
#include <scree/input/input_error.h>

#include <algorithm>
#include <map>

namespace scree
{
  std::string removed_entry_remedy(const std::string &subsection, const std::string &entry, const std::string &value)
  {
    const auto measured = [](const std::string &section) {
      return " (measurements: doc/developer/development_log.md#" + section + ").";
    };
    const std::string pressure = measured("choices-for-the-pressure-that-failed");
    const std::string transfer = measured("removed-transfers"), step = measured("variational-pressure-step"),
                      unused = measured("removed-entries");
    // Entries, values of entries that are still there, or subsections; * is the name of a body or surface.
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
      { "Mesh/Box",
        "The box follows from the raster of the bed if both corners are left out. Remove the line" + unused },
      { "Mesh/Fine cells", "Cells are fine around the points. Remove the line" + unused },
      { "Transfer/Method = APIC", "Write TPIC, which has a smaller error in the same scenes" + unused },
      { "Base motion/Scale", "Write the record in m/s^2" + unused },
      { "Bed/Friction angles", "Write one \"Friction angle\"" + unused },
      { "*/Closed surface", "Write a \"Level set expression\", or \"Region\" for a body" + unused },
      { "*/Lower surface", "Write a subsection Bed with this raster" + unused },
      { "*/Jitter", "Points start on a lattice. Remove the line" + unused },
      { "Water/Jitter", "Points start on a lattice. Remove the line" + unused },
      { "*/Grain diameter", "Write \"Hydraulic conductivity\", or the diameter in subsection Water" + unused },
      { "Water/Fluidisation porosity", "Soil separates by its law. Remove the line" + unused },
      { "Water/Phreatic surface file", "Write the elevation as expression \"Phreatic surface\"" + unused },
      { "Water/Suspension", "Grains add no viscosity, as their laws missed the measurements. Remove it" + unused },
      { "Rain/Region", "Rain falls on all of the soil. Remove the line" + unused },
      { "Settling/Type", "The pore pressure is always held, as with \"drained\". Remove the line" + unused },
      { "Safety/Damping rate", "The rate is 2 sqrt(gravity/height of the soil). Remove the line" + unused },
      { "Safety/Maximum time", "A trial takes at most 40 sqrt(height of the soil/gravity). Remove the line" + unused },
      { "Output/Checkpoint failure", "The run stops, and --resume continues it. Remove the line" + unused },
      { "*/Nor-Sand/Critical friction angle", "Write M = 6 sin/(3 - sin) as \"Critical stress ratio M\"" + unused },
      { "*/Nor-Sand/Friction angle kind", "Write \"Critical stress ratio M\". Remove the line" + unused },
      { "*/Nor-Sand/Grain diameter", "Only Mohr-Coulomb has inertial friction. Remove the line" + unused },
      { "*/Nor-Sand/Reference inertial number", "Only Mohr-Coulomb has inertial friction. Remove the line" + unused },
      { "*/Nor-Sand/Friction increase", "Only Mohr-Coulomb has inertial friction. Remove the line" + unused },
      { "*/Nor-Sand (Jefferies-Been)/Critical line",
        "The critical line is straight in ln p. Remove the line" + unused },
      { "*/Nor-Sand (Jefferies-Been)/Curve void ratio", "Write \"Critical void ratio\"" + unused },
      { "*/Nor-Sand (Jefferies-Been)/Curve coefficient", "Write \"Compression index\"" + unused },
      { "*/Nor-Sand (Jefferies-Been)/Curve exponent",
        "The critical line is straight in ln p. Remove the line" + unused },
    };
    const std::string path = subsection_path(subsection, entry);
    const bool is_in_body  = path.rfind("Water/", 0) != 0;
    for (const std::string &name :
         { path, path + " = " + value, is_in_body ? '*' + path.substr(std::min(path.find('/'), path.size())) : "" })
      if (const auto found = remedies.find(name); found != remedies.end())
        return "It was removed after version 0.9. " + found->second;
    return "";
  }
} // namespace scree
