// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_property_layout_h
#define scree_particles_property_layout_h

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
    unsigned int start;        ///< location at the start of the run, m, dim
    bool has_start;            ///< whether points keep it
    unsigned int contacts;     ///< with each of the rigid surfaces: touching_distance() and contact_force()
    unsigned int n_contacts;   ///< surfaces: the bed and obstacles
    unsigned int n_properties; ///< doubles of a point in total

    /// @param n_internal_variables of the material law
    /// @param with_affine whether the transfer carries an affine velocity field
    /// @param with_start whether points keep where they started
    /// @param n_contacts rigid surfaces: the bed and obstacles
    /// @param n_further slots behind the soil's own: of water that rides on the points
    PropertyLayout(const unsigned int n_internal_variables,
                   const bool with_affine,
                   const unsigned int n_further  = 0,
                   const bool with_start         = false,
                   const unsigned int n_contacts = 0)
        : affine(internal_variables + n_internal_variables)
        , start(affine + (with_affine ? dim * dim : 0))
        , has_start(with_start)
        , contacts(start + (with_start ? dim : 0))
        , n_contacts(n_contacts)
        , n_properties(contacts + n_contacts * (1 + dim) + n_further)
    {
    }

    /// Distance from a rigid surface at which the point touches it, m.
    unsigned int touching_distance(const unsigned int surface) const
    {
      return contacts + surface * (1 + dim);
    }

    /// Force of a rigid surface on the point, N (2D: per m), dim.
    unsigned int contact_force(const unsigned int surface) const
    {
      return touching_distance(surface) + 1;
    }
  };
} // namespace scree

#endif
