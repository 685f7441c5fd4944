// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mixture/menisci.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void Menisci<dim>::find_behind(const unsigned int vertex, const double distance, const double of_soil)
  {
    using closures::least_dry_soil, closures::surely_dry_soil;
    const double fill = distance < 0. ? 0.5 * std::pow(1. + distance, 2) : 1. - 0.5 * std::pow(1. - distance, 2);
    const double dry  = of_soil - fill;
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
