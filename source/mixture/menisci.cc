// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mixture/menisci.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void Menisci<dim>::find_soil(const Mixture<dim> &mixture)
  {
    soil->clear();
    for (const MixtureCell<dim> &cell : mixture.cells())
      if (cell.water_volume > 0. || cell.grain_volume > 0.)
        {
          soil->activate_cell(cell.cell);
          if (!(cell.grain_volume > 0.))
            continue;
          const double bulk = 1. + cell.pore_volume / cell.grain_volume;
          for (unsigned int v = 0; v < cell.n_vertices; ++v)
            (*soil)[vertices.nodes(cell.cell)[v]][0] += bulk * cell.grains_at_vertex[v];
        }
    soil->add_contributions();
    soil->update_ghosts();
  }


  template <int dim>
  void Menisci<dim>::find_behind(const unsigned int vertex, const double distance, const double volume)
  {
    using closures::least_dry_soil, closures::surely_dry_soil;
    const double fill = distance < 0. ? 0.5 * std::pow(1. + distance, 2) : 1. - 0.5 * std::pow(1. - distance, 2);
    const double dry  = (*soil)[vertex][0] / volume - fill;
    behind[vertex]    = std::clamp((dry - least_dry_soil) / (surely_dry_soil - least_dry_soil), 0., 1.);
    closed[vertex]    = false;
  }


  template <int dim>
  bool Menisci<dim>::end_soil(const unsigned int vertex) const
  {
    return behind[vertex] < 0.5;
  }


  template <int dim>
  double Menisci<dim>::least_pressure(const unsigned int vertex, const double other) const
  {
    return exist() && closed[vertex] ? std::max(other, -air_entry) : other;
  }


  template <int dim>
  double Menisci<dim>::start_pressure(const unsigned int vertex, const double inside, const bool bears)
  {
    const double suction = bears && inside < 0. ? std::max(inside, -air_entry) : 0.;
    held[vertex]         = suction < 0. && inside > -air_entry ? 1. - behind[vertex] : 0.;
    return (1. - behind[vertex]) * suction - behind[vertex] * air_entry;
  }

  template class Menisci<2>;
  template class Menisci<3>;
} // namespace scree
