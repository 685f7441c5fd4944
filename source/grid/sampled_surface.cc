// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/grid/sampled_surface.h>
#include <scree/input/input_error.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace scree
{
  using namespace dealii;

  template <int dim>
  SampledSurface<dim>::SampledSurface(const BackgroundGrid<dim> &grid, const LevelSet<dim> &surface)
      : grid(grid)
      , surface(surface)
  {
    reinit();
  }


  template <int dim>
  void SampledSurface<dim>::reinit()
  {
    entry_of_cell.assign(grid.triangulation().n_active_cells(), none);
    corners.clear();
    least.clear();
    on_all_ranks(grid.triangulation().get_communicator(), [&] { sample(); });
  }


  template <int dim>
  void SampledSurface<dim>::sample()
  {
    const double width = grid.cell_size(), near = reach(), far = near + std::sqrt(dim) * width;
    const CellsOfBox<dim> &box = grid.fine_cells().box();
    std::unordered_map<std::uint64_t, SurfaceView<dim>> seen; // corners are shared by cells
    for (const auto &cell : grid.fine_cells().cells())
      {
        if (!grid.fine_cells().is_owned(cell))
          continue;
        Point<dim> middle = box.corner(cell.place);
        for (unsigned int a = 0; a < dim; ++a)
          middle[a] += 0.5 * width;
        if (std::abs(surface.view(middle, far).distance) >= far)
          continue;
        Corners of_cell;
        double smallest = far, largest = -far;
        for (unsigned int v = 0; v < n_corners; ++v)
          {
            CellPlace<dim> place = cell.place;
            for (unsigned int a = 0; a < dim; ++a)
              place[a] += v >> a & 1;
            const auto [corner, is_new] = seen.emplace(curve_number<dim>(place), SurfaceView<dim>());
            if (is_new)
              corner->second = surface.view(box.corner(place), far);
            of_cell[v] = corner->second;
            smallest   = std::min(smallest, of_cell[v].distance);
            largest    = std::max(largest, of_cell[v].distance);
          }
        if (smallest > near || largest < -near)
          continue;
        entry_of_cell[cell.index] = corners.size();
        corners.push_back(of_cell);
        least.push_back(smallest);
      }
  }


  template <int dim>
  SurfaceView<dim> SampledSurface<dim>::view(const unsigned int cell, const Point<dim> &place) const
  {
    const Corners &of_cell = corners[entry_of_cell[cell]];
    SurfaceView<dim> result{};
    for (unsigned int v = 0; v < n_corners; ++v)
      {
        double weight = 1.;
        for (unsigned int a = 0; a < dim; ++a)
          weight *= v >> a & 1 ? place[a] : 1. - place[a];
        result.distance += weight * of_cell[v].distance;
        result.normal += weight * of_cell[v].normal;
      }
    const double size = result.normal.norm();
    if (size > 0.)
      result.normal /= size;
    return result;
  }

  template class SampledSurface<2>;
  template class SampledSurface<3>;
} // namespace scree
