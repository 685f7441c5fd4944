// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_surfaces_h
#define scree_geometry_surfaces_h

#include <scree/geometry/level_set.h>
#include <scree/geometry/raster.h>
#include <scree/input/expression.h>

#include <memory>
#include <string>
#include <vector>

namespace scree
{
  /// The surface on which an expression of the coordinates is 0; the open is where it is positive.
  ///
  /// It need not be a distance: the foot y of a place x on the surface is found from f(y) = 0 and x - y along grad f(y)
  /// (@source{chopp2001}). Where that fails, at an edge, the distance is f/|grad f| at x.
  template <int dim>
  class ExpressionSurface : public LevelSet<dim>
  {
  public:
    /// @param where entry_name(), for messages
    /// @param length of what the mesh resolves, m
    ExpressionSurface(const std::string &where, const std::string &expression, const double length);

    /// Both throw ValueError if the expression is no number there.
    bool is_open(const dealii::Point<dim> &x) const override;
    SurfaceView<dim> view(const dealii::Point<dim> &x, const double reach) const override;

  private:
    /// By central differences.
    dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &x) const;

    std::unique_ptr<Expression<dim>> function;
    const double length;
  };

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
