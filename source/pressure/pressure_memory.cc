// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pressure_memory.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PressureMemory<dim>::PressureMemory(const NodeNumbering<dim> &vertices,
                                      const double steepness,
                                      const WaterParameters &water,
                                      const double cell_size)
      : steepness(steepness)
      , water_density(water.density)
      , viscosity(water.viscosity)
      , cell_size(cell_size)
      , changed(vertices)
      , vertices(vertices)
  {
    reinit();
  }


  template <int dim>
  void PressureMemory<dim>::reinit()
  {
    start.reinit(vertices.partitioner());
    changed.reinit();
  }


  template <int dim>
  void PressureMemory<dim>::fade(const FreeSurface<dim> &surface, VertexVector &pressure)
  {
    if (!is_on())
      return;
    start.zero_out_ghost_values();
    for (const unsigned int vertex : surface.wet_vertices())
      if (surface.kind(vertex) == PressureDofType::unknown)
        {
          start.local_element(vertex) = pressure.local_element(vertex);
          pressure.local_element(vertex) *= 1. - surface.forgotten(vertex);
        }
    start.update_ghost_values();
  }


  template <int dim>
  double PressureMemory<dim>::made_by_motion(const double difference, const double largest) const
  {
    constexpr double enough = 100.; // times rho v^2: p may be made by what moves
    double square           = std::min(1., enough * water_density * difference / largest);
    if (viscosity > 0.)
      square *= std::min(1., water_density * std::sqrt(difference) * cell_size / viscosity);
    return std::sqrt(square);
  }


  template <int dim>
  void PressureMemory<dim>::find_forgotten(const Mixture<dim> &mixture,
                                           const FreeSurface<dim> &surface,
                                           const VertexVector &pressure,
                                           const SpeedOfCell &difference)
  {
    if (!is_on())
      return;
    changed.clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0)
        {
          changed.activate_cell(cell.cell);
          const unsigned int *nodes = vertices.nodes(cell.cell);
          double change = 0, size = 0, largest = 0;
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            if (surface.kind(nodes[v]) == PressureDofType::unknown)
              {
                const double before = start.local_element(nodes[v]), after = pressure.local_element(nodes[v]);
                change += std::abs(after - before);
                const double larger = std::max(std::abs(after), std::abs(before));
                size += larger;
                largest = std::max(largest, larger);
              }
          if (change > 0.)
            change *= made_by_motion(difference(cell.cell), largest);
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            {
              changed[nodes[v]][changes] += change;
              changed[nodes[v]][sizes] += size;
            }
        }
    changed.add_contributions();
    changed.update_ghosts();
  }


  template <int dim>
  typename PressureMemory<dim>::AtVertices PressureMemory<dim>::forgotten_at(const unsigned int *vertices_of_cell) const
  {
    constexpr double most = 0.8;
    AtVertices result{};
    if (is_on())
      for (unsigned int v = 0; v < result.size(); ++v)
        if (const double *sums = changed[vertices_of_cell[v]]; sums[changes] > 0.)
          {
            const double rate = steepness * sums[changes] / sums[sizes];
            result[v]         = std::min(most, rate * rate);
          }
    return result;
  }

  template class PressureMemory<2>;
  template class PressureMemory<3>;
} // namespace scree
