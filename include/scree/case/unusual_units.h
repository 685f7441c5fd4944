// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_unusual_units_h
#define scree_case_unusual_units_h

#include <scree/bodies/soil_body.h>
#include <scree/case/parameters.h>

#include <list>
#include <string>
#include <vector>

namespace scree
{
  /// A question about each value that is possible, but usual in another unit only (angles in radians, moduli in MPa),
  /// about each base that is stronger than the soil on it, and about a water table above all soil. Collective.
  template <int dim>
  std::vector<std::string>
  unusual_values(const Parameters &parameters, const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator);
} // namespace scree

#endif
