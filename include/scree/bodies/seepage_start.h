// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_seepage_start_h
#define scree_bodies_seepage_start_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// Entries of subsection Water for a start from steady seepage.
  struct SeepageStart
  {
    bool is_steady         = false; ///< whether the pressure in soil is that of steady flow
    std::string wall_heads = "";    ///< `Left: 12, Right: 4`, m; empty: none

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations with other entries of subsection Water.
    /// @param phreatic entry and value of a phreatic surface; empty: not given
    void check(const unsigned int n_bodies,
               const std::pair<std::string, std::string> &phreatic,
               const std::string &reservoir_level,
               const std::string &initial_pressure) const;

    /// Throws EntryError if a head at a wall is not in the box.
    void check_heads(const std::vector<double> &lower, const std::vector<double> &upper) const;

    /// Names of walls and heads, m. Throws EntryError if the text does not read.
    std::vector<std::pair<std::string, double>> heads() const;
  };
} // namespace scree

#endif
