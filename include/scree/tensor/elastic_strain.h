// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tensor_elastic_strain_h
#define scree_tensor_elastic_strain_h

#include <scree/tensor/principal.h>

namespace scree
{
  /// Principal logarithmic strains, 1/2 ln of the principal values of a left Cauchy-Green tensor.
  template <typename Number>
  DEAL_II_ALWAYS_INLINE inline PrincipalNumbers<Number> log_strain(const PrincipalNumbers<Number> &left_cauchy_green)
  {
    return { { 0.5 * simd::log<Number>(left_cauchy_green[0]),
               0.5 * simd::log<Number>(left_cauchy_green[1]),
               0.5 * simd::log<Number>(left_cauchy_green[2]) } };
  }

  /// Exponential map (@source{simo1992}): b = sum exp(2 strain_i) n_i n_i along the axes of `frame`.
  template <int dim, typename Number>
  DEAL_II_ALWAYS_INLINE inline void
  left_cauchy_green_of(const PrincipalFrame<dim, Number> &frame, const PrincipalNumbers<Number> &strain, Number *result)
  {
    frame.compose(
        { { simd::exp<Number>(2. * strain[0]), simd::exp<Number>(2. * strain[1]), simd::exp<Number>(2. * strain[2]) } },
        result);
  }

  /// Trial b = f b f^T by components. In plane strain `out_of_plane_stretch` is f_zz; in three dimensions it is not
  /// read.
  ///
  /// @param f dim x dim, row-major
  template <int dim, typename Number>
  DEAL_II_ALWAYS_INLINE inline void
  trial_left_cauchy_green(const Number *f, const Number &out_of_plane_stretch, const Number *b, Number *result)
  {
    constexpr unsigned int rows[6] = { 0, 1, 2, 0, 0, 1 }, columns[6] = { 0, 1, 2, 1, 2, 2 };
    const auto full = matrix_of_components<dim>(b);
    Number product[dim][dim]; // f b
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          product[i][j] = f[dim * i] * full[0][j] + f[dim * i + 1] * full[1][j];
          if constexpr (dim == 3)
            product[i][j] += f[dim * i + 2] * full[2][j];
        }
    for (unsigned int c = 0; c < n_symmetric_components<dim>; ++c)
      if (dim == 2 && c == 2)
        result[c] = out_of_plane_stretch * out_of_plane_stretch * b[c];
      else
        {
          const Number *of_row = product[rows[c]], *of_column = f + dim * columns[c];
          result[c] = of_row[0] * of_column[0] + of_row[1] * of_column[1];
          if constexpr (dim == 3)
            result[c] += of_row[2] * of_column[2];
        }
  }

  /// Logarithmic elastic strain 1/2 ln b in three dimensions as volume strain and deviator, and the way back to b along
  /// the same axes: what isotropic laws without corners need, without principal directions. b = m (I + D) with the
  /// trace-free D has ln b = ln m I + D - D^2/2 + D^3/3 - ... . By Cayley and Hamilton D^3 = J_2 D + J_3 I, so that
  /// every power is a combination of I, D and D^2, and the series is one of scalars; exp likewise. Valid where
  /// principal values differ by less than a fifth or so.
  template <typename Number>
  class ElasticStrain
  {
  public:
    /// Decomposes 1/2 ln b by a series.
    /// @param b components of a left Cauchy-Green tensor, see tensor/components.h
    DEAL_II_ALWAYS_INLINE inline explicit ElasticStrain(const Number *b)
    {
      const Number mean = (b[0] + b[1] + b[2]) * (1. / 3.), inverse = 1. / mean;
      Number D[6];
      for (unsigned int c = 0; c < 6; ++c)
        D[c] = (c < 3 ? b[c] - mean : b[c]) * inverse;
      const Powers powers(D);
      is_valid = (powers.J2 < 1e-2) & (mean > 0.);

      // No principal value of D is above sqrt(4/3 J2), here .0115 and .116: what is left out is below rounding.
      constexpr double factors[] = { 0.,     1.,       -1. / 2, 1. / 3,   -1. / 4, 1. / 5,   -1. / 6, 1. / 7,  -1. / 8,
                                     1. / 9, -1. / 10, 1. / 11, -1. / 12, 1. / 13, -1. / 14, 1. / 15, -1. / 16 };
      const Series sum           = powers.template sum<8, 16>(factors);
      const Number trace         = 3. * sum.identity + 2. * powers.J2 * sum.squared;
      volume                     = 0.5 * (3. * simd::log<Number>(mean) + trace);
      for (unsigned int c = 0; c < 6; ++c)
        {
          deviator[c] = sum.linear * D[c] + sum.squared * powers.squared[c];
          if (c < 3)
            deviator[c] += sum.identity - trace * (1. / 3.);
          deviator[c] *= 0.5;
        }
      square = deviator[0] * deviator[0] + deviator[1] * deviator[1] + deviator[2] * deviator[2] +
               2. * (deviator[3] * deviator[3] + deviator[4] * deviator[4] + deviator[5] * deviator[5]);
    }

    /// Components of b of this volume strain and `factor` times the deviator.
    DEAL_II_ALWAYS_INLINE inline void compose(const Number &volume_strain, const Number &factor, Number *b) const
    {
      Number D[6];
      for (unsigned int c = 0; c < 6; ++c)
        D[c] = 2. * factor * deviator[c];
      const Powers powers(D);
      constexpr double factors[] = { 1.,       1.,        1. / 2,     1. / 6,      1. / 24,      1. / 120,
                                     1. / 720, 1. / 5040, 1. / 40320, 1. / 362880, 1. / 3628800, 1. / 39916800 };
      const Series sum           = powers.template sum<7, 11>(factors);
      const Number size          = simd::exp<Number>(volume_strain * (2. / 3.));
      for (unsigned int c = 0; c < 6; ++c)
        {
          b[c] = sum.linear * D[c] + sum.squared * powers.squared[c];
          if (c < 3)
            b[c] += 1. + sum.identity;
          b[c] *= size;
        }
    }

    /// Determinant of the deviator.
    Number third() const
    {
      return determinant_of_components<3>(deviator);
    }

    /// A number below which the smallest principal value of the deviator is not: none is beyond sqrt(2/3) of its size.
    Number bound_of_deviator() const
    {
      return -1. * simd::sqrt<Number>(2. / 3. * square);
    }

    /// Smallest principal value of the deviator.
    Number least_deviator() const
    {
      // A copy: the deviator stays in registers.
      const Number components[] = { deviator[0], deviator[1], deviator[2], deviator[3], deviator[4], deviator[5] };
      const PrincipalNumbers<Number> values = principal_values(components);
      return simd::min<Number>(values[0], simd::min<Number>(values[1], values[2]));
    }

    Number volume;               ///< tr(eps)
    Number deviator[6],          ///< components of dev(eps)
        square;                  ///< |dev(eps)|^2
    simd::Mask<Number> is_valid; ///< else b is far from a sphere, or no left Cauchy-Green tensor

  private:
    /// Rarely asked for.
    static __attribute__((noinline)) PrincipalNumbers<Number> principal_values(const Number *components)
    {
      return PrincipalFrame<3, Number>(components).values();
    }

    /// Factors of I, D and D^2.
    struct Series
    {
      Number identity, linear, squared;
    };

    struct Powers
    {
      Number squared[6], J2, J3;

      explicit Powers(const Number *D)
      {
        square_of_components(D, squared);
        J2 = 0.5 * (squared[0] + squared[1] + squared[2]);
        J3 = determinant_of_components<3>(D);
      }

      /// D + sum of factors[n] D^n, n from 2 to `few`, or to `many` in the lanes that need them.
      template <unsigned int few, unsigned int many>
      DEAL_II_ALWAYS_INLINE Series sum(const double *factors) const
      {
        Series sum                        = terms<few>(factors);
        const simd::Mask<Number> is_large = J2 >= 1e-4;
        if (simd::any(is_large))
          {
            const Series more = terms<many>(factors);
            sum.identity      = simd::select<Number>(is_large, more.identity, sum.identity);
            sum.linear        = simd::select<Number>(is_large, more.linear, sum.linear);
            sum.squared       = simd::select<Number>(is_large, more.squared, sum.squared);
          }
        return sum;
      }

      template <unsigned int last>
      DEAL_II_ALWAYS_INLINE Series terms(const double *factors) const
      {
        const Number zero = simd::broadcast<Number>(0.), one = simd::broadcast<Number>(1.);
        Series power{ zero, one, zero }, sum{ zero, one, zero };
        for (unsigned int n = 2; n <= last; ++n)
          {
            power = { power.squared * J3, power.identity + power.squared * J2, power.linear };
            sum.identity += factors[n] * power.identity;
            sum.linear += factors[n] * power.linear;
            sum.squared += factors[n] * power.squared;
          }
        return sum;
      }
    };
  };
} // namespace scree

#endif
