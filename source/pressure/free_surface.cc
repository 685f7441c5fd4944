// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/free_surface.h>
#include <scree/mixture/closures.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    double distance_from_fill(const double fill)
    {
      return fill < 0.5 ? std::sqrt(2. * fill) - 1. : 1. - std::sqrt(2. * std::max(1. - fill, 0.));
    }
  } // namespace


  template <int dim>
  FreeSurfaceLocator<dim>::FreeSurfaceLocator(const BackgroundGrid<dim> &grid,
                                              const NodeNumbering<dim> &corners,
                                              const WaterBoundaryConditions<dim> &walls,
                                              const Tensor<1, dim> &gravity,
                                              const CutCells<dim> *cut_cells)
      : grid(grid)
      , corners(corners)
      , walls(walls)
      , down(gravity.norm() > 0. ? gravity / gravity.norm() : gravity)
      , cut_cells(cut_cells)
      , filling(corners)
      , neighbours(corners)
      , sides(corners)
  {
    reinit();
  }


  template <int dim>
  void FreeSurfaceLocator<dim>::reinit()
  {
    filling.reinit();
    neighbours.reinit();
    sides.reinit();
    const auto &nodes = *corners.partitioner();
    kinds.assign(nodes.locally_owned_size() + nodes.n_ghost_indices(), PressureDofType::dry);
    distances.assign(kinds.size(), -1.);
    if (cut_cells)
      find_closed();
  }


  template <int dim>
  void FreeSurfaceLocator<dim>::find_closed()
  {
    CornerVector volume(corners.partitioner()), cells(corners.partitioner());
    for (const CutCell<dim> &cut : cut_cells->cells())
      for (unsigned int v = 0; v < cut.n_corners; ++v)
        {
          const unsigned int corner = corners.nodes(cut.cell)[v];
          volume.local_element(corner) +=
              Utilities::fixed_power<dim>(grid.cell_size()) * (1. / cut.n_corners - cut.open_hats[v]);
          cells.local_element(corner) += 1. - cut.open_fraction;
        }
    const auto take = [&](CornerVector &vector, std::vector<double> &values) {
      vector.compress(VectorOperation::add);
      vector.update_ghost_values();
      values.resize(kinds.size());
      for (unsigned int corner = 0; corner < values.size(); ++corner)
        values[corner] = vector.local_element(corner);
    };
    take(volume, closed_volume);
    take(cells, closed_cells);

    std::array<std::vector<double>, dim> areas; // of the ground, m^(dim-1), along its outer normal
    for (unsigned int a = 0; a < dim; ++a)
      {
        CornerVector area(corners.partitioner());
        for (const CutFacet<dim> &segment : cut_cells->segments())
          for (unsigned int v = 0; v < CutCell<dim>::n_corners; ++v)
            area.local_element(corners.nodes(segment.cell)[v]) +=
                segment.vertex_weights[v] * segment.area * segment.normal[a];
        take(area, areas[a]);
      }
    // Level water that ends at the corner has (pi - 2 a)/(pi - a) of the ground below it, which falls by an angle a:
    // near the square of its cosine.
    full_ground.assign(kinds.size(), 0.);
    for (unsigned int corner = 0; corner < full_ground.size(); ++corner)
      {
        Tensor<1, dim> area;
        for (unsigned int a = 0; a < dim; ++a)
          area[a] = areas[a][corner];
        if (const double below = area * down; below > 0.)
          full_ground[corner] = (1. - volume_under(corner) / whole_volume(corner)) * below * below / area.norm_square();
      }
  }


  template <int dim>
  double FreeSurfaceLocator<dim>::fill_with_ground(const unsigned int corner, const double fill) const
  {
    const double *sums = filling[corner];
    if (full_ground.empty() || full_ground[corner] == 0. || sums[filled] <= 0.)
      return fill;
    // Soil that collapses would run too far.
    using closures::least_fill_above_ground, closures::least_solid_fraction;
    const double free = std::max(1. - (sums[filled] - sums[water]) / (least_solid_fraction * sums[filled]), 0.);
    return 1. - (1. - fill) * (1. - full_ground[corner] * free * std::min(fill / least_fill_above_ground, 1.));
  }


  template <int dim>
  double FreeSurfaceLocator<dim>::whole_volume(const unsigned int corner) const
  {
    return Utilities::fixed_power<dim>(grid.cell_size()) * cells_in_box(corner) / (1 << dim);
  }


  template <int dim>
  double FreeSurfaceLocator<dim>::volume_under(const unsigned int corner) const
  {
    const double whole = whole_volume(corner);
    return closed_volume.empty() ? whole
                                 : std::max(whole - closed_volume[corner],
                                            CutCells<dim>::smallest * Utilities::fixed_power<dim>(grid.cell_size()));
  }


  template <int dim>
  double FreeSurfaceLocator<dim>::volume_in_cell(const unsigned int cell, const unsigned int v) const
  {
    const CutCell<dim> *cut = cut_cells ? cut_cells->find(cell) : nullptr;
    return Utilities::fixed_power<dim>(grid.cell_size()) * (cut ? cut->open_hats[v] : 1. / (1 << dim));
  }


  template <int dim>
  double FreeSurfaceLocator<dim>::open_cells_around(const unsigned int corner) const
  {
    const double all = cells_in_box(corner);
    return closed_cells.empty() ? all : std::max(all - closed_cells[corner], closures::least_open_fraction);
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
  bool FreeSurfaceLocator<dim>::is_among_wet_cells(const unsigned int corner) const
  {
    return filling[corner][wet_cells] > (1. - 0.5 / (1 << dim)) * open_cells_around(corner);
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
          const double open =
              cut_cells ? std::max(cut_cells->open_fraction(cell.cell), closures::least_open_fraction) : 1.;
          for (unsigned int v = 0; v < cell.n_corners; ++v)
            {
              double *node = filling[nodes[v]];
              node[water] += cell.water_at_corner[v];
              node[filled] += cell.water_at_corner[v] + cell.effective_saturation * cell.grains_at_corner[v];
              if (cell.pore_volume > 0.)
                node[by_scatter] += cell.effective_saturation * cell.grains_at_corner[v] - cell.wet_grains_at(v);
              node[weighted_pressure] += cell.pressure_at_corner[v];
              node[weighted_forgotten] += cell.forgotten_at_corner[v];
              node[wet_cells] += open;
            }
        }
    for (const EnteringWater<dim> &entering : mixture.entering())
      for (unsigned int v = 0; v < entering.at_corner.size(); ++v)
        filling[corners.nodes(entering.cell)[v]][filled] += entering.at_corner[v];
    filling.add_contributions();
    // Where water comes to an end, as at a wetting front, what cells lack is no scatter.
    for (const unsigned int corner : filling.active_nodes())
      if (!is_among_wet_cells(corner))
        filling[corner][filled] -= filling[corner][by_scatter];
    filling.update_ghosts();
  }


  template <int dim>
  void FreeSurfaceLocator<dim>::locate(const Mixture<dim> &mixture, CornerVector &pressure)
  {
    for (const unsigned int corner : filling.active_nodes())
      {
        kinds[corner]                  = PressureDofType::dry;
        pressure.local_element(corner) = 0.;
      }
    sum_filling(mixture);
    const auto classify = [&](const unsigned int corner) {
      const double *sums = filling[corner];
      // Overfull cells next to empty ones must not hide the surface between them: without it p has no level.
      const double fill = std::min(sums[filled] / volume_under(corner), sums[wet_cells] / open_cells_around(corner));
      PressureDofType &kind = kinds[corner];
      distances[corner]     = distance_from_fill(fill_with_ground(corner, fill));
      kind                  = PressureDofType::dry;
      double value          = 0.;
      if (sums[wet_cells] > 0. && walls.prescribes_pressure(corners.faces(corner)))
        {
          kind  = PressureDofType::prescribed;
          value = walls.pressure(corners.faces(corner));
        }
      else if (sums[water] > 0. && distances[corner] >= closures::least_vertex_depth - 1e-9)
        {
          kind  = PressureDofType::unknown;
          value = pressure_of_points(corner);
        }
      pressure.local_element(corner) = value;
    };
    for_all_wet_corners(mixture, classify);
    close_gaps(mixture, pressure);

    // Kinds beside the surface: those with unknown neighbours, then those that have only those.
    neighbours.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        neighbours.activate_cell(cell.cell);
    const auto spread = [&](const PressureDofType source, const PressureDofType target) {
      for_pairs(mixture, PressureDofType::dry, source, [&](const unsigned int corner, const unsigned int neighbour) {
        neighbours[corner][number] += 1.;
        neighbours[corner][sum_of_distances] += depth(neighbour, corner);
      });
      neighbours.add_contributions();
      neighbours.update_ghosts();
      for_all_wet_corners(mixture, [&](const unsigned int corner) {
        if (kinds[corner] == PressureDofType::dry && neighbours[corner][number] > 0.)
          kinds[corner] = target;
      });
    };
    spread(PressureDofType::unknown, PressureDofType::surface);
    neighbours.clear_ghosts();
    spread(PressureDofType::surface, PressureDofType::beyond);
  }


  template <int dim>
  void FreeSurfaceLocator<dim>::close_gaps(const Mixture<dim> &mixture, CornerVector &pressure)
  {
    const auto may_be_in_gap = [&](const unsigned int corner) {
      const double *sums = filling[corner];
      return kinds[corner] == PressureDofType::dry && distances[corner] >= -1e-9 && sums[water] > 0. &&
             sums[filled] - sums[water] >= closures::least_solid_fraction * sums[filled];
    };
    const auto presses = [&](const unsigned int corner) { // Across a gap nothing pulls.
      return kinds[corner] == PressureDofType::unknown && pressure_of_points(corner) >= 0.;
    };
    sides.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        {
          const unsigned int *nodes = corners.nodes(cell.cell);
          if (std::none_of(nodes, nodes + cell.n_corners, may_be_in_gap))
            continue;
          sides.activate_cell(cell.cell);
          for (unsigned int v = 0; v < cell.n_corners; ++v)
            if (may_be_in_gap(nodes[v]))
              for (unsigned int a = 0; a < dim; ++a)
                if (presses(nodes[v ^ (1u << a)]))
                  sides[nodes[v]][2 * a + (v >> a & 1u)] += 1.;
        }
    sides.add_contributions();
    sides.update_ghosts();
    for_all_wet_corners(mixture, [&](const unsigned int corner) {
      if (!may_be_in_gap(corner))
        return;
      const double *of_corner = sides[corner];
      for (unsigned int a = 0; a < dim; ++a)
        if (of_corner[2 * a] > 0. && of_corner[2 * a + 1] > 0.)
          {
            kinds[corner]                  = PressureDofType::unknown;
            distances[corner]              = closures::least_vertex_depth;
            pressure.local_element(corner) = pressure_of_points(corner);
          }
    });
  }


  template <int dim>
  template <typename Function>
  void FreeSurfaceLocator<dim>::for_pairs(const Mixture<dim> &mixture,
                                          const PressureDofType kind,
                                          const PressureDofType kind_of_neighbour,
                                          const Function &act) const
  {
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        {
          const unsigned int *nodes = corners.nodes(cell.cell);
          for (unsigned int v = 0; v < cell.n_corners; ++v)
            if (kinds[nodes[v]] == kind)
              for (unsigned int w = 0; w < cell.n_corners; ++w)
                if (kinds[nodes[w]] == kind_of_neighbour &&
                    (kind_of_neighbour == PressureDofType::unknown || distances[nodes[w]] > 1e-6))
                  act(nodes[v], nodes[w]);
        }
  }


  template <int dim>
  void FreeSurfaceLocator<dim>::extrapolate(const Mixture<dim> &mixture, CornerVector &pressure)
  {
    const auto spread = [&](const PressureDofType source, const PressureDofType target) {
      neighbours.clear_ghosts();
      for (const unsigned int corner : neighbours.active_nodes())
        neighbours[corner][sum_of_pressures] = 0.;
      for_pairs(mixture, target, source, [&](const unsigned int corner, const unsigned int neighbour) {
        neighbours[corner][sum_of_pressures] += pressure.local_element(neighbour);
      });
      neighbours.add_contributions();
      neighbours.update_ghosts();
      for_all_wet_corners(mixture, [&](const unsigned int corner) {
        if (kinds[corner] != target)
          return;
        const double *sums = neighbours[corner];
        // The slope of a corner inside the water is bounded already, however near the surface it is.
        const double steep = target == PressureDofType::surface
                                 ? closures::steepest_extrapolation * sums[sum_of_distances] / sums[number]
                                 : std::numeric_limits<double>::infinity();
        pressure.local_element(corner) =
            std::max(distances[corner], -steep) * sums[sum_of_pressures] / sums[sum_of_distances];
      });
    };
    spread(PressureDofType::unknown, PressureDofType::surface);
    spread(PressureDofType::surface, PressureDofType::beyond);
  }

  template class FreeSurfaceLocator<2>;
  template class FreeSurfaceLocator<3>;
} // namespace scree
