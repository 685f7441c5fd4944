// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/rigid_boundary.h>

#include <algorithm>
#include <limits>

namespace scree
{
  using namespace dealii;

  template <int dim>
  RigidBoundary<dim>::RigidBoundary(const std::vector<GroundPart<dim>> &parts)
      : all_parts(parts)
      , any_moves(std::any_of(parts.begin(), parts.end(), [](const GroundPart<dim> &part) {
        return part.velocity != nullptr;
      }))
  {
  }


  template <int dim>
  bool RigidBoundary<dim>::moves_near(const unsigned int cell) const
  {
    return any_moves && std::any_of(all_parts.begin(), all_parts.end(), [cell](const GroundPart<dim> &part) {
             return part.velocity != nullptr && part.samples->is_near(cell);
           });
  }


  template <int dim>
  unsigned int RigidBoundary<dim>::n_near(const unsigned int cell) const
  {
    return std::count_if(all_parts.begin(), all_parts.end(), [cell](const GroundPart<dim> &part) {
      return part.samples->is_near(cell);
    });
  }


  template <int dim>
  double RigidBoundary<dim>::least_distance(const unsigned int cell) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const GroundPart<dim> &part : all_parts)
      least = std::min(least, part.samples->least_distance(cell));
    return least;
  }


  template <int dim>
  unsigned int RigidBoundary<dim>::nearest_part(const unsigned int cell, const Point<dim> &place) const
  {
    unsigned int nearest = 0;
    double distance      = std::numeric_limits<double>::infinity();
    for (unsigned int p = 0; p < all_parts.size(); ++p)
      if (all_parts[p].samples->is_near(cell))
        if (const double of_part = all_parts[p].samples->view(cell, place).distance; of_part < distance)
          {
            distance = of_part;
            nearest  = p;
          }
    return nearest;
  }


  template <int dim>
  SurfaceView<dim> RigidBoundary<dim>::view(const unsigned int cell, const Point<dim> &place) const
  {
    const unsigned int part = all_parts.size() == 1 ? 0 : nearest_part(cell, place);
    return all_parts[part].samples->view(cell, place);
  }

  template <int dim>
  Batch RigidBoundary<dim>::distances(const unsigned int cell, const std::array<Batch, dim> &places) const
  {
    Batch nearest = simd::broadcast<Batch>(std::numeric_limits<double>::infinity());
    for (const GroundPart<dim> &part : all_parts)
      if (part.samples->is_near(cell))
        nearest = simd::min<Batch>(nearest, part.samples->distances(cell, places));
    return nearest;
  }


  template class RigidBoundary<2>;
  template class RigidBoundary<3>;
} // namespace scree
