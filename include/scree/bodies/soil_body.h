// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_soil_body_h
#define scree_bodies_soil_body_h

#include <scree/bodies/drag_law.h>
#include <scree/materials/material.h>
#include <scree/tensor/components.h>

namespace scree
{
  /// Where a point's quantities lie among its ParticleHandler properties (offsets in doubles).
  /// Slots that a run does not need (internal variables, affine matrix) are not allocated.
  template <int dim>
  struct PropertyLayout
  {
    static constexpr unsigned int velocity           = 0;       ///< m/s, dim
    static constexpr unsigned int mass               = dim;     ///< kg (2D: per m)
    static constexpr unsigned int volume             = dim + 1; ///< m^3 (2D: per m)
    static constexpr unsigned int left_cauchy_green  = dim + 2; ///< b_e, -
    static constexpr unsigned int stress             = left_cauchy_green + n_symmetric_components<dim>; ///< Cauchy, Pa
    static constexpr unsigned int internal_variables = stress + n_symmetric_components<dim>; ///< as the law says
    unsigned int affine;                                                                     ///< dim x dim, row-major
    unsigned int damping;      ///< stress of the damping of the skeleton, Pa, n_symmetric_components<dim>
    bool has_damping;          ///< whether points have it
    unsigned int start;        ///< location at the start of the run, m, dim
    bool has_start;            ///< whether points have it
    unsigned int n_properties; ///< doubles of a point in total

    /// @param n_internal_variables of the material law
    /// @param with_affine whether the transfer carries an affine velocity field
    /// @param with_damping whether the skeleton is damped
    /// @param with_start whether points keep the place where they started
    /// @param n_further slots behind the soil's own: of water that rides on the points
    PropertyLayout(const unsigned int n_internal_variables,
                   const bool with_affine,
                   const unsigned int n_further = 0,
                   const bool with_damping      = false,
                   const bool with_start        = false)
        : affine(internal_variables + n_internal_variables)
        , damping(affine + (with_affine ? dim * dim : 0))
        , has_damping(with_damping)
        , start(damping + (with_damping ? n_symmetric_components<dim> : 0))
        , has_start(with_start)
        , n_properties(start + (with_start ? dim : 0) + n_further)
    {
    }
  };

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
