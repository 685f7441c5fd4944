// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/materials/material.h>

#include <algorithm>

namespace scree
{
  void UpdateReport::add(const UpdateReport &other)
  {
    largest_bulk_modulus = std::max(largest_bulk_modulus, other.largest_bulk_modulus);
    largest_compression  = std::max(largest_compression, other.largest_compression);
    plastic_dissipation += other.plastic_dissipation;
    n_updates += other.n_updates;
    n_substeps += other.n_substeps;
    n_fallbacks += other.n_fallbacks;
    n_vertices += other.n_vertices;
    n_separated += other.n_separated;
    n_unresolved += other.n_unresolved;
  }
} // namespace scree
