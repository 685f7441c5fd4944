// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_seepage_damping_h
#define scree_initial_seepage_damping_h

#include <algorithm>
#include <limits>

namespace scree
{
  /// How far the conductivity of seepage follows the pressure in an iteration: less and less while the changes of the
  /// head do not fall. Soil that water crosses without filling it needs that.
  class SeepageDamping
  {
  public:
    /// The share of the way after an iteration with the largest change of the head, m.
    double share(const double change)
    {
      constexpr double progress = 0.9, factor = 0.7, least = 0.005;
      constexpr unsigned int patience = 5; // iterations without progress
      n_without                       = change < progress * best ? 0 : n_without + 1;
      if (n_without == 0 || n_without == patience)
        best = change;
      if (n_without == patience)
        {
          current   = std::max(least, factor * current);
          n_without = 0;
        }
      return current;
    }

  private:
    double current         = 0.5;
    double best            = std::numeric_limits<double>::max(); // m
    unsigned int n_without = 0;
  };
} // namespace scree

#endif
