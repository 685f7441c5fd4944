// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/postprocess/statistics.h>

#include <cmath>
#include <iomanip>

namespace scree
{
  using namespace dealii;

  template <int dim>
  Statistics<dim>::Statistics(const BackgroundGrid<dim> &grid,
                              const Tensor<1, dim> &gravity,
                              const FurtherColumns<dim> &further)
      : grid(grid)
      , gravity(gravity)
      , further(further)
      , motion(grid, gravity, further.bed)
  {
  }


  template <int dim>
  void Statistics<dim>::collect(const std::list<SoilBody<dim>> &bodies,
                                const std::list<WaterPhase<dim>> &water,
                                const RunTotals<dim> &local,
                                const double time,
                                const unsigned long long step,
                                const double time_step,
                                const UpdateReport &last_step)
  {
    const std::vector<double> fronts{ 0.90, 0.99, 0.995 };
    const Snapshot<dim> now{ grid,
                             further,
                             bodies,
                             water,
                             history,
                             last_step,
                             PointSums<dim>(bodies, water, gravity, grid.communicator()),
                             water.empty() ? WaterMeasures() : measure_water(bodies, water, grid),
                             bodies.empty() ? std::vector<double>() : mass_percentiles(bodies, grid, 0, fronts),
                             water.empty() ? std::vector<double>() : mass_percentiles(water, grid, 0, fronts),
                             bodies.empty() ? MotionNumbers() : motion.look(bodies, time),
                             local.sum_over_ranks(grid.communicator()),
                             time,
                             step,
                             time_step };
    if (!history.has_start)
      {
        history.has_start      = true;
        history.start_momentum = now.momentum() - now.impulse();
        history.start_energy   = now.energy();
      }
    const Budget<dim> &balance = now.totals.balance;
    history.obstacles.resize(balance.obstacles.size());
    last_row                     = row_of(now);
    history.step                 = step;
    history.time                 = time;
    history.n_iterations         = balance.n_iterations;
    history.n_cavitating         = balance.n_cavitating;
    history.n_viscous_iterations = balance.n_viscous_iterations;
    history.obstacles            = balance.obstacles;
  }


  template <int dim>
  void Statistics<dim>::require_numbers(const double time) const
  {
    for (const auto &[column, value] : last_row)
      AssertThrow(!std::isnan(value),
                  ExcMessage("Column '" + column + "' of statistics is not a number at t = " + number_text(time) +
                             " s: the motion was unstable before. The rows above it tell since when. Remedies: a "
                             "smaller 'Courant number' in subsection Time step; look at what moves there."));
  }


  template <int dim>
  std::vector<std::string> Statistics<dim>::columns() const
  {
    std::vector<std::string> result;
    for (const auto &[column, value] : last_row)
      result.push_back(column);
    return result;
  }


  template <int dim>
  std::vector<double> Statistics<dim>::values() const
  {
    std::vector<double> result;
    for (const auto &[column, value] : last_row)
      result.push_back(value);
    return result;
  }


  template <int dim>
  void Statistics<dim>::print_last_row(std::ostream &out) const
  {
    out << std::scientific << std::setprecision(10);
    for (const auto &[column, value] : last_row)
      out << column << ": " << value << '\n';
  }

  template class Statistics<2>;
  template class Statistics<3>;
} // namespace scree
