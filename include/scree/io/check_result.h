// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_check_result_h
#define scree_io_check_result_h

#include <string>
#include <vector>

namespace scree
{
  /// What a run has found in a check of itself.
  struct CheckResult
  {
    std::string text;         ///< name and worst value, in words
    std::string bound;        ///< what a sound run does not exceed, in words; empty: the value is for information
    bool is_exceeded = false; ///< whether the bound is
    std::string where;        ///< point, place and time of the worst value; may be empty

    /// Saves or loads all of it (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &text &bound &is_exceeded &where;
    }
  };

  /// A number with three digits.
  std::string short_text(const double value);

  /// The lines `Checks`: values out of bounds with their bounds and places, then the others.
  std::string verdict(const std::vector<CheckResult> &results);
} // namespace scree

#endif
