// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_mohr_coulomb_return_h
#define scree_materials_laws_mohr_coulomb_return_h

#include <scree/materials/laws/mohr_coulomb_surfaces.h>
#include <scree/materials/laws/mohr_coulomb.h>

namespace scree
{
  /// Three numbers in falling order, and what it takes to bring others of their places back.
  template <typename Number>
  struct Sorted
  {
    /// Sorts the numbers.
    DEAL_II_ALWAYS_INLINE inline explicit Sorted(const PrincipalNumbers<Number> &numbers)
        : numbers(numbers)
    {
      exchanged[0] = exchange(this->numbers, 0, this->numbers[0] < this->numbers[1]);
      exchanged[1] = exchange(this->numbers, 1, this->numbers[1] < this->numbers[2]);
      exchanged[2] = exchange(this->numbers, 0, this->numbers[0] < this->numbers[1]);
    }

    /// In the order before, for sorted `result`.
    DEAL_II_ALWAYS_INLINE inline PrincipalNumbers<Number> unsorted(PrincipalNumbers<Number> result) const
    {
      exchange(result, 0, exchanged[2]);
      exchange(result, 1, exchanged[1]);
      exchange(result, 0, exchanged[0]);
      return result;
    }

    PrincipalNumbers<Number> numbers; ///< in falling order

  private:
    DEAL_II_ALWAYS_INLINE inline static simd::Mask<Number>
    exchange(PrincipalNumbers<Number> &numbers, const unsigned int i, const simd::Mask<Number> &condition)
    {
      const Number first = numbers[i], second = numbers[i + 1];
      numbers[i]     = simd::select<Number>(condition, second, first);
      numbers[i + 1] = simd::select<Number>(condition, first, second);
      return condition;
    }

    simd::Mask<Number> exchanged[3];
  };


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline void MohrCoulomb::return_sorted(PrincipalNumbers<Number> &stress,
                                                               PrincipalNumbers<Number> &plastic,
                                                               simd::Mask<Number> &todo) const
  {
    using namespace mohr_coulomb_surfaces;
    const PrincipalNumbers<Number> trial = stress;
    const Number tolerance =
        1e-13 * simd::max<Number>(simd::broadcast<Number>(surfaces[0].limit),
                                  simd::max<Number>(simd::abs<Number>(trial[0]), simd::abs<Number>(trial[2])));
    for (const ActiveSet &set : active_sets)
      {
        if (!simd::any(todo))
          return;
        const unsigned int n = set.surfaces.size();
        Number beyond[3], multiplier[3];
        for (unsigned int a = 0; a < n; ++a)
          beyond[a] = excess<Number>(surfaces[set.surfaces[a]], trial);
        for (unsigned int a = 0; a < n; ++a)
          {
            multiplier[a] = set.inverse[a][0] * beyond[0];
            for (unsigned int b = 1; b < n; ++b)
              multiplier[a] += set.inverse[a][b] * beyond[b];
          }
        take<Number>(surfaces, set.surfaces, n, multiplier, trial, shear, tolerance, stress, plastic, todo);
      }
  }


  template <typename Number, typename ReturnSorted>
  DEAL_II_ALWAYS_INLINE inline PrincipalNumbers<Number>
  MohrCoulomb::plastic_return(PrincipalNumbers<Number> &strain,
                              PrincipalNumbers<Number> &stress,
                              PrincipalResponse<Number> &response,
                              const simd::Mask<Number> &cohesionless,
                              const ReturnSorted &return_sorted) const
  {
    const Number volume_strain = strain[0] + strain[1] + strain[2];
    const Number of_apart      = simd::select<Number>(
        cohesionless, simd::broadcast<Number>(0.), simd::broadcast<Number>(vertex / bulk + largest_opening));
    const simd::Mask<Number> is_kept_apart = response.is_plastic & (volume_strain >= of_apart);

    Sorted<Number> sorted(stress);
    simd::Mask<Number> left = response.is_plastic & !is_kept_apart;
    PrincipalNumbers<Number> plastic;
    plastic.fill(simd::broadcast<Number>(0.));
    return_sorted(sorted.numbers, plastic, left);
    stress  = sorted.unsorted(sorted.numbers);
    plastic = sorted.unsorted(plastic);

    const simd::Mask<Number> at_vertex = left | is_kept_apart;
    const Number corner = simd::max<Number>(volume_strain, simd::broadcast<Number>(vertex / bulk)) * (1. / 3.);
    const Number mean   = (plastic[0] + plastic[1] + plastic[2]) * (1. / 3.);
    for (unsigned int i = 0; i < 3; ++i)
      {
        strain[i] = simd::select<Number>(at_vertex, corner, strain[i] - plastic[i]);
        stress[i] = simd::select<Number>(at_vertex, simd::broadcast<Number>(vertex), stress[i]);
        plastic[i] -= mean;
      }

    response.is_unresolved = at_vertex & (volume_strain < vertex / bulk * (1 - 1e-10));
    (vertex > 0 ? response.is_vertex : response.is_separated) = at_vertex & !response.is_unresolved;
    return plastic;
  }


  /// Plastic shear strain sqrt(2/3 e:e) of a deviator e.
  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number shear_strain_of(const PrincipalNumbers<Number> &deviator)
  {
    Number square = simd::broadcast<Number>(0.);
    for (const Number &value : deviator)
      square += value * value;
    return simd::sqrt<Number>(2. / 3. * square);
  }


  /// Plastic shear strain of the plane that shears, e_1 - e_3 of a deviator e: gamma in simple shear.
  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline Number plane_shear_of(const PrincipalNumbers<Number> &deviator)
  {
    return simd::max<Number>(deviator[0], simd::max<Number>(deviator[1], deviator[2])) -
           simd::min<Number>(deviator[0], simd::min<Number>(deviator[1], deviator[2]));
  }


  template <typename Number>
  __attribute__((noinline)) void MohrCoulomb::plastic_return(PrincipalNumbers<Number> &strain,
                                                             Number *internal_variables,
                                                             PrincipalNumbers<Number> &stress,
                                                             PrincipalResponse<Number> &response) const
  {
    // Grains with a gap do not dilate.
    const simd::Mask<Number> cohesionless_points = cohesionless ? response.is_plastic : simd::Mask<Number>{};
    const PrincipalNumbers<Number> deviator =
        plastic_return(strain, stress, response, cohesionless_points, [&](auto &sorted, auto &plastic, auto &todo) {
          return_sorted<Number>(sorted, plastic, todo);
        });
    internal_variables[0] += shear_strain_of<Number>(deviator);
  }
} // namespace scree

#endif
