// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_mohr_coulomb_surfaces_h
#define scree_materials_laws_mohr_coulomb_surfaces_h

#include <scree/materials/law.h>

namespace scree
{
  /// The planes that bound sorted stresses, tau_1 >= tau_2 >= tau_3: friction of each pair, then the cut-off of each.
  namespace mohr_coulomb_surfaces
  {
    constexpr unsigned int f13 = 0; ///< friction of the largest and the smallest stress
    constexpr unsigned int f12 = 1; ///< friction of the larger two
    constexpr unsigned int f23 = 2; ///< friction of the smaller two

    constexpr unsigned int cut_1      = 3; ///< cut-off of the largest stress
    constexpr unsigned int cut_2      = 4; ///< cut-off of the middle one; that of the smallest follows
    constexpr unsigned int n_surfaces = 6; ///< number of planes

    /// Normal, or flow direction, of a friction plane with this sine of phi, or of psi; of a cut-off, whatever the
    /// sine.
    template <typename Number>
    PrincipalNumbers<Number> direction(const unsigned int surface, const Number &sine)
    {
      constexpr unsigned int largest[3] = { 0, 0, 1 }, smallest[3] = { 2, 1, 2 };
      PrincipalNumbers<Number> result;
      for (Number &component : result)
        component = simd::broadcast<Number>(0.);
      if (surface >= cut_1)
        result[surface - cut_1] = simd::broadcast<Number>(1.);
      else
        {
          result[largest[surface]]  = 1. + sine;
          result[smallest[surface]] = sine - 1.;
        }
      return result;
    }

    /// How far a stress is beyond a surface, a plane normal . tau <= limit, Pa.
    template <typename Number, typename Surface>
    DEAL_II_ALWAYS_INLINE inline Number excess(const Surface &surface, const PrincipalNumbers<Number> &stress)
    {
      return surface.normal[0] * stress[0] + surface.normal[1] * stress[1] + surface.normal[2] * stress[2] -
             surface.limit;
    }


    /// Takes those of the points `todo` out of it that return to the `n` surfaces of a set with these multipliers, and
    /// sets their stress and plastic strain. The strain of cut-offs is no plastic strain.
    /// @param shear modulus, Pa
    template <typename Number, typename Surfaces, typename Set>
    DEAL_II_ALWAYS_INLINE inline void take(const Surfaces &surfaces,
                                           const Set &set,
                                           const unsigned int n,
                                           const Number *multiplier,
                                           const PrincipalNumbers<Number> &trial,
                                           const double shear,
                                           const Number &tolerance,
                                           PrincipalNumbers<Number> &stress,
                                           PrincipalNumbers<Number> &plastic,
                                           simd::Mask<Number> &todo)
    {
      simd::Mask<Number> is_found       = todo;
      PrincipalNumbers<Number> returned = trial, flowed;
      flowed.fill(simd::broadcast<Number>(0.));
      for (unsigned int a = 0; a < n; ++a)
        {
          const auto &surface = surfaces[set[a]];
          is_found            = is_found & (multiplier[a] * shear >= -tolerance);
          for (unsigned int i = 0; i < 3; ++i)
            {
              returned[i] -= multiplier[a] * surface.relaxation[i];
              if (set[a] < cut_1)
                flowed[i] += multiplier[a] * surface.flow[i];
            }
        }
      for (const auto &surface : surfaces)
        is_found = is_found & (excess<Number>(surface, returned) <= tolerance);
      for (unsigned int i = 0; i < 3; ++i)
        {
          stress[i]  = simd::select<Number>(is_found, returned[i], stress[i]);
          plastic[i] = simd::select<Number>(is_found, flowed[i], plastic[i]);
        }
      todo = todo & !is_found;
    }


    /// Elastic stiffness times a flow direction, Pa.
    template <typename Number>
    PrincipalNumbers<Number> relaxation(const PrincipalNumbers<Number> &flow, const double bulk, const double shear)
    {
      const Number volume_part = (bulk - 2. / 3. * shear) * (flow[0] + flow[1] + flow[2]);
      PrincipalNumbers<Number> result;
      for (unsigned int i = 0; i < 3; ++i)
        result[i] = volume_part + 2 * shear * flow[i];
      return result;
    }
  } // namespace mohr_coulomb_surfaces
} // namespace scree

#endif
