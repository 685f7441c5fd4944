// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tensor_logarithm_h
#define scree_tensor_logarithm_h

#include <scree/tensor/matrix.h>

#include <cmath>

namespace scree
{
  /// Logarithm of a symmetric positive definite tensor (components, three dimensions) without its eigenvectors, if its
  /// principal values differ by less than a fifth or so; returns false, and no result, if they differ by more.
  ///
  /// b = m (I + D) with the trace-free D: ln b = ln m I + D - D^2/2 + D^3/3 - ... . By Cayley and Hamilton
  /// D^3 = J_2 D + J_3 I, so that every power is a combination of I, D and D^2, and the series is one of scalars.
  inline bool logarithm_near_sphere(const double *b, double *result)
  {
    const double mean = (b[0] + b[1] + b[2]) / 3., inverse = 1. / mean;

    double D[6];
    for (unsigned int c = 0; c < 6; ++c)
      D[c] = (c < 3 ? b[c] - mean : b[c]) * inverse;

    double square[6]; // D^2
    square[0]       = D[0] * D[0] + D[3] * D[3] + D[4] * D[4];
    square[1]       = D[1] * D[1] + D[3] * D[3] + D[5] * D[5];
    square[2]       = D[2] * D[2] + D[4] * D[4] + D[5] * D[5];
    square[3]       = D[3] * (D[0] + D[1]) + D[4] * D[5];
    square[4]       = D[4] * (D[0] + D[2]) + D[3] * D[5];
    square[5]       = D[5] * (D[1] + D[2]) + D[3] * D[4];
    const double J2 = 0.5 * (square[0] + square[1] + square[2]);
    // Written so that not-a-number and negative means fall through, too.
    if (!(J2 < 1e-2 && mean > 0.))
      return false;
    const double J3 = determinant_of_components<3>(D);

    // D^n = i I + d D + s D^2; no principal value of D is above 0.116, so that the 17th term is below rounding.
    double i = 0., d = 1., s = 0., sum_i = 0., sum_d = 1., sum_s = 0.;
    for (unsigned int n = 2; n <= 16; ++n)
      {
        const double factor = (n % 2 == 0 ? -1. : 1.) / n;
        const double next_i = s * J3, next_d = i + s * J2, next_s = d;
        i = next_i, d = next_d, s = next_s;
        sum_i += factor * i;
        sum_d += factor * d;
        sum_s += factor * s;
      }

    const double log_mean = std::log(mean);
    for (unsigned int c = 0; c < 6; ++c)
      result[c] = sum_d * D[c] + sum_s * square[c] + (c < 3 ? log_mean + sum_i : 0.);
    return true;
  }
} // namespace scree

#endif
