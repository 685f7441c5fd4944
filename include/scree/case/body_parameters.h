// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_body_parameters_h
#define scree_case_body_parameters_h

#include <scree/initial/initial_state.h>
#include <scree/materials/table.h>
#include <scree/seeding/seeding.h>
#include <scree/bodies/seepage_parameters.h>

namespace scree
{
  /// One body of soil: where it is, what it is made of, how it starts. One subsection of the `.prm`, named after the
  /// body.
  struct BodyParameters
  {
    std::string name;                     ///< name of its subsection
    SeedingParameters seeding;            ///< where it is, and its points
    SeepageParameters seepage;            ///< hydraulic conductivity
    MaterialParameters material;          ///< law and its entries
    InitialStateParameters initial_state; ///< stress before the first step

    /// Declares the body's subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations of entries.
    /// @param water null in a dry scene
    void check(const std::vector<double> &gravity, const WaterParameters *water) const;

    /// Whether the body keeps its place.
    bool is_rigid() const;

    /// Volume of pores over total volume, as the entry or the law says.
    double initial_porosity() const;

    /// Density of the dry body, kg/m^3: grains times (1 - porosity).
    double bulk_density() const;

    /// Horizontal over vertical stress of a K0 start.
    double k0() const;

    /// Of pressure waves in the dry body at the entry of its pressure, m/s; 0 without stiffness.
    double wave_speed() const;

  private:
    void check_rigid() const;
  };
} // namespace scree

#endif
