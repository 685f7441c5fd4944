// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/free_surface.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Least depth of an unknown vertex, cells.
    constexpr double least_depth = 0.15;

    /// Dry soil about a vertex beside the water's surface, over the volume there: up to the first by the scatter of
    /// points, from the second on the surface lies in soil.
    constexpr double least_dry_soil = 0.1, surely_dry_soil = 0.25;

    double distance_from_fill(const double fill)
    {
      return fill < 0.5 ? std::sqrt(2. * fill) - 1. : 1. - std::sqrt(2. * std::max(1. - fill, 0.));
    }

    double fill_from_distance(const double distance)
    {
      return distance < 0. ? 0.5 * std::pow(1. + distance, 2) : 1. - 0.5 * std::pow(1. - distance, 2);
    }
  } // namespace


  template <int dim>
  FreeSurface<dim>::FreeSurface(const BackgroundGrid<dim> &grid,
                                const NodeNumbering<dim> &vertices,
                                const BoundaryConditions<dim> &walls,
                                const CutCells<dim> *cut_cells,
                                const double air_entry)
      : grid(grid)
      , vertices(vertices)
      , walls(walls)
      , cut_cells(cut_cells)
      , filling(vertices)
      , soil(vertices)
      , neighbours(vertices)
      , air_entry(air_entry)
  {
    reinit();
  }


  template <int dim>
  void FreeSurface<dim>::reinit()
  {
    filling.reinit();
    soil.reinit();
    neighbours.reinit();
    const auto &nodes = *vertices.partitioner();
    kinds.assign(nodes.locally_owned_size() + nodes.n_ghost_indices(), PressureDofType::dry);
    distances.assign(kinds.size(), -1.);
    unknown_vertices.clear();
    touched.clear();
    scratch.reinit(vertices.partitioner());
    if (has_suction())
      suction.reinit(vertices.partitioner());
    find_open();
  }


  template <int dim>
  void FreeSurface<dim>::find_open()
  {
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    VertexVector volume(vertices.partitioner()), cells(vertices.partitioner()); // closed
    if (cut_cells)
      for (const CutCell<dim> &cut : cut_cells->cells())
        for (unsigned int v = 0; v < cut.n_vertices; ++v)
          {
            const unsigned int vertex = vertices.nodes(cut.cell)[v];
            volume.local_element(vertex) += cell_volume * (1. / cut.n_vertices - cut.open_hats[v]);
            cells.local_element(vertex) += 1. - cut.open_fraction;
          }
    for (VertexVector *vector : { &volume, &cells })
      {
        vector->compress(VectorOperation::add);
        vector->update_ghost_values();
      }
    open.resize(kinds.size());
    for (unsigned int vertex = 0; vertex < open.size(); ++vertex)
      {
        unsigned int n_cells = 1 << dim; // in the box
        for (unsigned int faces = vertices.faces(vertex); faces != 0; faces &= faces - 1)
          n_cells /= 2;
        const double whole = cell_volume * n_cells / (1 << dim), closed = volume.local_element(vertex);
        open[vertex] = { std::max(whole - closed, CutCells<dim>::smallest * cell_volume),
                         std::max(n_cells - cells.local_element(vertex), closures::least_open_fraction),
                         closed < (1. - closures::least_open_fraction) * whole };
      }
  }


  template <int dim>
  double FreeSurface<dim>::volume_in_cell(const unsigned int cell, const unsigned int v) const
  {
    const CutCell<dim> *cut = cut_cells ? cut_cells->find(cell) : nullptr;
    return Utilities::fixed_power<dim>(grid.cell_size()) * (cut ? cut->open_hats[v] : 1. / (1 << dim));
  }


  template <int dim>
  void FreeSurface<dim>::sum_filling(const Mixture<dim> &mixture)
  {
    filling.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        {
          filling.activate_cell(cell.cell);
          const unsigned int *nodes = vertices.nodes(cell.cell);
          const double open =
              cut_cells ? std::max(cut_cells->open_fraction(cell.cell), closures::least_open_fraction) : 1.;
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            {
              double *node = filling[nodes[v]];
              node[water] += cell.water_at_vertex[v];
              node[filled] += cell.bulk_at_vertex[v];
              node[weighted_pressure] += cell.pressure_at_vertex[v];
              node[wet_cells] += open;
            }
        }
    filling.add_contributions();
    filling.update_ghosts();
    touched = filling.active_nodes();
    for (const MixtureCell<dim> &cell : mixture.cells())
      for (unsigned int v = 0; cell.water_volume > 0 && v < cell.n_vertices; ++v)
        if (const unsigned int vertex = vertices.nodes(cell.cell)[v]; vertex >= vertices.n_owned())
          touched.push_back(vertex);
  }


  template <int dim>
  void FreeSurface<dim>::find_soil_depths(Mixture<dim> &mixture)
  {
    soil.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.grain_volume > 0.)
        {
          soil.activate_cell(cell.cell);
          const double bulk = 1. + cell.pore_volume / cell.grain_volume;
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            soil[vertices.nodes(cell.cell)[v]][0] += bulk * cell.grains_at_vertex[v];
        }
    soil.add_contributions();
    soil.update_ghosts();
    for (MixtureCell<dim> &cell : mixture.cells())
      for (unsigned int v = 0; cell.grain_volume > 0. && v < cell.n_vertices; ++v)
        {
          const unsigned int vertex = vertices.nodes(cell.cell)[v];
          cell.soil_depths[v]       = distance_from_fill(soil[vertex][0] / volume_under(vertex));
        }
  }


  template <int dim>
  double FreeSurface<dim>::classify(const unsigned int vertex)
  {
    const double *sums = filling[vertex];
    // Overfull cells next to empty ones must not hide the surface between them: without it p has no level.
    const double fill = std::min(sums[filled] / open[vertex].volume, sums[wet_cells] / open[vertex].cells);
    distances[vertex] = distance_from_fill(fill);
    kinds[vertex]     = PressureDofType::dry;
    if (sums[wet_cells] > 0. && (walls.open_faces() & vertices.faces(vertex)) != 0)
      {
        kinds[vertex] = PressureDofType::prescribed;
        return walls.pressure(vertices.faces(vertex), vertices.position(vertex)[dim - 1]);
      }
    if (sums[water] > 0. && distances[vertex] >= least_depth - 1e-9 && open[vertex].has_room)
      {
        kinds[vertex] = PressureDofType::unknown;
        return sums[weighted_pressure] / sums[water];
      }
    return 0.;
  }


  template <int dim>
  typename FreeSurface<dim>::Followers FreeSurface<dim>::find_followers(const Mixture<dim> &mixture,
                                                                        const PressureDofType followed,
                                                                        const PressureDofType kind)
  {
    Followers group{ followed, {}, {} };
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        {
          const unsigned int *nodes = vertices.nodes(cell.cell);
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            for (unsigned int w = 0; w < cell.n_vertices && kinds[nodes[v]] == PressureDofType::dry; ++w)
              if (kinds[nodes[w]] == followed && (followed == PressureDofType::unknown || distances[nodes[w]] > 1e-6))
                {
                  group.pairs.emplace_back(nodes[v], nodes[w]);
                  neighbours[nodes[v]][number] += 1.;
                  neighbours[nodes[v]][sum_of_distances] += distances[nodes[w]];
                }
        }
    neighbours.add_contributions();
    neighbours.update_ghosts();
    for (const unsigned int vertex : touched)
      if (kinds[vertex] == kind || (kinds[vertex] == PressureDofType::dry && neighbours[vertex][number] > 0.))
        {
          kinds[vertex] = kind;
          group.vertices.push_back(vertex);
        }
    return group;
  }


  template <int dim>
  void FreeSurface<dim>::locate(const Mixture<dim> &mixture, VertexVector &pressure)
  {
    for (const unsigned int vertex : touched) // of the last step, ghosts too
      {
        kinds[vertex]                  = PressureDofType::dry;
        distances[vertex]              = -1.;
        pressure.local_element(vertex) = 0.;
      }
    sum_filling(mixture);
    for (const unsigned int vertex : touched)
      pressure.local_element(vertex) = classify(vertex);
    unknown_vertices.clear();
    for (const unsigned int vertex : filling.active_nodes())
      if (kinds[vertex] == PressureDofType::unknown)
        unknown_vertices.push_back(vertex);

    // Beside the surface: those with unknown neighbours, then those that have only those.
    neighbours.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        neighbours.activate_cell(cell.cell);
    followers[0] = find_followers(mixture, PressureDofType::unknown, PressureDofType::surface);
    neighbours.clear_ghosts();
    followers[1] = find_followers(mixture, PressureDofType::surface, PressureDofType::beyond);
    if (has_suction())
      find_suction();
  }


  template <int dim>
  void FreeSurface<dim>::find_suction()
  {
    // What extend() would give of a pressure that is 1 in all of the water.
    for (unsigned int vertex = 0; vertex < kinds.size(); ++vertex)
      suction.local_element(vertex) = kinds[vertex] == PressureDofType::unknown ? 1. : 0.;
    extend(suction);
    for (unsigned int vertex = 0; vertex < kinds.size(); ++vertex)
      {
        double &value        = suction.local_element(vertex);
        const bool is_beside = kinds[vertex] == PressureDofType::surface || kinds[vertex] == PressureDofType::beyond ||
                               kinds[vertex] == PressureDofType::dry;
        const double dry    = soil[vertex][0] / volume_under(vertex) - fill_from_distance(distances[vertex]);
        const double behind = std::clamp((dry - least_dry_soil) / (surely_dry_soil - least_dry_soil), 0., 1.);
        value               = is_beside ? -air_entry * behind * (1. - value) : 0.;
      }
  }


  template <int dim>
  void FreeSurface<dim>::clear(VertexVector &values) const
  {
    for (const unsigned int vertex : filling.active_nodes())
      values.local_element(vertex) = 0.;
    values.zero_out_ghost_values();
  }


  template <int dim>
  void FreeSurface<dim>::extend(VertexVector &pressure)
  {
    for (const Followers &group : followers)
      {
        for (const auto &pair : group.pairs)
          scratch.local_element(pair.first) += pressure.local_element(pair.second);
        scratch.compress(VectorOperation::add);
        scratch.update_ghost_values();
        for (const unsigned int vertex : group.vertices)
          pressure.local_element(vertex) = share(vertex) * scratch.local_element(vertex);
        for (const unsigned int vertex : group.vertices)
          scratch.local_element(vertex) = 0.;
        scratch.zero_out_ghost_values();
      }
  }


  template <int dim>
  void FreeSurface<dim>::extend(const std::vector<double> &unknown, VertexVector &pressure)
  {
    clear(pressure);
    for (unsigned int i = 0; i < unknown.size(); ++i)
      pressure.local_element(unknown_vertices[i]) = unknown[i];
    pressure.update_ghost_values();
    extend(pressure);
  }


  template <int dim>
  void FreeSurface<dim>::restrict_to_unknown(VertexVector &sums, std::vector<double> &result, const Shares shares)
  {
    sums.compress(VectorOperation::add);
    for (unsigned int g = followers.size(); g-- > 0;)
      {
        const Followers &group = followers[g];
        sums.update_ghost_values();
        for (const auto &pair : group.pairs)
          {
            const double part = share(pair.first);
            scratch.local_element(pair.second) +=
                (shares == Shares::squared ? part * part : part) * sums.local_element(pair.first);
          }
        sums.zero_out_ghost_values();
        scratch.compress(VectorOperation::add);
        for (const unsigned int vertex : filling.active_nodes())
          if (kinds[vertex] == group.followed)
            {
              sums.local_element(vertex) += scratch.local_element(vertex);
              scratch.local_element(vertex) = 0.;
            }
      }
    take(sums, result);
  }

  template class FreeSurface<2>;
  template class FreeSurface<3>;
} // namespace scree
