// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_model_places_of_points_h
#define scree_model_places_of_points_h

#include <scree/mesh/occupied_blocks.h>
#include <scree/case/parameters.h>

namespace scree
{
  /// Where the case puts points at the start. Refers to the parameters.
  template <int dim>
  PlacesOfPoints<dim> places_of_points(const Parameters &parameters);
} // namespace scree

#endif
