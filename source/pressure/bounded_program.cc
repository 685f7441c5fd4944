// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/bounded_program.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double no_limit = std::numeric_limits<double>::infinity();
  } // namespace


  template <int dim>
  void BoundedProgram<dim>::begin(const std::size_t n_pressures, std::vector<GroundRow<dim>> *of_ground)
  {
    rows = of_ground;
    for (Vector *vector : vectors())
      vector->clear(n_pressures, rows ? rows->size() : 0);
  }


  template <int dim>
  void BoundedProgram<dim>::set_bounds(const std::vector<double> &least_pressures,
                                       const std::vector<double> &of_numbers)
  {
    least    = least_pressures;
    diagonal = of_numbers;
    is_held.assign(solution.pressures.size(), least.empty());
    project();
    hold();
  }


  template <int dim>
  void BoundedProgram<dim>::restrict_to_free(Vector &vector) const
  {
    for (unsigned int i = 0; i < is_held.size(); ++i)
      if (is_held[i])
        vector.pressures[i] = 0.;
    for (unsigned int k = 0; k < vector.tractions.size(); ++k)
      vector.tractions[k] = (*rows)[k].held_part(vector.tractions[k]);
  }


  template <int dim>
  double BoundedProgram<dim>::find_release(Vector &result) const
  {
    double square = 0.;
    result.clear(source.pressures.size(), source.tractions.size());
    for (unsigned int i = 0; i < least.size(); ++i)
      if (const double flow = remaining.pressures[i]; is_held[i] && flow > 0.)
        {
          result.pressures[i] = flow / diagonal[i];
          square += flow * flow;
        }
    for (unsigned int k = 0; k < result.tractions.size(); ++k)
      {
        const GroundRow<dim> &row = (*rows)[k];
        const double flow         = remaining.tractions[k] * row.normal;
        if (!row.holds_across && flow > 0. && row.diagonal > 0.)
          {
            result.tractions[k] = flow / row.diagonal * row.normal;
            square += weight_of_rows * flow * flow;
          }
      }
    return square;
  }


  template <int dim>
  void BoundedProgram<dim>::release(const Vector &along)
  {
    for (unsigned int i = 0; i < is_held.size(); ++i)
      is_held[i] = is_held[i] && along.pressures[i] == 0.;
    for (unsigned int k = 0; k < along.tractions.size(); ++k)
      if (GroundRow<dim> &row = (*rows)[k]; along.tractions[k].norm_square() > 0.)
        row.holds_across = true;
  }


  template <int dim>
  double BoundedProgram<dim>::step_of_pressure(const unsigned int i) const
  {
    const double change = direction.pressures[i];
    return i < least.size() && change < 0. ? (least[i] - solution.pressures[i]) / change : no_limit;
  }


  template <int dim>
  double BoundedProgram<dim>::step_of_row(const unsigned int k) const
  {
    const GroundRow<dim> &row = (*rows)[k];
    const double change       = direction.tractions[k] * row.normal;
    return row.is_unilateral && row.holds_across && change < 0. ? -(solution.tractions[k] * row.normal) / change
                                                                : no_limit;
  }


  template <int dim>
  double BoundedProgram<dim>::longest_step() const
  {
    double longest = no_limit;
    for (unsigned int i = 0; i < least.size(); ++i)
      longest = std::min(longest, step_of_pressure(i));
    for (unsigned int k = 0; k < direction.tractions.size(); ++k)
      longest = std::min(longest, step_of_row(k));
    return longest;
  }


  template <int dim>
  void BoundedProgram<dim>::go_to_first_bound(const double length)
  {
    constexpr double rounded = 1e-12; // What reaches its bound within this is on it, whatever rounding leaves.
    const double reach       = (1. + rounded) * length;
    for (unsigned int i = 0; i < is_held.size(); ++i)
      if (step_of_pressure(i) <= reach)
        solution.pressures[i] = least[i];
      else
        solution.pressures[i] += length * direction.pressures[i];
    for (unsigned int k = 0; k < solution.tractions.size(); ++k)
      {
        const bool is_at_bound = step_of_row(k) <= reach;
        solution.tractions[k] += length * direction.tractions[k];
        if (is_at_bound)
          lift_off(k);
      }
  }


  template <int dim>
  void BoundedProgram<dim>::lift_off(const unsigned int k)
  {
    const GroundRow<dim> &row = (*rows)[k];
    solution.tractions[k]     = row.holds_along ? row.along(solution.tractions[k]) : Tensor<1, dim>();
  }


  template <int dim>
  void BoundedProgram<dim>::project()
  {
    for (unsigned int i = 0; i < least.size(); ++i)
      if (double &value = solution.pressures[i]; value < least[i])
        value = least[i];
    for (unsigned int k = 0; k < solution.tractions.size(); ++k)
      if ((*rows)[k].is_unilateral && solution.tractions[k] * (*rows)[k].normal < 0.)
        lift_off(k);
  }


  template <int dim>
  void BoundedProgram<dim>::hold()
  {
    for (unsigned int i = 0; i < least.size(); ++i)
      if (solution.pressures[i] == least[i])
        is_held[i] = true;
    for (unsigned int k = 0; k < solution.tractions.size(); ++k)
      if (GroundRow<dim> &row = (*rows)[k]; row.is_unilateral && !presses(k))
        row.holds_across = false;
  }


  template <int dim>
  void BoundedProgram<dim>::find_residual()
  {
    matrix(remaining, solution);
    remaining.sadd(-1., 1., source);
  }


  template <int dim>
  double BoundedProgram<dim>::local_square(const Vector &vector) const
  {
    double square = 0.;
    for (const double value : vector.pressures)
      square += value * value;
    for (const Tensor<1, dim> &value : vector.tractions)
      square += weight_of_rows * value.norm_square();
    return square;
  }


  template <int dim>
  typename BoundedProgram<dim>::Iterations BoundedProgram<dim>::iterate(const unsigned int most, const double accepted)
  {
    Iterations result{ 0, 0. };
    bool is_conjugate      = false; // the next direction to the last one
    double last_projection = 1.;
    for (;; ++result.n)
      {
        free_remaining = remaining;
        restrict_to_free(free_remaining);
        preconditioner(preconditioned, free_remaining);
        restrict_to_free(preconditioned);
        std::array<double, 4> sums{
          { local_square(free_remaining), find_release(scratch), free_remaining * preconditioned, energy() }
        };
        Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                            communicator,
                            ArrayView<double>(sums.data(), sums.size()));
        const auto [free, blocked, projection, energy_before] = sums;
        const bool searches                                   = result.n < most_of_search;
        result.residual                                       = std::sqrt(free + (searches ? blocked : 0.));
        if (result.residual <= accepted || result.n == most)
          return result;

        const bool releases = searches && blocked > free;
        if (releases)
          {
            direction = scratch;
            release(direction);
          }
        else
          direction.sadd(is_conjugate ? projection / last_projection : 0., 1., preconditioned);
        matrix(product, direction);
        const auto of_ranks = Utilities::MPI::min_max_avg(
            std::vector<double>{ direction * product, direction * remaining, longest_step() }, communicator);
        const double length    = of_ranks[1].sum / of_ranks[0].sum;
        const double longest   = of_ranks[2].min;
        const bool is_feasible = !searches || length < longest;
        if (!is_feasible)
          scratch = solution;
        solution.sadd(1., length, direction);
        last_projection = projection;
        is_conjugate    = !releases && is_feasible;
        if (is_feasible)
          {
            remaining.sadd(1., -length, product);
            continue;
          }
        project();
        find_residual();
        if (Utilities::MPI::sum(energy(), communicator) > energy_before)
          {
            solution = scratch;
            go_to_first_bound(longest);
            find_residual();
          }
        hold();
      }
  }

  template class BoundedProgram<2>;
  template class BoundedProgram<3>;
} // namespace scree
