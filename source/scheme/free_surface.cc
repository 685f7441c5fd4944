// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/free_surface.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    enum Filling : unsigned int
    {
      water,
      filled,
      weighted_pressure,
      wet_cells
    };

    enum Neighbours : unsigned int
    {
      number,
      sum_of_distances,
      sum_of_pressures
    };

    double distance_from_fill(const double fill)
    {
      return fill < 0.5 ? std::sqrt(2. * fill) - 1. : 1. - std::sqrt(2. * std::max(1. - fill, 0.));
    }
  } // namespace


  template <int dim>
  FreeSurfaceLocator<dim>::FreeSurfaceLocator(const BackgroundGrid<dim> &grid,
                                              const NodeNumbering<dim> &corners,
                                              const WaterBoundaryConditions<dim> &walls,
                                              const FreeSurface rule)
      : grid(grid)
      , corners(corners)
      , walls(walls)
      , rule(rule)
      , filling(corners)
      , neighbours(corners)
  {
    reinit();
  }


  template <int dim>
  void FreeSurfaceLocator<dim>::reinit()
  {
    filling.reinit();
    neighbours.reinit();
    const auto &nodes = *corners.partitioner();
    kinds.assign(nodes.locally_owned_size() + nodes.n_ghost_indices(), CornerKind::dry);
    distances.assign(kinds.size(), -1.);
  }


  template <int dim>
  double FreeSurfaceLocator<dim>::hat_volume(const unsigned int corner) const
  {
    double volume = Utilities::fixed_power<dim>(grid.cell_size());
    for (unsigned int faces = corners.faces(corner); faces != 0; faces &= faces - 1)
      volume *= 0.5;
    return volume;
  }


  template <int dim>
  unsigned int FreeSurfaceLocator<dim>::cells_in_box(const unsigned int corner) const
  {
    unsigned int number = 1 << dim;
    for (unsigned int faces = corners.faces(corner); faces != 0; faces &= faces - 1)
      number /= 2;
    return number;
  }


  template <int dim>
  bool FreeSurfaceLocator<dim>::is_unknown(const unsigned int corner, const double fill) const
  {
    constexpr double least_depth = 0.25 - 1e-9; // cells
    switch (rule)
      {
      case FreeSurface::distance:
        return distances[corner] >= least_depth;
      case FreeSurface::half_full:
        return fill >= 0.5 - 1e-9;
      default: // all cells around it hold water
        return filling[corner][wet_cells] > cells_in_box(corner) - 0.5;
      }
  }


  template <int dim>
  void FreeSurfaceLocator<dim>::sum_filling(const Mixture<dim> &mixture)
  {
    filling.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        {
          filling.activate_cell(cell.cell);
          const unsigned int *nodes = corners.nodes(cell.cell);
          for (unsigned int v = 0; v < cell.n_corners; ++v)
            {
              double *node = filling[nodes[v]];
              node[water] += cell.water_at_corner[v];
              node[filled] += cell.water_at_corner[v] + cell.saturation * cell.grains_at_corner[v];
              node[weighted_pressure] += cell.pressure_at_corner[v];
              node[wet_cells] += 1.;
            }
        }
    filling.add_contributions();
    filling.update_ghosts();
  }


  template <int dim>
  void FreeSurfaceLocator<dim>::locate(const Mixture<dim> &mixture, CornerVector &pressure)
  {
    for (const unsigned int corner : filling.active_nodes())
      {
        kinds[corner]                  = CornerKind::dry;
        pressure.local_element(corner) = 0.;
      }
    sum_filling(mixture);
    const auto classify = [&](const unsigned int corner) {
      const double *sums = filling[corner];
      // Overfull cells next to empty ones must not hide the surface between them: without it p has no level.
      const double fill = std::min(sums[filled] / hat_volume(corner), sums[wet_cells] / cells_in_box(corner));
      CornerKind &kind  = kinds[corner];
      distances[corner] = distance_from_fill(fill);
      kind              = CornerKind::dry;
      double value      = 0.;
      if (sums[wet_cells] > 0. && walls.prescribes_pressure(corners.faces(corner)))
        {
          kind  = CornerKind::prescribed;
          value = walls.pressure(corners.faces(corner));
        }
      else if (sums[water] > 0. && is_unknown(corner, fill))
        {
          kind  = CornerKind::unknown;
          value = sums[weighted_pressure] / sums[water];
        }
      pressure.local_element(corner) = value;
    };
    for_all_wet_corners(mixture, classify);
    if (rule != FreeSurface::distance)
      return;

    neighbours.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        {
          neighbours.activate_cell(cell.cell);
          const unsigned int *nodes = corners.nodes(cell.cell);
          for (unsigned int v = 0; v < cell.n_corners; ++v)
            if (kinds[nodes[v]] == CornerKind::dry)
              for (unsigned int w = 0; w < cell.n_corners; ++w)
                if (kinds[nodes[w]] == CornerKind::unknown)
                  {
                    neighbours[nodes[v]][number] += 1.;
                    neighbours[nodes[v]][sum_of_distances] += depth(nodes[w], nodes[v]);
                  }
        }
    neighbours.add_contributions();
    neighbours.update_ghosts();
    for_all_wet_corners(mixture, [&](const unsigned int corner) {
      if (kinds[corner] == CornerKind::dry && neighbours[corner][number] > 0.)
        kinds[corner] = CornerKind::surface;
    });
  }


  template <int dim>
  void FreeSurfaceLocator<dim>::extrapolate(const Mixture<dim> &mixture, CornerVector &pressure)
  {
    if (rule != FreeSurface::distance)
      return;
    neighbours.clear_ghosts();
    for (const unsigned int corner : neighbours.active_nodes())
      neighbours[corner][sum_of_pressures] = 0.;
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        {
          const unsigned int *nodes = corners.nodes(cell.cell);
          for (unsigned int v = 0; v < cell.n_corners; ++v)
            if (kinds[nodes[v]] == CornerKind::surface)
              for (unsigned int w = 0; w < cell.n_corners; ++w)
                if (kinds[nodes[w]] == CornerKind::unknown)
                  neighbours[nodes[v]][sum_of_pressures] += pressure.local_element(nodes[w]);
        }
    neighbours.add_contributions();
    neighbours.update_ghosts();
    for_all_wet_corners(mixture, [&](const unsigned int corner) {
      if (kinds[corner] != CornerKind::surface)
        return;
      const double *sums             = neighbours[corner];
      const double ratio             = std::max(distances[corner] * sums[number] / sums[sum_of_distances], -steepest);
      pressure.local_element(corner) = ratio * sums[sum_of_pressures] / sums[number];
    });
  }

  template class FreeSurfaceLocator<2>;
  template class FreeSurfaceLocator<3>;
} // namespace scree
