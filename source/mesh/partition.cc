// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/partition.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Partition<dim>::Partition(BackgroundGrid<dim> &grid, const std::vector<PointSet<dim> *> &sets)
      : grid(grid)
      , sets(sets)
      , communicator(grid.communicator())
      , n_ranks(Utilities::MPI::n_mpi_processes(communicator))
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
    n_steps = 0;
    // A repartition takes about 12 us a cell, mostly for deal.II's mesh, and 5 us a point; an update of a point 250 ns.
    constexpr double updates_worth_a_cell = 50., updates_worth_a_point = 25.;
    const double cells_avg = double(grid.triangulation().n_global_active_cells()) / n_ranks;
    // So changes in vain, where cells are too few to be shared out evenly, take no longer than what they answer.
    return surplus > updates_worth_a_cell * cells_avg + updates_worth_a_point * points.avg;
  }


  template <int dim>
  void Partition<dim>::change_mesh(const Blocks *fine)
  {
    const FineCells<dim> &cells = grid.fine_cells();
    PointsOfCells n_points;
    for (PointSet<dim> *set : sets)
      {
        for (const auto &points : set->cells())
          n_points.emplace_back(cells.cells()[cells.of_index(points.cell)].number, points.n_points);
        set->lift();
      }
    grid.change_cells(fine, std::move(n_points));
    for (PointSet<dim> *set : sets)
      set->put_down([this](const auto &places) { return grid.ranks_at(places); });
    surplus = 0.;
  }


  template class Partition<2>;
  template class Partition<3>;
} // namespace scree
