// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_laws_point_strength_return_h
#define scree_materials_laws_point_strength_return_h

#include <scree/materials/laws/mohr_coulomb_surfaces.h>

namespace scree
{
  /// Mohr-Coulomb's strength of a point or of a Batch of them.
  template <typename Number>
  struct PointStrength
  {
    Number sine;          ///< sin(phi)
    Number dilation_sine; ///< sin(psi)
    Number limit;         ///< 2 c cos(phi), Pa
  };


  /// The return of MohrCoulomb where each point has a strength of its own: the same surfaces and the same sets of them,
  /// whose linear systems are solved for each point.
  template <typename Number>
  class PointStrengthReturn
  {
  public:
    /// @param strength of the points
    /// @param cut_off largest principal stress, Pa, at most that of the apex of each point
    /// @param bulk modulus, Pa
    /// @param shear modulus, Pa
    PointStrengthReturn(const PointStrength<Number> &strength,
                        const double cut_off,
                        const double bulk,
                        const double shear);

    /// Returns a sorted stress of the points `todo` and sets their plastic strain; those that meet no set of surfaces
    /// stay in it.
    void
    return_sorted(PrincipalNumbers<Number> &stress, PrincipalNumbers<Number> &plastic, simd::Mask<Number> &todo) const;

  private:
    /// A plane normal . tau <= limit; relaxation: elastic stiffness times flow direction, Pa.
    struct Surface
    {
      PrincipalNumbers<Number> normal, flow, relaxation;
      Number limit;
    };

    static Number product(const PrincipalNumbers<Number> &a, const PrincipalNumbers<Number> &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    /// Returns those of the points `todo` that meet the `n` surfaces of the set, and takes them out.
    template <unsigned int n>
    void try_set(const unsigned int (&&set)[n],
                 const PrincipalNumbers<Number> &trial,
                 const Number &tolerance,
                 PrincipalNumbers<Number> &stress,
                 PrincipalNumbers<Number> &plastic,
                 simd::Mask<Number> &todo) const;

    const double shear;
    Surface surfaces[mohr_coulomb_surfaces::n_surfaces];
  };


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline PointStrengthReturn<Number>::PointStrengthReturn(const PointStrength<Number> &strength,
                                                                                const double cut_off,
                                                                                const double bulk,
                                                                                const double shear)
      : shear(shear)
  {
    using namespace mohr_coulomb_surfaces;
    for (unsigned int s = 0; s < n_surfaces; ++s)
      surfaces[s] = { direction(s, strength.sine),
                      direction(s, strength.dilation_sine),
                      relaxation(direction(s, strength.dilation_sine), bulk, shear),
                      s < cut_1 ? strength.limit : simd::broadcast<Number>(cut_off) };
  }


  template <typename Number>
  template <unsigned int n>
  DEAL_II_ALWAYS_INLINE inline void PointStrengthReturn<Number>::try_set(const unsigned int (&&set)[n],
                                                                         const PrincipalNumbers<Number> &trial,
                                                                         const Number &tolerance,
                                                                         PrincipalNumbers<Number> &stress,
                                                                         PrincipalNumbers<Number> &plastic,
                                                                         simd::Mask<Number> &todo) const
  {
    using namespace mohr_coulomb_surfaces;
    if (!simd::any(todo))
      return;
    // Elimination needs no pivots: principal minors are positive for sin(psi) <= sin(phi) < 1.
    Number matrix[n][n], multiplier[n];
    for (unsigned int a = 0; a < n; ++a)
      {
        const Surface &row = surfaces[set[a]];
        multiplier[a]      = excess<Number>(row, trial);
        for (unsigned int b = 0; b < n; ++b)
          matrix[a][b] = product(row.normal, surfaces[set[b]].relaxation);
      }
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = a + 1; b < n; ++b)
        {
          const Number factor = matrix[b][a] / matrix[a][a];
          for (unsigned int c = a + 1; c < n; ++c)
            matrix[b][c] -= factor * matrix[a][c];
          multiplier[b] -= factor * multiplier[a];
        }
    for (unsigned int a = n; a-- > 0;)
      {
        for (unsigned int b = a + 1; b < n; ++b)
          multiplier[a] -= matrix[a][b] * multiplier[b];
        multiplier[a] = multiplier[a] / matrix[a][a];
      }

    take<Number>(surfaces, set, n, multiplier, trial, shear, tolerance, stress, plastic, todo);
  }


  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline void PointStrengthReturn<Number>::return_sorted(PrincipalNumbers<Number> &stress,
                                                                               PrincipalNumbers<Number> &plastic,
                                                                               simd::Mask<Number> &todo) const
  {
    using namespace mohr_coulomb_surfaces;
    const PrincipalNumbers<Number> trial = stress;
    const Number tolerance =
        1e-12 * simd::max<Number>(surfaces[f13].limit,
                                  simd::max<Number>(simd::abs<Number>(trial[0]), simd::abs<Number>(trial[2])));
    try_set({ f13 }, trial, tolerance, stress, plastic, todo);
    try_set({ f13, f12 }, trial, tolerance, stress, plastic, todo);
    try_set({ f13, f23 }, trial, tolerance, stress, plastic, todo);
    try_set({ cut_1 }, trial, tolerance, stress, plastic, todo);
    try_set({ cut_1, cut_2 }, trial, tolerance, stress, plastic, todo);
    try_set({ f13, cut_1 }, trial, tolerance, stress, plastic, todo);
    try_set({ f13, f12, cut_1 }, trial, tolerance, stress, plastic, todo);
    // The edge where four surfaces meet, as two cones.
    try_set({ f13, cut_1, cut_2 }, trial, tolerance, stress, plastic, todo);
    try_set({ f13, f23, cut_1 }, trial, tolerance, stress, plastic, todo);
    // The three cut-offs meet at the vertex, which needs no system.
  }
} // namespace scree

#endif
