// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef scree_materials_softening_h
#define scree_materials_softening_h

#include <scree/materials/law_entries.h>

namespace scree
{
  /// Entries of a law whose strength falls from a peak to a residual value with plastic shear.
  struct SofteningParameters
  {
    double strain          = 0;  ///< kappa at which 1/e of the fall is left, -; 0: strength stays at the peak
    double cohesion        = -1; ///< residual, Pa; -1: that of the peak
    double friction_angle  = -1; ///< residual, degrees; -1: that of the peak
    double dilation_angle  = -1; ///< residual, degrees; -1: that of the peak
    double nonlocal_length = 0;  ///< l, m; 0: the strain of the point itself

    /// Whether strength depends on strain.
    bool is_active() const
    {
      return strain > 0;
    }

    /// The value after much strain of an entry with this value at the peak.
    static double residual(const double entry, const double peak)
    {
      return entry == as_peak ? peak : entry;
    }

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at entries without effect.
    void check(const std::string &subsection) const;

  private:
    static constexpr double as_peak = -1;
  };
} // namespace scree

#endif
