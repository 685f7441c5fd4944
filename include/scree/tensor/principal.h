// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_tensor_principal_h
#define scree_tensor_principal_h

#include <scree/tensor/components.h>

#include <array>
#include <algorithm>
#include <cmath>

namespace scree
{
  /// Three principal values of a symmetric tensor, in no particular order.
  using PrincipalValues = std::array<double, 3>;

  /// Principal values and axes of a symmetric tensor given by components; the axes also turn other principal values
  /// into components. Errors are of the order 1e-16 times the largest principal value, also where values coincide.
  template <int dim>
  class PrincipalFrame;


  /// Plane strain, closed form. The in-plane axes are kept as cosine and sine of twice their angle: all that
  /// composition needs.
  template <>
  class PrincipalFrame<2>
  {
  public:
    explicit PrincipalFrame(const double *tensor)
    {
      const double mean       = 0.5 * (tensor[0] + tensor[1]);
      const double difference = 0.5 * (tensor[0] - tensor[1]);
      const double radius     = std::sqrt(difference * difference + tensor[3] * tensor[3]);

      principal_values = { { mean + radius, mean - radius, tensor[2] } };
      cosine           = radius > 0 ? difference / radius : 1;
      sine             = radius > 0 ? tensor[3] / radius : 0;
    }

    const PrincipalValues &values() const
    {
      return principal_values;
    }

    /// Components of the tensor with the principal values `values` along these axes.
    void compose(const PrincipalValues &values, double *tensor) const
    {
      const double mean   = 0.5 * (values[0] + values[1]);
      const double radius = 0.5 * (values[0] - values[1]);
      tensor[0]           = mean + radius * cosine;
      tensor[1]           = mean - radius * cosine;
      tensor[2]           = values[2];
      tensor[3]           = radius * sine;
    }

  private:
    PrincipalValues principal_values;
    double cosine, sine;
  };


  /// Three dimensions, cyclic Jacobi rotations (Golub & Van Loan 2013, 8.5): unlike the closed form it does not lose
  /// half the digits where principal values coincide, which elastic b_e = I + O(1e-3) always comes close to.
  template <>
  class PrincipalFrame<3>
  {
  public:
    explicit PrincipalFrame(const double *tensor)
    {
      double a[3][3] = { { tensor[0], tensor[3], tensor[4] },
                         { tensor[3], tensor[1], tensor[5] },
                         { tensor[4], tensor[5], tensor[2] } };
      // Below this the off-diagonals change no digit of the principal values.
      const double negligible =
          1e-17 * std::max(std::abs(tensor[0]), std::max(std::abs(tensor[1]), std::abs(tensor[2])));
      constexpr unsigned int largest_number_of_sweeps = 12;
      for (unsigned int sweep = 0; sweep < largest_number_of_sweeps; ++sweep)
        {
          if (std::abs(a[0][1]) + std::abs(a[0][2]) + std::abs(a[1][2]) <= negligible)
            break;
          rotate<0, 1, 2>(a);
          rotate<0, 2, 1>(a);
          rotate<1, 2, 0>(a);
        }
      principal_values = { { a[0][0], a[1][1], a[2][2] } };
    }

    const PrincipalValues &values() const
    {
      return principal_values;
    }

    /// Components of the tensor with the principal values `values` along these axes.
    void compose(const PrincipalValues &values, double *tensor) const
    {
      constexpr unsigned int rows[6]    = { 0, 1, 2, 0, 0, 1 };
      constexpr unsigned int columns[6] = { 0, 1, 2, 1, 2, 2 };
      for (unsigned int c = 0; c < 6; ++c)
        {
          tensor[c] = 0;
          for (unsigned int i = 0; i < 3; ++i)
            tensor[c] += values[i] * axes[rows[c]][i] * axes[columns[c]][i];
        }
    }

  private:
    /// Make a[p][q] zero; `o` is the third index.
    template <unsigned int p, unsigned int q, unsigned int o>
    void rotate(double (&a)[3][3])
    {
      if (a[p][q] == 0)
        return;
      const double difference = 0.5 * (a[q][q] - a[p][p]);
      const double root       = std::sqrt(difference * difference + a[p][q] * a[p][q]);
      const double tangent    = a[p][q] / (difference + std::copysign(root, difference));
      const double cosine     = 1 / std::sqrt(1 + tangent * tangent);
      const double sine       = tangent * cosine;

      a[p][p] -= tangent * a[p][q];
      a[q][q] += tangent * a[p][q];
      a[p][q] = a[q][p] = 0;
      const double a_op = a[o][p];
      a[o][p] = a[p][o] = cosine * a_op - sine * a[o][q];
      a[o][q] = a[q][o] = sine * a_op + cosine * a[o][q];
      for (auto &row : axes)
        {
          const double row_p = row[p];
          row[p]             = cosine * row_p - sine * row[q];
          row[q]             = sine * row_p + cosine * row[q];
        }
    }

    PrincipalValues principal_values;
    double axes[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  };
} // namespace scree

#endif
