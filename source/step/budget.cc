// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/step/budget.h>

namespace scree
{
  template <int dim>
  ObstacleBalance<dim> &ObstacleBalance<dim>::operator+=(const ObstacleBalance &other)
  {
    impulse += other.impulse;
    pressure_impulse += other.pressure_impulse;
    moment_impulse += other.moment_impulse;
    work += other.work;
    dissipation += other.dissipation;
    return *this;
  }


  template <int dim>
  void ObstacleBalance<dim>::add_moment(const dealii::Tensor<1, dim> &arm, const dealii::Tensor<1, dim> &of_impulse)
  {
    if constexpr (dim == 2)
      moment_impulse[0] += arm[0] * of_impulse[1] - arm[1] * of_impulse[0];
    else
      moment_impulse += cross_product_3d(arm, of_impulse);
  }


  template <int dim>
  dealii::Tensor<1, dim> Budget<dim>::obstacle_impulse() const
  {
    dealii::Tensor<1, dim> sum;
    for (const ObstacleBalance<dim> &obstacle : obstacles)
      sum += obstacle.impulse;
    return sum;
  }


  template <int dim>
  double Budget<dim>::obstacle_energy() const
  {
    double sum = 0.;
    for (const ObstacleBalance<dim> &obstacle : obstacles)
      sum += obstacle.work - obstacle.dissipation;
    return sum;
  }


  template <int dim>
  Budget<dim> &Budget<dim>::operator+=(const Budget &other)
  {
    wall_impulse += other.wall_impulse;
    soil_walls += other.soil_walls;
    water_walls += other.water_walls;
    body_impulse += other.body_impulse;
    pressure_impulse += other.pressure_impulse;
    load_impulse += other.load_impulse;
    bed_impulse += other.bed_impulse;
    if (obstacles.size() < other.obstacles.size())
      obstacles.resize(other.obstacles.size());
    for (unsigned int o = 0; o < other.obstacles.size(); ++o)
      obstacles[o] += other.obstacles[o];
    wall_dissipation += other.wall_dissipation;
    bed_dissipation += other.bed_dissipation;
    contact_dissipation += other.contact_dissipation;
    drag_dissipation += other.drag_dissipation;
    viscous_dissipation += other.viscous_dissipation;
    load_work += other.load_work;
    correction_work += other.correction_work;
    motion += other.motion;
    n_iterations += other.n_iterations;
    n_preconditioners += other.n_preconditioners;
    n_viscous_iterations += other.n_viscous_iterations;
    n_cavitating += other.n_cavitating;
    return *this;
  }

  template struct ObstacleBalance<2>;
  template struct ObstacleBalance<3>;
  template struct Budget<2>;
  template struct Budget<3>;
} // namespace scree
