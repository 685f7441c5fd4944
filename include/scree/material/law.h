// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_material_law_h
#define scree_material_law_h

#include <scree/material/material.h>

#include <array>
#include <string>

namespace scree
{
  /// Three principal values, of the logarithmic elastic strain or of the Kirchhoff stress (Pa); tension positive.
  using PrincipalValues = std::array<double, 3>;

  /// What a return map did to the trial strain.
  enum class Response
  {
    elastic, ///< The trial strain stands
    plastic  ///< The strain was changed
  };

  /// Throws dealii::ExcMessage "subsection, entry, value: remedy" unless `possible`.
  void require(const bool possible,
               const std::string &subsection,
               const std::string &entry,
               const double value,
               const std::string &remedy);
} // namespace scree

#endif
