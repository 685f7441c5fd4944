// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/free_surface.h>
#include <scree/mixture/mixture.h>

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
    scratch.reinit(vertices.partitioner());
    if (has_suction())
      suction.reinit(vertices.partitioner());
    if (cut_cells)
      find_closed();
  }


  template <int dim>
  void FreeSurface<dim>::find_closed()
  {
    VertexVector volume(vertices.partitioner()), cells(vertices.partitioner());
    for (const CutCell<dim> &cut : cut_cells->cells())
      for (unsigned int v = 0; v < cut.n_vertices; ++v)
        {
          const unsigned int vertex = vertices.nodes(cut.cell)[v];
          volume.local_element(vertex) +=
              Utilities::fixed_power<dim>(grid.cell_size()) * (1. / cut.n_vertices - cut.open_hats[v]);
          cells.local_element(vertex) += 1. - cut.open_fraction;
        }
    const auto take = [&](VertexVector &vector, std::vector<double> &values) {
      vector.compress(VectorOperation::add);
      vector.update_ghost_values();
      values.resize(kinds.size());
      for (unsigned int vertex = 0; vertex < values.size(); ++vertex)
        values[vertex] = vector.local_element(vertex);
    };
    take(volume, closed_volume);
    take(cells, closed_cells);
  }


  template <int dim>
  double FreeSurface<dim>::whole_volume(const unsigned int vertex) const
  {
    return Utilities::fixed_power<dim>(grid.cell_size()) * cells_in_box(vertex) / (1 << dim);
  }


  template <int dim>
  double FreeSurface<dim>::volume_under(const unsigned int vertex) const
  {
    const double whole = whole_volume(vertex);
    return closed_volume.empty() ? whole
                                 : std::max(whole - closed_volume[vertex],
                                            CutCells<dim>::smallest * Utilities::fixed_power<dim>(grid.cell_size()));
  }


  template <int dim>
  bool FreeSurface<dim>::has_room(const unsigned int vertex) const
  {
    return closed_volume.empty() || closed_volume[vertex] < (1. - closures::least_open_fraction) * whole_volume(vertex);
  }


  template <int dim>
  double FreeSurface<dim>::volume_in_cell(const unsigned int cell, const unsigned int v) const
  {
    const CutCell<dim> *cut = cut_cells ? cut_cells->find(cell) : nullptr;
    return Utilities::fixed_power<dim>(grid.cell_size()) * (cut ? cut->open_hats[v] : 1. / (1 << dim));
  }


  template <int dim>
  double FreeSurface<dim>::open_cells_around(const unsigned int vertex) const
  {
    const double all = cells_in_box(vertex);
    return closed_cells.empty() ? all : std::max(all - closed_cells[vertex], closures::least_open_fraction);
  }


  template <int dim>
  unsigned int FreeSurface<dim>::cells_in_box(const unsigned int vertex) const
  {
    unsigned int number = 1 << dim;
    for (unsigned int faces = vertices.faces(vertex); faces != 0; faces &= faces - 1)
      number /= 2;
    return number;
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
    for (const EnteringWater<dim> &entering : mixture.entering())
      for (unsigned int v = 0; v < entering.at_vertex.size(); ++v)
        filling[vertices.nodes(entering.cell)[v]][filled] += entering.at_vertex[v];
    filling.add_contributions();
    filling.update_ghosts();
  }


  template <int dim>
  void FreeSurface<dim>::sum_soil(const Mixture<dim> &mixture)
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
  }


  template <int dim>
  void FreeSurface<dim>::find_soil_depths(Mixture<dim> &mixture)
  {
    sum_soil(mixture);
    for (MixtureCell<dim> &cell : mixture.cells())
      if (cell.grain_volume > 0.)
        for (unsigned int v = 0; v < cell.n_vertices; ++v)
          {
            const unsigned int vertex = vertices.nodes(cell.cell)[v];
            cell.soil_depths[v]       = distance_from_fill(soil[vertex][0] / volume_under(vertex));
          }
  }


  template <int dim>
  void FreeSurface<dim>::locate(const Mixture<dim> &mixture, VertexVector &pressure)
  {
    for (const unsigned int vertex : filling.active_nodes())
      {
        kinds[vertex]                  = PressureDofType::dry;
        pressure.local_element(vertex) = 0.;
      }
    sum_filling(mixture);
    const auto classify = [&](const unsigned int vertex) {
      const double *sums = filling[vertex];
      // Overfull cells next to empty ones must not hide the surface between them: without it p has no level.
      const double fill = std::min(sums[filled] / volume_under(vertex), sums[wet_cells] / open_cells_around(vertex));
      PressureDofType &kind = kinds[vertex];
      distances[vertex]     = distance_from_fill(fill);
      kind                  = PressureDofType::dry;
      double value          = 0.;
      if (sums[wet_cells] > 0. && (walls.open_faces() & vertices.faces(vertex)) != 0)
        {
          kind  = PressureDofType::prescribed;
          value = walls.pressure(vertices.faces(vertex));
        }
      else if (sums[water] > 0. && distances[vertex] >= least_depth - 1e-9 && has_room(vertex))
        {
          kind  = PressureDofType::unknown;
          value = pressure_of_points(vertex);
        }
      pressure.local_element(vertex) = value;
    };
    for_all_wet_vertices(mixture, classify);

    // Kinds beside the surface: those with unknown neighbours, then those that have only those.
    neighbours.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        neighbours.activate_cell(cell.cell);
    const auto spread = [&](const PressureDofType source, const PressureDofType target) {
      for_pairs(mixture, PressureDofType::dry, source, [&](const unsigned int vertex, const unsigned int neighbour) {
        neighbours[vertex][number] += 1.;
        neighbours[vertex][sum_of_distances] += distances[neighbour];
      });
      neighbours.add_contributions();
      neighbours.update_ghosts();
      for_all_wet_vertices(mixture, [&](const unsigned int vertex) {
        if (kinds[vertex] == PressureDofType::dry && neighbours[vertex][number] > 0.)
          kinds[vertex] = target;
      });
    };
    spread(PressureDofType::unknown, PressureDofType::surface);
    neighbours.clear_ghosts();
    spread(PressureDofType::surface, PressureDofType::beyond);
    followers[0].followed = PressureDofType::unknown;
    followers[1].followed = PressureDofType::surface;
    for (Followers &group : followers)
      {
        const PressureDofType kind =
            group.followed == PressureDofType::unknown ? PressureDofType::surface : PressureDofType::beyond;
        group.vertices.clear();
        group.pairs.clear();
        for_all_wet_vertices(mixture, [&](const unsigned int vertex) {
          if (kinds[vertex] == kind)
            group.vertices.push_back(vertex);
        });
        for_pairs(mixture, kind, group.followed, [&](const unsigned int vertex, const unsigned int neighbour) {
          group.pairs.emplace_back(vertex, neighbour);
        });
      }
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
  void FreeSurface<dim>::restrict_to_unknown(VertexVector &sums, const Shares shares)
  {
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
  }


  template <int dim>
  template <typename Function>
  void FreeSurface<dim>::for_pairs(const Mixture<dim> &mixture,
                                   const PressureDofType kind,
                                   const PressureDofType kind_of_neighbour,
                                   const Function &act) const
  {
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        {
          const unsigned int *nodes = vertices.nodes(cell.cell);
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            if (kinds[nodes[v]] == kind)
              for (unsigned int w = 0; w < cell.n_vertices; ++w)
                if (kinds[nodes[w]] == kind_of_neighbour &&
                    (kind_of_neighbour == PressureDofType::unknown || distances[nodes[w]] > 1e-6))
                  act(nodes[v], nodes[w]);
        }
  }


  template class FreeSurface<2>;
  template class FreeSurface<3>;
} // namespace scree
