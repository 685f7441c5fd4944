// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_tests_random_numbers_h
#define scree_tests_random_numbers_h

#include <cmath>
#include <random>

/// The same numbers on every platform, which the distributions of the standard library do not promise.
class RandomNumbers
{
public:
  double uniform(const double low, const double high)
  {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  }

  double log_uniform(const double low, const double high)
  {
    return std::exp(uniform(std::log(low), std::log(high)));
  }

private:
  std::mt19937_64 engine{ 20240607 };
};

#endif
