// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/expression.h>
#include <scree/input/input_error.h>
#include <scree/boundary/body_forces.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  void BodyForceParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Body force",
                      expression,
                      "m/s^2; acceleration in addition to gravity, for verification. One expression of x, y (z) and t "
                      "per axis, separated by semicolons; empty: none.",
                      Patterns::Anything());
  }


  void BodyForceParameters::check(const unsigned int dim) const
  {
    if (!expression.empty() && dim == 2)
      parse_expression<2>(entry_name("", "Body force"), expression, 2, true);
    if (!expression.empty() && dim == 3)
      parse_expression<3>(entry_name("", "Body force"), expression, 3, true);
  }


  template <int dim>
  BodyForces<dim>::BodyForces(const BackgroundGrid<dim> &grid,
                              const std::vector<double> &gravity,
                              const BodyForceParameters &body_force,
                              const BaseMotionParameters &base_motion)
      : grid(grid)
      , own_gravity(make_array_view(gravity))
      , uniform(own_gravity)
  {
    if (!base_motion.record.empty())
      this->base_motion = std::make_unique<BaseMotion<dim>>(base_motion);
    if (!body_force.expression.empty())
      this->body_force = parse_expression<dim>(entry_name("", "Body force"), body_force.expression, dim, true);
  }


  template <int dim>
  void BodyForces<dim>::set_step(const double time, const double time_step)
  {
    if (body_force)
      body_force->set_time(time);
    if (base_motion)
      uniform = own_gravity - base_motion->mean_acceleration(time, time_step);
  }


  template <int dim>
  void BodyForces<dim>::set_start()
  {
    if (body_force)
      body_force->set_time(0.);
    uniform = own_gravity;
  }


  template <int dim>
  double BodyForces<dim>::decay(const double time_step) const
  {
    return std::exp(-damping_rate * time_step);
  }

  template class BodyForces<2>;
  template class BodyForces<3>;
} // namespace scree
