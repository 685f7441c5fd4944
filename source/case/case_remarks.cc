// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/case_remarks.h>

#include <cmath>

namespace scree
{
  namespace
  {
    /// Bodies that shear within themselves before they slide on a base of this friction coefficient.
    void add_stronger_base(const Parameters &parameters,
                           const std::string &subsection,
                           const std::string &entry,
                           const double friction,
                           std::vector<std::string> &remarks)
    {
      constexpr double rounding = 1.005; // an angle with three digits
      for (const BodyParameters &body : parameters.bodies)
        if (const double inside = make_material<2>(body.material)->plane_friction(); friction > rounding * inside)
          remarks.push_back(
              "Base stronger than the soil: " +
              entry_message(subsection,
                            entry,
                            number_text(std::atan(friction) * 180 / dealii::numbers::PI) + " degrees",
                            body.name + " shears on a plane at " +
                                number_text(std::atan(inside) * 180 / dealii::numbers::PI) +
                                " degrees. It does not slide on this base, and its lowest cells shear as on a fixed "
                                "one. An angle of repose is \"Friction angle kind = direct shear or repose\"."));
    }


    /// Shear bands of a length that the cells do not resolve.
    void add_unresolved_length(const BodyParameters &body, const double cell_size, std::vector<std::string> &remarks)
    {
      constexpr double rounding = 1e-9;
      const double length       = make_material<2>(body.material)->nonlocal_variable().length;
      if (length > 0 && cell_size > length / 2 * (1 + rounding))
        remarks.push_back("Unusual value: " + entry_message(body.material.path(body.name),
                                                            "Nonlocal length",
                                                            number_text(length),
                                                            "shear bands depend on cells wider than half of it, here " +
                                                                number_text(cell_size) + " m. Use cells of at most " +
                                                                number_text(length / 2) + " m."));
    }
  } // namespace


  std::vector<std::string> remarks_on(const Parameters &parameters)
  {
    std::vector<std::string> remarks = parameters.unread_laws;
    for (const BodyParameters &body : parameters.bodies)
      add_unresolved_length(body, parameters.grid.cell_size, remarks);
    const auto walls = parameters.boundaries.walls(3);
    const auto names = FaceEntries::names(3);
    for (unsigned int face = 0; face < walls.size(); ++face)
      if (names[face] == "Bottom")
        add_stronger_base(parameters, "Boundaries", names[face], walls[face].friction_coefficient, remarks);
    if (parameters.bed.type_kind() == BedType::friction)
      add_stronger_base(parameters, "Bed", "Friction angle", parameters.bed.friction_coefficient(), remarks);
    return remarks;
  }
} // namespace scree
