// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/partition.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int steps_between_looks        = 50;
    constexpr unsigned int steps_between_measurements = 10;
    constexpr double cost_of_unmeasured_point         = 1e-7; // s
  }                                                           // namespace


  template <int dim>
  Partition<dim>::Partition(parallel::distributed::Triangulation<dim> &mesh, const std::vector<PointSet<dim> *> &sets)
      : mesh(mesh)
      , sets(sets)
      , communicator(communicator_of(mesh))
      , n_ranks(Utilities::MPI::n_mpi_processes(communicator))
      , typical_costs(sets.size(), cost_of_unmeasured_point)
      , weight_signal(mesh.signals.weight.connect([this](const auto &cell, const auto) { return weight_of(cell); }))
      , last(thread_time())
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
    last = thread_time();
  }


  template <int dim>
  void Partition<dim>::finish(const Work finished)
  {
    if (n_ranks == 1)
      return;
    const double now = thread_time();
    add(finished, now - last);
    last = now;
  }


  template <int dim>
  std::array<typename Partition<dim>::WorkOfRanks, 2> Partition<dim>::collect()
  {
    const auto own        = [this](const Work work) { return work_of_rank[unsigned(work)]; };
    const double to_nodes = own(Work::to_nodes), solving = own(Work::solving), to_points = own(Work::to_points);
    const auto of_ranks =
        Utilities::MPI::min_max_avg(std::vector<double>{ to_nodes, to_nodes + solving, to_points }, communicator);
    const auto &of_nodes = of_ranks[0], &with_solving = of_ranks[1], &of_points = of_ranks[2];
    // A rank with little to do waits in solving, in the processor's time: what is uneven is the rest.
    const std::array<WorkOfRanks, 2> works{ { { with_solving.avg + of_nodes.max - of_nodes.avg, with_solving.avg },
                                              { of_points.max, of_points.avg } } };
    for (const WorkOfRanks &one : works)
      {
        sum_of_largest += one.largest;
        sum_of_mean += one.mean;
      }
    this->to_points += to_points;
    n_steps_in_partition += n_steps;
    work_of_rank.fill(0.);
    n_steps = 0;
    return works;
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

    const std::array<WorkOfRanks, 2> works = collect();
    const auto mean                        = [&](const Weights of) { return works[unsigned(of)].mean; };
    // Works of about the same length must not take turns.
    constexpr double clearly = 1.25;
    if (mean(Weights::costs) > clearly * mean(Weights::points))
      weights = Weights::costs;
    else if (mean(Weights::points) > clearly * mean(Weights::costs))
      weights = Weights::points;
    surplus += works[unsigned(weights)].largest - works[unsigned(weights)].mean;
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
        sum = Utilities::MPI::sum(sum, communicator);
        if (n_of_ranks > 0.)
          typical_costs[s] = sum / n_of_ranks;
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
          const CellCosts &costs   = sets[s]->costs();
          const double of_point =
              weights == Weights::points ? typical_costs[s] : calibration * costs.of_point(index, typical_costs[s]);
          seconds += sets[s]->handler().n_particles_in_cell(cell) * of_point;
        }
    constexpr double most = 1e6; // ns; sums over the cells of a rank stay integers
    return static_cast<unsigned int>(std::lround(std::min(1e9 * seconds, most)));
  }


  template <int dim>
  void Partition<dim>::repartition(const std::function<void()> &fit)
  {
    const double start = thread_time();
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
    const double start_of_fit = thread_time();
    fit();
    n_changes += sum_of_mean > 0.;
    surplus = to_points  = 0.;
    n_steps_in_partition = 0;
    std::vector<double> durations{ thread_time() - start, thread_time() - start_of_fit };
    Utilities::MPI::max(durations, communicator, durations);
    duration        = durations[0];
    duration_of_fit = durations[1];
  }


  template class Partition<2>;
  template class Partition<3>;
} // namespace scree
