// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tests_unit_grid_box_h
#define scree_tests_unit_grid_box_h

#include <scree/mesh/background_grid.h>

#include <string>
#include <vector>

/// A box from `lower` on all axes to the corner `upper`, m.
inline scree::GridParameters grid_box(const double lower,
                                      const std::vector<double> &upper,
                                      const double cell_size   = 0.1,
                                      const std::string &basis = "spline")
{
  scree::GridParameters parameters;
  parameters.lower_corner.assign(upper.size(), lower);
  parameters.upper_corner = upper;
  parameters.cell_size    = cell_size;
  parameters.basis        = basis;
  return parameters;
}

/// The same with the coordinate `upper` on each axis.
template <int dim>
scree::GridParameters
grid_box(const double lower, const double upper, const double cell_size = 0.1, const std::string &basis = "spline")
{
  return grid_box(lower, std::vector<double>(dim, upper), cell_size, basis);
}

#endif
