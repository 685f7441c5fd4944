// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/partition.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    using WallClock = std::chrono::steady_clock;

    constexpr unsigned int steps_between_looks        = 50;
    constexpr unsigned int steps_between_measurements = 10;
    constexpr double cost_of_unmeasured_point         = 1e-7; // s
  }                                                           // namespace


  template <int dim>
  Partition<dim>::Partition(parallel::distributed::Triangulation<dim> &mesh, const std::vector<PointSet<dim> *> &sets)
      : mesh(mesh)
      , sets(sets)
      , communicator(mesh.get_communicator())
      , n_ranks(Utilities::MPI::n_mpi_processes(communicator))
      , typical_costs(sets.size(), cost_of_unmeasured_point)
      , weight_signal(mesh.signals.weight.connect([this](const auto &cell, const auto) { return weight_of(cell); }))
      , last(WallClock::now())
  {
  }


  template <int dim>
  void Partition<dim>::begin_step()
  {
    if (n_ranks == 1)
      return;
    if (n_steps++ % steps_between_measurements == 0)
      for (PointSet<dim> *points : sets)
        points->costs().time_next_pass();
    last = WallClock::now();
  }


  template <int dim>
  void Partition<dim>::finish(const Work finished)
  {
    if (n_ranks == 1)
      return;
    const auto now = WallClock::now();
    add(finished, std::chrono::duration<double>(now - last).count());
    last = now;
  }


  template <int dim>
  void Partition<dim>::wait()
  {
    if (n_ranks == 1)
      return;
    const int error = MPI_Barrier(communicator);
    AssertThrowMPI(error);
    resume();
  }


  template <int dim>
  void Partition<dim>::resume()
  {
    last = WallClock::now();
  }


  template <int dim>
  double Partition<dim>::number_of_points() const
  {
    double n_points = 0;
    for (const PointSet<dim> *points : sets)
      n_points += points->n_points();
    return n_points;
  }


  template <int dim>
  typename Partition<dim>::WorkOfRanks Partition<dim>::collect()
  {
    WorkOfRanks result;
    const auto of_ranks =
        Utilities::MPI::min_max_avg(std::vector<double>(work_of_rank.begin(), work_of_rank.end()), communicator);
    for (unsigned int w = 0; w < n_works; ++w)
      {
        result.largest[w] = of_ranks[w].max;
        result.mean[w]    = of_ranks[w].avg;
        sum_of_largest += of_ranks[w].max;
        sum_of_mean += of_ranks[w].avg;
      }
    to_points += work_of_rank[unsigned(Work::to_points)];
    n_steps_in_partition += n_steps;
    work_of_rank.fill(0.);
    n_steps = 0;
    return result;
  }


  template <int dim>
  bool Partition<dim>::is_worth_changing()
  {
    if (n_ranks == 1)
      return false;
    if (!has_begun)
      {
        has_begun                             = true;
        const auto of_ranks                   = Utilities::MPI::min_max_avg(number_of_points(), communicator);
        constexpr double worthwhile_imbalance = 1.02;
        for (PointSet<dim> *points : sets)
          points->costs().reinit(mesh.n_active_cells());
        return of_ranks.max > worthwhile_imbalance * of_ranks.avg;
      }
    if (n_steps < steps_between_looks)
      return false;

    const WorkOfRanks ranks = collect();
    const auto mean         = [&](const Work of) { return ranks.mean[unsigned(of)]; };
    // Works of about the same length must not take turns.
    constexpr double clearly = 1.25;
    if (mean(Work::to_points) > clearly * mean(Work::to_nodes))
      weights = Weights::costs;
    else if (mean(Work::to_nodes) > clearly * mean(Work::to_points))
      weights = Weights::points;

    const unsigned int evened_out = unsigned(weights == Weights::costs ? Work::to_points : Work::to_nodes);
    surplus += ranks.largest[evened_out] - ranks.mean[evened_out];
    // So changes in vain, where cells are too few to be shared out evenly, take no longer than what they answer.
    return surplus > duration;
  }


  template <int dim>
  void Partition<dim>::find_typical_costs()
  {
    double of_cells = 0; // s a step
    for (unsigned int s = 0; s < sets.size(); ++s)
      {
        double sum = 0, n = 0;
        for (const CellPoints<dim> &cell : sets[s]->cells())
          if (const double cost = sets[s]->costs().of_point(cell.cell, 0.); cost > 0.)
            {
              sum += cell.n_points * cost;
              n += cell.n_points;
            }
        const double n_of_ranks = Utilities::MPI::sum(n, communicator);
        of_cells += sum;
        sum              = Utilities::MPI::sum(sum, communicator);
        typical_costs[s] = n_of_ranks > 0. ? sum / n_of_ranks : cost_of_unmeasured_point;
      }
    // What measuring cell by cell misses belongs to all of them.
    calibration = of_cells > 0. && n_steps_in_partition > 0 ? to_points / n_steps_in_partition / of_cells : 1.;
  }


  template <int dim>
  unsigned int Partition<dim>::weight_of(const typename Triangulation<dim>::cell_iterator &cell) const
  {
    double seconds = 1e-8; // An empty cell costs a little.
    if (cell->is_active() && cell->is_locally_owned())
      for (unsigned int s = 0; s < sets.size(); ++s)
        {
          const unsigned int index = typename Triangulation<dim>::active_cell_iterator(cell)->active_cell_index();
          seconds += sets[s]->handler().n_particles_in_cell(cell) *
                     (weights == Weights::costs ? calibration * sets[s]->costs().of_point(index, typical_costs[s])
                                                : typical_costs[s]);
        }
    constexpr double most = 1e6; // ns; sums over the cells of a rank stay integers
    return static_cast<unsigned int>(std::lround(std::min(1e9 * seconds, most)));
  }


  template <int dim>
  void Partition<dim>::repartition(const std::function<void()> &fit)
  {
    const auto start = WallClock::now();
    find_typical_costs();
    for (PointSet<dim> *points : sets)
      points->handler().prepare_for_coarsening_and_refinement();
    mesh.repartition();
    for (PointSet<dim> *points : sets)
      {
        points->handler().unpack_after_coarsening_and_refinement();
        points->sort();
        points->costs().reinit(mesh.n_active_cells());
      }
    fit();
    n_changes += sum_of_mean > 0.;
    surplus = to_points  = 0.;
    n_steps_in_partition = 0;
    duration = Utilities::MPI::max(std::chrono::duration<double>(WallClock::now() - start).count(), communicator);
  }


  template <int dim>
  double Partition<dim>::imbalance()
  {
    collect();
    return sum_of_mean > 0. ? sum_of_largest / sum_of_mean : 1.;
  }

  template class Partition<2>;
  template class Partition<3>;
} // namespace scree
