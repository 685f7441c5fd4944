// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_tensor_hencky_h
#define scree_tensor_hencky_h

#include <scree/tensor/principal.h>

#include <deal.II/base/tensor.h>

namespace scree
{
  /// Principal logarithmic strains, 1/2 ln of the principal values of a left Cauchy-Green tensor.
  inline PrincipalValues log_strain(const PrincipalValues &left_cauchy_green)
  {
    return { { 0.5 * std::log(left_cauchy_green[0]),
               0.5 * std::log(left_cauchy_green[1]),
               0.5 * std::log(left_cauchy_green[2]) } };
  }

  /// Exponential map (Simo 1992): b = sum exp(2 strain_i) n_i n_i along the axes of `frame`.
  template <int dim>
  inline void left_cauchy_green_of(const PrincipalFrame<dim> &frame, const PrincipalValues &strain, double *result)
  {
    frame.compose({ { std::exp(2 * strain[0]), std::exp(2 * strain[1]), std::exp(2 * strain[2]) } }, result);
  }

  /// Trial b = f b f^T by components. In plane strain `out_of_plane_stretch` is f_zz.
  inline void trial_left_cauchy_green(const dealii::Tensor<2, 2> &f,
                                      const double out_of_plane_stretch,
                                      const double *b,
                                      double *result)
  {
    const double x_x = f[0][0] * b[0] + f[0][1] * b[3]; // (f b)_xx and so on
    const double x_y = f[0][0] * b[3] + f[0][1] * b[1];
    const double y_x = f[1][0] * b[0] + f[1][1] * b[3];
    const double y_y = f[1][0] * b[3] + f[1][1] * b[1];

    result[0] = x_x * f[0][0] + x_y * f[0][1];
    result[1] = y_x * f[1][0] + y_y * f[1][1];
    result[2] = out_of_plane_stretch * out_of_plane_stretch * b[2];
    result[3] = x_x * f[1][0] + x_y * f[1][1];
  }

  /// The same in three dimensions; the stretch is not read.
  inline void trial_left_cauchy_green(const dealii::Tensor<2, 3> &f, const double, const double *b, double *result)
  {
    const double full[3][3] = { { b[0], b[3], b[4] }, { b[3], b[1], b[5] }, { b[4], b[5], b[2] } };
    double product[3][3];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        product[i][j] = f[i][0] * full[0][j] + f[i][1] * full[1][j] + f[i][2] * full[2][j];

    constexpr unsigned int rows[6]    = { 0, 1, 2, 0, 0, 1 };
    constexpr unsigned int columns[6] = { 0, 1, 2, 1, 2, 2 };
    for (unsigned int c = 0; c < 6; ++c)
      result[c] = product[rows[c]][0] * f[columns[c]][0] + product[rows[c]][1] * f[columns[c]][1] +
                  product[rows[c]][2] * f[columns[c]][2];
  }
} // namespace scree

#endif
