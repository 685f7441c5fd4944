// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_level_set_h
#define scree_geometry_level_set_h

#include <deal.II/base/point.h>

#include <string>

namespace scree
{
  /// A rigid surface as it is seen from a place.
  template <int dim>
  struct SurfaceView
  {
    double distance;               ///< m; positive in the open, negative inside
    dealii::Tensor<1, dim> normal; ///< unit, into the open
  };

  /// A rigid surface, as the signed distance from it.
  template <int dim>
  class LevelSet
  {
  public:
    virtual ~LevelSet() = default;

    /// Whether a place is in the open.
    virtual bool is_open(const dealii::Point<dim> &x) const = 0;

    /// The surface from `x`. Farther away than `reach`, m, the distance is only known to be at least `reach`, and the
    /// normal is any unit vector.
    virtual SurfaceView<dim> view(const dealii::Point<dim> &x, const double reach) const = 0;

    /// Remark on the surface for the log; empty: none.
    virtual std::string remark() const
    {
      return "";
    }
  };
} // namespace scree

#endif
