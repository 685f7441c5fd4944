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
    inline const OutputField velocity{ "velocity", "m/s", FieldKind::vector }; ///< of points and grid
    inline const OutputField mass{ "mass", "kg" };                             ///< of a point
    inline const OutputField volume{ "volume", "m^3" };                        ///< of a point
    inline const OutputField seepage_velocity{ "seepage_velocity",
                                               "m/s",
                                               FieldKind::vector }; ///< velocity of the water relative to the soil
    inline const OutputField porosity{ "porosity", "-" };           ///< pores over volume

    // Of points of soil; the mean effective stress also of the grid.
    inline const OutputField stress{ "stress", "Pa", FieldKind::tensor };            ///< Cauchy, tension positive
    inline const OutputField mean_effective_stress{ "mean_effective_stress", "Pa" }; ///< compression positive
    inline const OutputField deviatoric_stress{ "deviatoric_stress", "Pa" };         ///< q
    inline const OutputField stress_ratio{ "stress_ratio", "-" };                    ///< q over mean effective stress
    inline const OutputField body{ "body", "-" };                                    ///< number of the body
    inline const OutputField pore_pressure{ "pore_pressure", "Pa" };                 ///< of the water around the point
    inline const OutputField id{ "id", "-" };                                        ///< number of the point
    inline const OutputField displacement{ "displacement", "m", FieldKind::vector }; ///< since the start

    // Of points of water; the pressure also of the grid.
    inline const OutputField pressure{ "pressure", "Pa" };      ///< of the water
    inline const OutputField inside_soil{ "inside_soil", "-" }; ///< 1 where the water is in pores

    // Of the grid.
    inline const OutputField density{ "density", "kg/m^3" };                               ///< of the soil
    inline const OutputField water_velocity{ "water_velocity", "m/s", FieldKind::vector }; ///< of the water
    inline const OutputField saturation{ "saturation", "-" };                              ///< of the pores
  }                                                                                        // namespace fields
} // namespace scree

#endif
