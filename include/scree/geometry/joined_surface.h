// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_geometry_joined_surface_h
#define scree_geometry_joined_surface_h

#include <scree/geometry/level_set.h>

#include <vector>

namespace scree
{
  /// Several rigid surfaces as one: what is inside any of them is inside.
  template <int dim>
  class JoinedSurface : public LevelSet<dim>
  {
  public:
    /// @param parts at least one; they must live on
    explicit JoinedSurface(std::vector<const LevelSet<dim> *> parts);

    bool is_open(const dealii::Point<dim> &x) const override;

    /// The part that is nearest, or deepest around `x`: a distance outside, inside several of them less than that.
    SurfaceView<dim> view(const dealii::Point<dim> &x, const double reach) const override;

  private:
    const std::vector<const LevelSet<dim> *> parts;
  };
} // namespace scree

#endif
