// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_level_set_h
#define scree_geometry_level_set_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

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

  /// Several rigid surfaces as one: what is inside any of them is inside.
  template <int dim>
  class JoinedSurface : public LevelSet<dim>
  {
  public:
    /// @param parts at least one; they must live on
    explicit JoinedSurface(std::vector<const LevelSet<dim> *> parts)
        : parts(std::move(parts))
    {
    }

    bool is_open(const dealii::Point<dim> &x) const override
    {
      return std::all_of(parts.begin(), parts.end(), [&](const LevelSet<dim> *part) { return part->is_open(x); });
    }

    /// The part that is nearest, or deepest around `x`: a distance outside, inside several of them less than that.
    SurfaceView<dim> view(const dealii::Point<dim> &x, const double reach) const override
    {
      SurfaceView<dim> nearest = parts[0]->view(x, reach);
      for (unsigned int i = 1; i < parts.size(); ++i)
        if (const SurfaceView<dim> other = parts[i]->view(x, reach); other.distance < nearest.distance)
          nearest = other;
      return nearest;
    }

  private:
    const std::vector<const LevelSet<dim> *> parts;
  };

  /// The corners of a triangle in space, m.
  using Triangle = std::array<dealii::Point<3>, 3>;

  /// A place of a triangle, and which part of it holds the place.
  struct PlaceOfTriangle
  {
    dealii::Point<3> place; ///< m
    unsigned int part;      ///< 0: the inside; 1 + i: the edge from corner i to the next one; 4 + i: corner i
  };

  /// The place of a triangle that is nearest to `x` (@source{ericson2005}, section 5.1.5).
  PlaceOfTriangle nearest_place(const dealii::Point<3> &x, const Triangle &corners);

  /// Normal of a triangle, twice as long as its area, m^2; corners are counter-clockwise seen from where it points.
  dealii::Tensor<1, 3> across(const Triangle &corners);
} // namespace scree

#endif
