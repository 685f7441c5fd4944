// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/body_forces.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  BodyForces<dim>::BodyForces(const BackgroundGrid<dim> &grid,
                              const std::vector<double> &gravity,
                              const BodyForceParameters &parameters,
                              const double mass_scaling)
      : grid(grid)
      , own_gravity(make_array_view(gravity))
      , forces(parameters.make<dim>())
      , scaling(mass_scaling)
      , uniform(fall())
  {
    for (const auto &force : forces)
      if (!force->is_uniform())
        varying.push_back(force.get());
  }


  template <int dim>
  void BodyForces<dim>::set_step(const double time, const double time_step)
  {
    for (const auto &force : forces)
      force->set_step(time, time_step);
    sum_uniform();
  }


  template <int dim>
  void BodyForces<dim>::set_start()
  {
    for (const auto &force : forces)
      force->set_start();
    sum_uniform();
  }


  template <int dim>
  void BodyForces<dim>::sum_uniform()
  {
    uniform = fall();
    for (const auto &force : forces)
      if (force->is_uniform())
        uniform += force->at(Point<dim>()) / scaling;
  }


  template <int dim>
  std::string BodyForces<dim>::text() const
  {
    std::string lines;
    for (const auto &force : forces)
      if (const std::string line = force->text(); !line.empty())
        lines += (lines.empty() ? "" : "\n") + line;
    return lines;
  }


  template <int dim>
  double BodyForces<dim>::decay(const double time_step) const
  {
    return std::exp(-damping_rate * time_step);
  }

  template class BodyForces<2>;
  template class BodyForces<3>;
} // namespace scree
