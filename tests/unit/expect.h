// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tests_expect_h
#define scree_tests_expect_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <string>

/// Throws unless `value` is what was expected; not-a-number never is.
inline void expect(const double value, const double expected, const double tolerance, const std::string &what)
{
  using dealii::Utilities::to_string;
  AssertThrow(std::abs(value - expected) <= tolerance,
              dealii::ExcMessage(what + " is " + to_string(value) + " instead of " + to_string(expected)));
}

#endif
