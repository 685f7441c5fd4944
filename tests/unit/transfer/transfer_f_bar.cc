// SPDX-License-Identifier: LGPL-2.1-or-later
// F-bar of a cell whose points are compressed, free of stress or far apart: with the modified one the volume that the
// points would have without stress stays, all have one J_e, and the sum of volumes follows the points' own changes.

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
  constexpr double volume_factor      = 1.03;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> between(0., 1.);
  // A gap of up to e^0.6, beside elastic compression.
  const auto ratio = [&] { return std::exp(between(generator) < 0.5 ? 0.6 * between(generator) : -0.01); };

  std::vector<double> elastic(n_points * n_components), volumes(n_points);
  MaterialPoints<dim> points;
  points.n_points          = n_points;
  points.stride            = n_components;
  points.left_cauchy_green = elastic.data();
  BlockMotion<dim> motion;
  motion.resize(n_points);
  const auto unloaded = [&] {
    double sum = 0;
    for (unsigned int p = 0; p < n_points; ++p)
      sum += volumes[p] / std::sqrt(determinant_of_components<dim>(&elastic[p * n_components]));
    return sum;
  };
  double grown = 0;
  for (unsigned int p = 0; p < n_points; ++p)
    {
      const double stretch = std::pow(ratio(), 2. / 3.);
      for (unsigned int c = 0; c < 3; ++c)
        elastic[p * n_components + c] = stretch * (1. + 0.1 * c);
      volumes[p] = motion.volume[p] = between(generator) + 0.1;
      motion.volume_change[p]       = 1. + 0.1 * between(generator);
      for (unsigned int c = 0; c < dim * dim; ++c)
        motion.deformation_increment[c * motion.pitch + p] = c % (dim + 1) == 0 ? 1. : 0.;
      grown += volumes[p] * motion.volume_change[p];
    }
  const double before = unloaded();
  apply_f_bar(FBar::modified, 0, points, volume_factor, motion);
  double volume = 0, least = 1e300, largest = 0;
  for (unsigned int p = 0; p < n_points; ++p)
    {
      const double determinant = determinant_of_components<dim>(&elastic[p * n_components]);
      least                    = std::min(least, determinant);
      largest                  = std::max(largest, determinant);
      volume += volumes[p] * motion.volume_change[p];
    }
  std::cout << dim << "D, " << n_points << " points: unloaded volume kept "
            << (std::abs(unloaded() / before - 1) < 1e-14) << ", one J_e " << (largest / least - 1 < 1e-14)
            << ", volume kept " << (std::abs(volume / (volume_factor * grown) - 1) < 1e-14) << std::endl;
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
