// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_profile_h
#define scree_geometry_profile_h

#include <scree/geometry/level_set.h>

#include <string>
#include <vector>

namespace scree
{
  /// The ground of a plane scene: a line through points with ascending x; the open is above it. Distances are exact.
  class Profile : public LevelSet<2>
  {
  public:
    /// @param points at least two, x strictly ascending, m; beyond them the ground goes on level
    explicit Profile(std::vector<dealii::Point<2>> points);

    /// See LevelSet::is_open().
    bool is_open(const dealii::Point<2> &x) const override;

    /// See LevelSet::view().
    SurfaceView<2> view(const dealii::Point<2> &x, const double reach) const override;

    /// Smallest x of the points, m.
    double first_x() const
    {
      return points.front()[0];
    }

    /// Largest x of the points, m.
    double last_x() const
    {
      return points.back()[0];
    }

  private:
    double height(const double x) const;

    /// The segment at a place along x: that between points s and s + 1.
    unsigned int segment_at(const double x) const;

    std::vector<dealii::Point<2>> points;
  };

  /// Reads the points "x, y", m, by read_number_table().
  Profile read_profile(const std::string &file, const std::string &where);
} // namespace scree

#endif
