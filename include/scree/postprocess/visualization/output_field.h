// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_visualization_output_field_h
#define scree_postprocess_visualization_output_field_h

#include <string>

namespace scree
{
  /// Values of a field at a point.
  enum class FieldKind
  {
    scalar,
    vector, ///< components X, Y, Z
    tensor  ///< components XX, XY, XZ, YX, ...
  };

  /// A field of the files for ParaView.
  struct OutputField
  {
    std::string name;                   ///< words joined by `_`
    std::string unit;                   ///< "-": none
    FieldKind kind = FieldKind::scalar; ///< values at a point

    /// The name in the files, `pore_pressure [Pa]`; without a unit `porosity`.
    std::string label() const
    {
      return unit == "-" ? name : name + " [" + unit + ']';
    }
  };

  /// All fields but those of the laws, see Material::internal_quantities() and Material::output_quantities().
  namespace fields
  {
    // Of points of soil and water; velocity and porosity also of the grid.
    inline const OutputField velocity{ "velocity", "m/s", FieldKind::vector };
    inline const OutputField mass{ "mass", "kg" };
    inline const OutputField volume{ "volume", "m^3" };
    inline const OutputField seepage_velocity{ "seepage_velocity", "m/s", FieldKind::vector };
    inline const OutputField porosity{ "porosity", "-" };

    // Of points of soil; the mean effective stress also of the grid.
    inline const OutputField stress{ "stress", "Pa", FieldKind::tensor };
    inline const OutputField mean_effective_stress{ "mean_effective_stress", "Pa" };
    inline const OutputField deviatoric_stress{ "deviatoric_stress", "Pa" };
    inline const OutputField stress_ratio{ "stress_ratio", "-" };
    inline const OutputField body{ "body", "-" };
    inline const OutputField pore_pressure{ "pore_pressure", "Pa" };
    inline const OutputField id{ "id", "-" };
    inline const OutputField displacement{ "displacement", "m", FieldKind::vector };

    // Of points of water; the pressure also of the grid.
    inline const OutputField pressure{ "pressure", "Pa" };
    inline const OutputField inside_soil{ "inside_soil", "-" };

    // Of the grid.
    inline const OutputField density{ "density", "kg/m^3" };
    inline const OutputField water_velocity{ "water_velocity", "m/s", FieldKind::vector };
    inline const OutputField saturation{ "saturation", "-" };
  } // namespace fields
} // namespace scree

#endif
