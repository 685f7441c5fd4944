// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/step/budget.h>

namespace scree
{
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
    if (obstacles.size() < other.obstacles.size())
      obstacles.resize(other.obstacles.size());
    Budget addend = other;
    addend.obstacles.resize(obstacles.size());
    const NumbersOf sums(*this), addends(addend);
    for (std::size_t i = 0; i < sums.list.size(); ++i)
      *sums.list[i] += *addends.list[i];
    return *this;
  }

  template struct ObstacleBalance<2>;
  template struct ObstacleBalance<3>;
  template struct Budget<2>;
  template struct Budget<3>;
} // namespace scree
