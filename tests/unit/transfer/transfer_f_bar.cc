// SPDX-License-Identifier: LGPL-2.1-or-later
// F-bar of a cell whose points are compressed, under tension or free of stress. With the modified one, points under
// stress get one trial J_e, V/J_e of each stays, and the sum of their volumes follows their own changes. Points without
// stress keep their own change of volume.

#include <scree/transfer/f_bar.h>

#include <scree/tensor/matrix.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <vector>

#include "../unit_test.h"

namespace test_transfer_f_bar
{
using namespace scree;

template <int dim>
void test(const unsigned int n_points)
{
  constexpr unsigned int n_components = n_symmetric_components<dim>;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> between(0., 1.);
  std::vector<double> elastic(n_points * n_components), stress(n_points * n_components, 0.);
  MaterialPoints<dim> points;
  points.n_points          = n_points;
  points.stride            = n_components;
  points.left_cauchy_green = elastic.data();
  points.stress            = stress.data();
  BlockMotion<dim> motion;
  motion.resize(n_points);
  const auto has_stress = [](const unsigned int p) { return p % 3 != 1; };
  std::vector<double> own_change(n_points);
  double own_volume = 0;
  for (unsigned int p = 0; p < n_points; ++p)
    {
      // Elastic compression or tension under stress, else a gap of up to e^0.6.
      const double ratio = std::exp(has_stress(p) ? 0.02 * between(generator) - 0.01 : 0.6 * between(generator));
      for (unsigned int c = 0; c < 3; ++c)
        elastic[p * n_components + c] = std::pow(ratio, 2. / 3.) * (1. + 0.1 * c);
      if (has_stress(p))
        stress[p * n_components + p % 3] = -1e3;
      motion.volume[p]        = between(generator) + 0.1;
      motion.volume_change[p] = own_change[p] = 1. + 0.1 * between(generator);
      motion.out_of_plane_stretch[p]          = 1.;
      for (unsigned int c = 0; c < dim * dim; ++c)
        motion.deformation_increment[c * motion.pitch + p] =
            c % (dim + 1) == 0 ? std::pow(own_change[p], 1. / dim) : 0.;
      own_volume += has_stress(p) ? motion.volume[p] * own_change[p] : 0.;
    }
  apply_f_bar(FBar::modified, 0, points, motion);
  double volume = 0, least = 1e300, largest = 0, moved_unloaded = 0, own_kept = 0;
  for (unsigned int p = 0; p < n_points; ++p)
    {
      double increment = dim == 2 ? motion.out_of_plane_stretch[p] : 1.; // det dF, a diagonal matrix
      for (unsigned int a = 0; a < dim; ++a)
        increment *= motion.deformation_increment[a * (dim + 1) * motion.pitch + p];
      const double ratio = std::sqrt(determinant_of_components<dim>(&elastic[p * n_components]));
      const double trial = ratio * increment, change = motion.volume_change[p];
      if (has_stress(p))
        {
          least   = std::min(least, trial);
          largest = std::max(largest, trial);
          volume += motion.volume[p] * change;
          moved_unloaded = std::max(moved_unloaded, std::abs(change / trial * ratio - 1));
        }
      else
        own_kept =
            std::max({ own_kept, std::abs(change / own_change[p] - 1), std::abs(increment / own_change[p] - 1) });
    }
  std::cout << dim << "D, " << n_points << " points: V/J_e kept " << (moved_unloaded < 1e-14) << ", one J_e "
            << (largest / least - 1 < 1e-14) << ", volume kept " << (std::abs(volume / own_volume - 1) < 1e-14)
            << ", own change without stress " << (own_kept < 1e-14) << std::endl;
}


void run()
{
  for (const unsigned int n_points : { 2, 7, 16, 33 })
    {
      test<2>(n_points);
      test<3>(n_points);
    }
}

const UnitTest registered("transfer_f_bar", run);
} // namespace test_transfer_f_bar


// Output:
// 2D, 2 points: V/J_e kept 1, one J_e 1, volume kept 1, own change without stress 1
// 3D, 2 points: V/J_e kept 1, one J_e 1, volume kept 1, own change without stress 1
// 2D, 7 points: V/J_e kept 1, one J_e 1, volume kept 1, own change without stress 1
// 3D, 7 points: V/J_e kept 1, one J_e 1, volume kept 1, own change without stress 1
// 2D, 16 points: V/J_e kept 1, one J_e 1, volume kept 1, own change without stress 1
// 3D, 16 points: V/J_e kept 1, one J_e 1, volume kept 1, own change without stress 1
// 2D, 33 points: V/J_e kept 1, one J_e 1, volume kept 1, own change without stress 1
// 3D, 33 points: V/J_e kept 1, one J_e 1, volume kept 1, own change without stress 1
