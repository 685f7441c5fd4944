// SPDX-License-Identifier: LGPL-2.1-or-later

#include <scree/material/law.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <sstream>

namespace scree
{
  void UpdateReport::add(const UpdateReport &other)
  {
    largest_bulk_modulus = std::max(largest_bulk_modulus, other.largest_bulk_modulus);
    largest_pressure     = std::max(largest_pressure, other.largest_pressure);
    plastic_dissipation += other.plastic_dissipation;
    n_updates += other.n_updates;
    n_substeps += other.n_substeps;
    n_fallbacks += other.n_fallbacks;
    n_vertices += other.n_vertices;
    n_separated += other.n_separated;
    n_unresolved += other.n_unresolved;
  }


  void require(const bool possible,
               const std::string &subsection,
               const std::string &entry,
               const double value,
               const std::string &remedy)
  {
    std::ostringstream message;
    message << "subsection " << subsection << ", entry \"" << entry << "\" = " << value << ": " << remedy << '.';
    AssertThrow(possible, dealii::ExcMessage(message.str()));
  }
} // namespace scree
