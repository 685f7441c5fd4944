// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/joined_surface.h>

#include <algorithm>
#include <utility>

namespace scree
{
  using namespace dealii;

  template <int dim>
  JoinedSurface<dim>::JoinedSurface(std::vector<const LevelSet<dim> *> parts)
      : parts(std::move(parts))
  {
  }


  template <int dim>
  bool JoinedSurface<dim>::is_open(const Point<dim> &x) const
  {
    return std::all_of(parts.begin(), parts.end(), [&](const LevelSet<dim> *part) { return part->is_open(x); });
  }


  template <int dim>
  SurfaceView<dim> JoinedSurface<dim>::view(const Point<dim> &x, const double reach) const
  {
    SurfaceView<dim> nearest = parts[0]->view(x, reach);
    for (unsigned int i = 1; i < parts.size(); ++i)
      if (const SurfaceView<dim> other = parts[i]->view(x, reach); other.distance < nearest.distance)
        nearest = other;
    return nearest;
  }

  template class JoinedSurface<2>;
  template class JoinedSurface<3>;
} // namespace scree
