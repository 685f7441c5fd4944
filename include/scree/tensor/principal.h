// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tensor_principal_h
#define scree_tensor_principal_h

#include <scree/simd/batch.h>
#include <scree/tensor/matrix.h>

#include <algorithm>

namespace scree
{
  /// Three principal values of a symmetric tensor, in no particular order; of one point or of a Batch.
  template <typename Number>
  using PrincipalNumbers = std::array<Number, 3>;
  using PrincipalValues  = PrincipalNumbers<double>; ///< principal values of one point

  /// Principal values of a symmetric tensor given by components, and the way back from the values of an isotropic
  /// function of it, which are equal where the tensor's are. Errors are of the order 1e-16 times the largest principal
  /// value, also where values coincide. A tensor that is not finite has values that are not.
  template <int dim, typename Number = double>
  class PrincipalFrame;


  /// Plane strain, closed form. The in-plane axes are kept as cosine and sine of twice their angle: all that
  /// composition needs.
  template <typename Number>
  class PrincipalFrame<2, Number>
  {
  public:
    PrincipalFrame() = default;

    /// Finds principal values and axes.
    /// @param tensor components, see tensor/components.h
    DEAL_II_ALWAYS_INLINE inline explicit PrincipalFrame(const Number *tensor)
    {
      const Number mean       = 0.5 * (tensor[0] + tensor[1]);
      const Number difference = 0.5 * (tensor[0] - tensor[1]);
      const Number radius     = simd::sqrt<Number>(difference * difference + tensor[3] * tensor[3]);
      const Number inverse    = 1. / simd::max<Number>(radius, simd::broadcast<Number>(1e-300));

      principal_values = { { mean + radius, mean - radius, tensor[2] } };
      cosine           = difference * inverse;
      sine             = tensor[3] * inverse;
    }

    /// The larger and the smaller value in the plane, then the one across it.
    const PrincipalNumbers<Number> &values() const
    {
      return principal_values;
    }

    /// Components of the tensor that has the principal values `values` along these axes.
    DEAL_II_ALWAYS_INLINE inline void compose(const PrincipalNumbers<Number> &values, Number *tensor) const
    {
      const Number mean   = 0.5 * (values[0] + values[1]);
      const Number radius = 0.5 * (values[0] - values[1]);
      tensor[0]           = mean + radius * cosine;
      tensor[1]           = mean - radius * cosine;
      tensor[2]           = values[2];
      tensor[3]           = radius * sine;
    }

  private:
    PrincipalNumbers<Number> principal_values;
    Number cosine, sine;
  };


  /// Three dimensions, without a loop whose length depends on the tensor. Of the deviator's three values the largest or
  /// the smallest is far from both others and is a well-conditioned root of the characteristic cubic; so is its
  /// projector, by Cayley and Hamilton a polynomial in the deviator. The two others, which may coincide, are those of
  /// what the deviator does in the plane across, as in plane strain: taken from the cubic they would lose half the
  /// digits where they come close, and elastic b_e = I + O(1e-3) always does.
  template <typename Number>
  class PrincipalFrame<3, Number>
  {
  public:
    PrincipalFrame() = default;

    /// Finds principal values and axes.
    /// @param tensor components, see tensor/components.h
    DEAL_II_ALWAYS_INLINE inline explicit PrincipalFrame(const Number *tensor)
    {
      const Number tiny = simd::broadcast<Number>(1e-290);
      const Number mean = (tensor[0] + tensor[1] + tensor[2]) * (1. / 3.);
      Number E[6], size = tiny; // the deviator, made of order 1
      for (unsigned int c = 0; c < 6; ++c)
        {
          E[c] = c < 3 ? tensor[c] - mean : tensor[c];
          size = simd::max<Number>(simd::abs<Number>(E[c]), size);
        }
      const Number inverse_size = 1. / size;
      for (Number &component : E)
        component *= inverse_size;

      Number squared[6];
      square_of_components(E, squared);
      const Number J2 = 0.5 * (squared[0] + squared[1] + squared[2]), J3 = determinant_of_components<3>(E);
      const Number half = simd::sqrt<Number>(J2 * (1. / 3.));
      const Number root =
          2. * half * triple_angle_cosine(simd::abs<Number>(J3) / simd::max<Number>(2. * half * half * half, tiny));
      const Number apart = simd::select<Number>(J3 < 0., -root, root);

      const Number scale = 1. / simd::max<Number>(3. * root * root - J2, tiny);
      Number square      = simd::broadcast<Number>(0.); // of the values across, twice
      for (unsigned int c = 0; c < 6; ++c)
        {
          const Number polynomial = squared[c] + apart * E[c];
          projector[c]            = (c < 3 ? polynomial + (root * root - J2) : polynomial) * scale;
          across[c]               = E[c] - 1.5 * apart * projector[c];
          if (c < 3)
            across[c] += 0.5 * apart;
          square += (c < 3 ? 1. : 2.) * (across[c] * across[c]);
        }
      const Number radius = simd::sqrt<Number>(0.5 * square);
      half_inverse_radius = 0.5 / simd::max<Number>(radius, simd::broadcast<Number>(1e-300));
      principal_values    = {
           { mean + size * apart, mean + size * (radius - 0.5 * apart), mean - size * (radius + 0.5 * apart) }
      };
    }

    /// The value farthest from the others, then the larger and the smaller of these.
    const PrincipalNumbers<Number> &values() const
    {
      return principal_values;
    }

    /// Components of the tensor that has the principal values `values` along these axes.
    DEAL_II_ALWAYS_INLINE inline void compose(const PrincipalNumbers<Number> &values, Number *tensor) const
    {
      const Number mean = 0.5 * (values[1] + values[2]), apart = values[0] - mean;
      const Number slope = (values[1] - values[2]) * half_inverse_radius;
      for (unsigned int c = 0; c < 6; ++c)
        {
          tensor[c] = apart * projector[c] + slope * across[c];
          if (c < 3)
            tensor[c] += mean;
        }
    }

  private:
    /// cos(a/3) for cos(a) = `cosine` from 0 to 1, root of 4 x^3 - 3 x = cos(a): a cubic to 3e-5, two steps of Newton's
    /// method.
    static Number triple_angle_cosine(const Number &cosine)
    {
      Number x = 0.8660579067720702 +
                 cosine * (0.16547529308917622 + cosine * (-0.04107021576600904 + cosine * 0.00956951871643108));
      for (unsigned int step = 0; step < 2; ++step)
        {
          const Number square = x * x;
          x                   = (8. * x * square + cosine) / (12. * square - 3.);
        }
      return x;
    }

    PrincipalNumbers<Number> principal_values; // first the one apart
    Number projector[6];                       // on its axis
    Number across[6];                          // the deviator in the plane across less its mean, of order 1
    Number half_inverse_radius;                // 1/2 over the size of its two values
  };
} // namespace scree

#endif
