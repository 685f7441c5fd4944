// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_case_case_remarks_h
#define scree_case_case_remarks_h

#include <scree/bodies/soil_body.h>
#include <scree/case/parameters.h>

#include <list>
#include <string>
#include <vector>

namespace scree
{
  /// Lines for the log on entries that are possible, but without the effect that they suggest: bases stronger than the
  /// soil, shear bands that the cells do not resolve, laws that no body has, cohesion without tensile strength in
  /// water, water in other units, a water table above all soil. Collective.
  template <int dim>
  std::vector<std::string>
  remarks_on(const Parameters &parameters, const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator);
} // namespace scree

#endif
