// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_material_law_h
#define scree_material_law_h

#include <scree/material/material.h>
#include <scree/tensor/principal.h>

namespace scree
{
  /// What a return map did to the trial strain.
  ///
  /// A law is a class with the members of LinearElastic, all in principal values: logarithmic elastic strain and
  /// Kirchhoff stress (Pa), tension positive. HenckyMaterial makes a Material of it.
  enum class Response
  {
    elastic, ///< The trial strain stands
    plastic  ///< The strain was changed
  };
} // namespace scree

#endif
