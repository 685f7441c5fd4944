// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/discrete_level_set.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Of a place of the lattice; that of a surface that moves may lie outside the box.
    template <int dim>
    std::uint64_t key_of(const CellPlace<dim> &place)
    {
      constexpr unsigned int n_bits = 64 / dim;
      std::uint64_t key             = 0;
      for (const int number : place)
        key = key << n_bits | (static_cast<std::uint64_t>(number) & ((std::uint64_t(1) << n_bits) - 1));
      return key;
    }
  } // namespace


  template <int dim>
  DiscreteLevelSet<dim>::DiscreteLevelSet(const BackgroundGrid<dim> &grid,
                                          const LevelSet<dim> &surface,
                                          const SurfaceMotion motion)
      : grid(grid)
      , surface(surface)
      , motion(motion)
      , n_1d(is_moving() ? 3 : 2)
      , n_of_cell(Utilities::fixed_power<dim>(n_1d))
  {
    for (unsigned int a = 0; a < dim; ++a)
      strides[a] = a == 0 ? 1 : n_1d * strides[a - 1];
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        corner_offset[v] = 0;
        for (unsigned int a = 0; a < dim; ++a)
          corner_offset[v] += (v >> a & 1) * strides[a];
      }
    reinit();
  }


  template <int dim>
  const SurfaceView<dim> &DiscreteLevelSet<dim>::at_vertex(const CellPlace<dim> &corner)
  {
    const auto [entry, is_new] = seen.emplace(key_of<dim>(corner), SurfaceView<dim>());
    if (is_new)
      entry->second = surface.view(grid.fine_cells().box().corner(corner), reach() + std::sqrt(dim) * grid.cell_size());
    return entry->second;
  }


  template <int dim>
  void DiscreteLevelSet<dim>::sample()
  {
    const double width = grid.cell_size(), near = reach(), far = near + std::sqrt(dim) * width;
    for (const auto &cell : grid.fine_cells().cells())
      {
        if (!grid.fine_cells().is_owned(cell))
          continue;
        CellPlace<dim> first = cell.place, inner;
        for (unsigned int a = 0; a < dim; ++a)
          {
            first[a] -= whole_cells[a] + (is_moving() ? 1 : 0);
            inner[a] = first[a] + 1;
          }
        // The middle of the corners: with three along an axis that is a corner itself.
        Point<dim> middle = grid.fine_cells().box().corner(first);
        for (unsigned int a = 0; a < dim; ++a)
          middle[a] += 0.5 * width;
        const auto distance_of_middle = [&] {
          // A key that no corner of a surface at rest has.
          const auto [entry, is_new] = seen.emplace(~key_of<dim>(cell.place), SurfaceView<dim>());
          if (is_new)
            entry->second = surface.view(middle, far);
          return entry->second.distance;
        };
        if (std::abs(is_moving() ? at_vertex(inner).distance : distance_of_middle()) >= far)
          continue;
        const std::size_t begin = corners.size();
        double smallest = far, largest = -far;
        for (unsigned int v = 0; v < n_of_cell; ++v)
          {
            CellPlace<dim> place = first;
            for (unsigned int a = 0; a < dim; ++a)
              place[a] += v / strides[a] % n_1d;
            corners.push_back(at_vertex(place));
            smallest = std::min(smallest, corners.back().distance);
            largest  = std::max(largest, corners.back().distance);
          }
        if (smallest > near || largest < -near)
          {
            corners.resize(begin);
            continue;
          }
        entry_of_cell[cell.index] = least.size();
        least.push_back(smallest);
      }
  }


  template <int dim>
  SurfaceView<dim> DiscreteLevelSet<dim>::view(const unsigned int cell, const Point<dim> &place) const
  {
    const SurfaceView<dim> *of_cell = &corners[std::size_t(entry_of_cell[cell]) * n_of_cell];
    Point<dim> local                = place;
    if (is_moving())
      for (unsigned int a = 0; a < dim; ++a)
        {
          const bool is_upper = place[a] >= part_of_cell[a];
          of_cell += is_upper ? strides[a] : 0;
          local[a] += (is_upper ? 0. : 1.) - part_of_cell[a];
        }
    SurfaceView<dim> result{};
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        double weight = 1.;
        for (unsigned int a = 0; a < dim; ++a)
          weight *= v >> a & 1 ? local[a] : 1. - local[a];
        const SurfaceView<dim> &corner = of_cell[corner_offset[v]];
        result.distance += weight * corner.distance;
        result.normal += weight * corner.normal;
      }
    const double size = result.normal.norm();
    if (size > 0.)
      result.normal /= size;
    return result;
  }


  template <int dim>
  Batch DiscreteLevelSet<dim>::distances(const unsigned int cell, const std::array<Batch, dim> &places) const
  {
    // Hat functions along the axes at the lattice's corners; beyond it those of its outer cells go on.
    std::array<std::array<Batch, 3>, dim> hats;
    for (unsigned int a = 0; a < dim; ++a)
      if (is_moving())
        {
          const Batch from_middle = places[a] - part_of_cell[a], none{};
          hats[a][0]              = simd::max<Batch>(-from_middle, none);
          hats[a][1]              = 1. - simd::abs<Batch>(from_middle);
          hats[a][2]              = simd::max<Batch>(from_middle, none);
        }
      else
        {
          hats[a][0] = 1. - places[a];
          hats[a][1] = places[a];
        }
    const SurfaceView<dim> *corner = &corners[std::size_t(entry_of_cell[cell]) * n_of_cell];
    Batch sum{};
    for (unsigned int k = 0; k < (dim == 3 ? n_1d : 1); ++k)
      for (unsigned int j = 0; j < n_1d; ++j)
        {
          Batch line{};
          for (unsigned int i = 0; i < n_1d; ++i, ++corner)
            line += hats[0][i] * corner->distance;
          if constexpr (dim == 3)
            line *= hats[2][k];
          sum += hats[1][j] * line;
        }
    return sum;
  }

  template class DiscreteLevelSet<2>;
  template class DiscreteLevelSet<3>;


  template <int dim>
  RigidBoundary<dim>::RigidBoundary(const std::vector<GroundPart<dim>> &parts)
      : all_parts(parts)
      , any_moves(std::any_of(parts.begin(), parts.end(), [](const GroundPart<dim> &part) {
        return part.velocity != nullptr;
      }))
  {
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


  template class RigidBoundary<2>;
  template class RigidBoundary<3>;
} // namespace scree
