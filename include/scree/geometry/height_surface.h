// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_height_surface_h
#define scree_geometry_height_surface_h

#include <scree/geometry/level_set.h>
#include <scree/geometry/raster.h>

namespace scree
{
  /// The ground of a scene in space: the heights of a raster, joined by two triangles for each four of them. The open
  /// is above it, and where a height is missing; the ground ends there in vertical walls. Distances are exact.
  class HeightSurface : public LevelSet<3>
  {
  public:
    /// @param raster heights, m, at least 2 x 2
    explicit HeightSurface(Raster raster);

    /// See LevelSet::is_open().
    bool is_open(const dealii::Point<3> &x) const override;

    /// See LevelSet::view().
    SurfaceView<3> view(const dealii::Point<3> &x, const double reach) const override;
    std::string remark() const override;

  private:
    /// Whether the four heights from a column and a row on are known.
    bool has_ground(const unsigned int column, const unsigned int row) const;

    /// Height of the ground, m; NaN where it is missing.
    double height(const double x, const double y) const;

    dealii::Point<3> node(const unsigned int column, const unsigned int row) const;

    const Raster raster;
  };
} // namespace scree

#endif
