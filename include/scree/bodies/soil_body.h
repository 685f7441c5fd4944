// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_soil_body_h
#define scree_bodies_soil_body_h

#include <scree/materials/material.h>
#include <scree/bodies/drag_law.h>
#include <scree/particles/point_set.h>
#include <scree/particles/property_layout.h>

#include <memory>
#include <optional>
#include <string>

namespace scree
{
  /// A body of soil: its points, where their quantities lie, and the law that moves them.
  template <int dim>
  struct SoilBody
  {
    std::string name;                        ///< name of its subsection
    double density;                          ///< bulk density of the dry soil at J = 1, kg/m^3
    double grain_density;                    ///< kg/m^3
    double spacing        = 0;               ///< of its points at the start, m
    double affine_inertia = 0;               ///< see TransferParameters::affine_inertia()
    std::unique_ptr<Material<dim>> material; ///< the law; holds no state of points
    PropertyLayout<dim> layout;              ///< offsets of the quantities of a point
    PointSet<dim> points;                    ///< its points on this rank
    bool is_rigid      = false;              ///< its points keep their place and carry any stress
    unsigned int group = 0;                  ///< bodies of a group stick to each other and share a velocity field
    std::optional<DragLaw> drag;             ///< on water; none in a dry scene

    /// Makes a body without points.
    /// @param density bulk density of the dry soil at J = 1, kg/m^3
    /// @param grain_density kg/m^3
    SoilBody(const std::string &name,
             const double density,
             const double grain_density,
             std::unique_ptr<Material<dim>> material,
             const PropertyLayout<dim> &layout,
             const dealii::Triangulation<dim> &triangulation,
             const dealii::Mapping<dim> &mapping)
        : name(name)
        , density(density)
        , grain_density(grain_density)
        , material(std::move(material))
        , layout(layout)
        , points(triangulation, mapping, layout.n_properties)
    {
    }

    /// See Material::wave_speed().
    double wave_speed(const double bulk_modulus, const double compression) const
    {
      return material->wave_speed(bulk_modulus, compression, density);
    }

    /// Volume of a point's pores, m^3 (2D: per m): not positive where grains overlap.
    double pore_volume(const double *properties) const
    {
      return properties[layout.volume] - properties[layout.mass] / grain_density;
    }

    /// Volume of pores over total volume of a point.
    double porosity(const double *properties) const
    {
      return pore_volume(properties) / properties[layout.volume];
    }

    /// The slots of a cell's points that the law reads and writes.
    MaterialPoints<dim> material_points(const CellPoints<dim> &cell) const
    {
      return { cell.n_points,
               points.stride(),
               cell.properties + layout.left_cauchy_green,
               cell.properties + layout.stress,
               cell.properties + layout.internal_variables,
               cell.slots };
    }
  };
} // namespace scree

#endif
