// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tests_pattern_h
#define scree_tests_pattern_h

#include <deal.II/base/point.h>

#include <cmath>

/// A number from -1 to 1 that depends on the place only, and so is the same on all ranks.
template <int dim>
double pattern(const dealii::Point<dim> &x)
{
  double phase = 1.;
  for (unsigned int a = 0; a < dim; ++a)
    phase = 17. * std::sin(phase + 7. * x[a] * (a + 1));
  return std::sin(phase);
}

#endif
