// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/partition.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Partition<dim>::Partition(parallel::distributed::Triangulation<dim> &mesh, const std::vector<PointSet<dim> *> &sets)
      : mesh(mesh)
      , sets(sets)
      , communicator(communicator_of(mesh))
      , n_ranks(Utilities::MPI::n_mpi_processes(communicator))
      , weight_signal(mesh.signals.weight.connect([this](const auto &cell, const auto) {
        constexpr unsigned int of_cell = 1, of_point = 10; // what an empty cell costs a step, against a point
        unsigned int weight = of_cell;
        if (cell->is_active() && cell->is_locally_owned())
          for (const PointSet<dim> *points : this->sets)
            weight += of_point * points->handler().n_particles_in_cell(cell);
        return weight;
      }))
  {
  }


  template <int dim>
  void Partition<dim>::count_points()
  {
    double n_points = 0;
    for (const PointSet<dim> *set : sets)
      n_points += set->n_points();
    points = Utilities::MPI::min_max_avg(n_points, communicator);
  }


  template <int dim>
  bool Partition<dim>::is_worth_changing()
  {
    constexpr unsigned int steps_between_looks = 50;
    if (n_ranks == 1)
      return false;
    if (!has_begun)
      {
        has_begun                             = true;
        constexpr double worthwhile_imbalance = 1.02;
        count_points();
        return points.max > worthwhile_imbalance * points.avg;
      }
    if (++n_steps < steps_between_looks)
      return false;
    count_points();
    sum_of_largest += n_steps * points.max;
    sum_of_mean += n_steps * points.avg;
    surplus += n_steps * (points.max - points.avg);
    n_steps                = 0;
    const double cells_avg = double(mesh.n_global_active_cells()) / n_ranks;
    // So changes in vain, where cells are too few to be shared out evenly, take no longer than what they answer.
    return surplus > updates_worth_a_cell * cells_avg + updates_worth_a_point * points.avg;
  }


  template <int dim>
  void Partition<dim>::repartition(const std::function<void()> &fit)
  {
    for (PointSet<dim> *set : sets)
      set->handler().prepare_for_coarsening_and_refinement();
    mesh.repartition();
    for (PointSet<dim> *set : sets)
      {
        set->handler().unpack_after_coarsening_and_refinement();
        set->sort();
      }
    fit();
    n_changes += sum_of_mean > 0.;
    surplus = 0.;
  }


  template class Partition<2>;
  template class Partition<3>;
} // namespace scree
