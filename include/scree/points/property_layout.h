// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_points_property_layout_h
#define scree_points_property_layout_h

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
    unsigned int start;             ///< location at the start of the run, m, dim
    bool has_start;                 ///< whether points keep it
    unsigned int touching_distance; ///< from the bed at which they touch it, m
    unsigned int contact_force;     ///< of the bed on them, N (2D: per m), dim
    bool has_contact;               ///< whether points keep these two
    unsigned int n_properties;

    /// @param n_internal_variables of the material law
    /// @param with_affine whether the transfer carries an affine velocity field
    /// @param with_start whether points keep where they started
    /// @param with_contact whether there is a bed
    /// @param n_further slots behind the soil's own: of water that rides on the points
    PropertyLayout(const unsigned int n_internal_variables,
                   const bool with_affine,
                   const unsigned int n_further = 0,
                   const bool with_start        = false,
                   const bool with_contact      = false)
        : affine(internal_variables + n_internal_variables)
        , start(affine + (with_affine ? dim * dim : 0))
        , has_start(with_start)
        , touching_distance(start + (with_start ? dim : 0))
        , contact_force(touching_distance + 1)
        , has_contact(with_contact)
        , n_properties(touching_distance + (with_contact ? 1 + dim : 0) + n_further)
    {
    }
  };
} // namespace scree

#endif
