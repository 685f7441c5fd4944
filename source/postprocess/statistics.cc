// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/io/row_file.h>
#include <scree/postprocess/statistics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void RunTotals<dim>::add(const UpdateReport &report)
  {
    plastic_dissipation += report.plastic_dissipation;
    n_updates += report.n_updates;
    n_substeps += report.n_substeps;
    n_fallbacks += report.n_fallbacks;
    n_vertices += report.n_vertices;
    n_unresolved += report.n_unresolved;
  }


  template <int dim>
  RunTotals<dim> RunTotals<dim>::sum_over_ranks(const MPI_Comm communicator) const
  {
    RunTotals total      = *this;
    Budget<dim> &balance = total.balance;
    std::vector<double *> values{ &balance.wall_dissipation,
                                  &balance.bed_dissipation,
                                  &balance.contact_dissipation,
                                  &balance.drag_dissipation,
                                  &balance.viscous_dissipation,
                                  &balance.load_work,
                                  &balance.correction_work,
                                  &balance.n_iterations,
                                  &balance.n_preconditioners,
                                  &balance.n_viscous_iterations,
                                  &balance.n_cavitating,
                                  &total.lost_mass,
                                  &total.lost_volume,
                                  &total.lost_water_mass,
                                  &total.lost_energy,
                                  &total.n_entered,
                                  &total.entered_mass,
                                  &total.entered_water_mass,
                                  &total.entered_energy,
                                  &total.plastic_dissipation,
                                  &total.n_lost,
                                  &total.n_updates,
                                  &total.n_substeps,
                                  &total.n_fallbacks,
                                  &total.n_vertices,
                                  &total.n_unresolved };
    for (Tensor<1, dim> *vector : { &balance.wall_impulse,
                                    &balance.body_impulse,
                                    &balance.pressure_impulse,
                                    &balance.load_impulse,
                                    &balance.bed_impulse,
                                    &total.lost_momentum,
                                    &total.entered_momentum })
      for (unsigned int a = 0; a < dim; ++a)
        values.push_back(&(*vector)[a]);
    for (WallImpulses<dim> *walls : { &balance.soil_walls, &balance.water_walls })
      for (Tensor<1, dim> &impulse : walls->of_face)
        for (unsigned int a = 0; a < dim; ++a)
          values.push_back(&impulse[a]);
    for (ObstacleBalance<dim> &obstacle : balance.obstacles)
      {
        for (Tensor<1, dim> *impulse : { &obstacle.impulse, &obstacle.pressure_impulse })
          for (unsigned int a = 0; a < dim; ++a)
            values.push_back(&(*impulse)[a]);
        for (unsigned int r = 0; r < ObstacleBalance<dim>::n_rotations; ++r)
          values.push_back(&obstacle.moment_impulse[r]);
        values.push_back(&obstacle.work);
        values.push_back(&obstacle.dissipation);
      }

    std::vector<double> sums; // one message for all
    for (const double *value : values)
      sums.push_back(*value);
    Utilities::MPI::sum(sums, communicator, sums);
    for (unsigned int i = 0; i < values.size(); ++i)
      *values[i] = sums[i];
    return total;
  }


  template <int dim>
  Statistics<dim>::Statistics(const BackgroundGrid<dim> &grid,
                              const Tensor<1, dim> &gravity,
                              const FurtherColumns<dim> &further)
      : grid(grid)
      , gravity(gravity)
      , further(further)
  {
  }


  template <int dim>
  void Statistics<dim>::add(const std::string &column, const double value)
  {
    last_row.emplace_back(column, value);
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
    const MPI_Comm communicator = grid.triangulation().get_communicator();
    const PointSums<dim> now(bodies, water, gravity, communicator);

    const RunTotals<dim> totals  = local.sum_over_ranks(communicator);
    const Budget<dim> &balance   = totals.balance;
    const Tensor<1, dim> impulse = balance.wall_impulse + balance.body_impulse + balance.pressure_impulse +
                                   balance.load_impulse + balance.bed_impulse + balance.obstacle_impulse() +
                                   totals.entered_momentum - totals.lost_momentum;

    const double energy = now.kinetic + now.potential + now.elastic;
    if (!has_start)
      {
        has_start      = true;
        start_momentum = now.momentum - impulse;
        start_energy   = energy;
      }
    last_row.clear();

    add("Time (s)", time);
    add("Step", step);
    add("Time step (s)", time_step);
    add("Points", now.soil_points);
    add("Mass (kg)", now.soil_mass);
    for (unsigned int a = 0; a < dim; ++a)
      add(std::string("Momentum ") + "xyz"[a] + " (N s)", now.momentum[a]);
    add("Momentum residual (N s)", (now.momentum - start_momentum - impulse).norm());
    add("Kinetic energy (J)", now.kinetic);
    add("Potential energy (J)", now.potential);
    add("Elastic energy (J)", now.elastic);
    add("Plastic dissipation (J)", totals.plastic_dissipation);
    add("Wall dissipation (J)", balance.wall_dissipation);
    add("Numerical dissipation (J)",
        start_energy - energy - totals.plastic_dissipation - balance.wall_dissipation - balance.bed_dissipation -
            balance.contact_dissipation - balance.drag_dissipation - balance.viscous_dissipation - totals.lost_energy +
            balance.load_work + balance.correction_work + balance.obstacle_energy() + totals.entered_energy);
    if (!bodies.empty())
      add_soil_columns(bodies, now, totals, last_step);
    add("Points lost", totals.n_lost);
    add("Mass lost (kg)", totals.lost_mass);
    if (!water.empty())
      add_water_columns(bodies, water, now, totals, step);
    if (further.bed)
      add_bed_columns(bodies, water, balance);
    if (further.obstacles != nullptr && !further.obstacles->empty())
      add_obstacle_columns(balance, time);
    if (further.inflows)
      add_inflow_columns(water, totals);
    if (further.contacts)
      add("Contact dissipation (J)", balance.contact_dissipation);
    if (further.loads)
      add("Load work (J)", balance.load_work);
    if (further.volume_correction)
      add("Volume correction work (J)", balance.correction_work);
    last_row_step = step;
  }


  template <int dim>
  void Statistics<dim>::add_soil_columns(const std::list<SoilBody<dim>> &bodies,
                                         const PointSums<dim> &now,
                                         const RunTotals<dim> &totals,
                                         const UpdateReport &last_step)
  {
    const auto front = mass_percentiles(bodies, grid, 0, { 0.90, 0.99, 0.995 });
    add("Front 90 % (m)", front[0]);
    add("Front 99 % (m)", front[1]);
    add("Front 99.5 % (m)", front[2]);
    add("Height (m)", std::max(now.height, grid.lower_corner()[dim - 1]));
    add("Stress oscillation (-)", stress_oscillation(bodies, grid));
    add("Mean effective stress (Pa)", now.soil_points > 0 ? now.pressure / now.soil_points : 0.);
    add("Largest effective stress (Pa)", now.largest_pressure);
    add("Separated points",
        Utilities::MPI::sum(double(last_step.n_separated), grid.triangulation().get_communicator()));
    add("Substeps per update", totals.n_updates > 0 ? totals.n_substeps / totals.n_updates : 0.);
    add("Fallbacks", totals.n_fallbacks);
    add("Vertices", totals.n_vertices);
    add("Unresolved", totals.n_unresolved);
  }


  template <int dim>
  void Statistics<dim>::add_inflow_columns(const std::list<WaterPhase<dim>> &water, const RunTotals<dim> &totals)
  {
    add("Points entered", totals.n_entered);
    add("Mass entered (kg)", totals.entered_mass);
    if (!water.empty())
      add("Water entered (kg)", totals.entered_water_mass);
    for (unsigned int a = 0; a < dim; ++a)
      add(std::string("Momentum entered ") + "xyz"[a] + " (N s)", totals.entered_momentum[a]);
    add("Energy entered (J)", totals.entered_energy);
  }


  template <int dim>
  void Statistics<dim>::add_bed_columns(const std::list<SoilBody<dim>> &bodies,
                                        const std::list<WaterPhase<dim>> &water,
                                        const Budget<dim> &balance)
  {
    add("Bed dissipation (J)", balance.bed_dissipation);
    for (unsigned int a = 0; a < dim; ++a)
      add(std::string("Bed impulse ") + "xyz"[a] + " (N s)", -balance.bed_impulse[a]);
    add("Least distance from bed (m)",
        least_distance(bodies, water, *further.bed, grid.triangulation().get_communicator()));
  }


  template <int dim>
  void Statistics<dim>::add_obstacle_columns(const Budget<dim> &balance, const double time)
  {
    obstacles_at_last_row.resize(balance.obstacles.size());
    const double duration = time - last_row_time;
    const auto mean_rate  = [duration](const double now, const double before) {
      return duration > 0. ? (now - before) / duration : 0.;
    };
    auto obstacle = further.obstacles->begin();
    for (unsigned int o = 0; o < balance.obstacles.size(); ++o, ++obstacle)
      {
        // The obstacle feels the opposite of what soil and water do.
        const ObstacleBalance<dim> &now = balance.obstacles[o], &before = obstacles_at_last_row[o];
        const Tensor<1, dim> impulse        = -(now.impulse + now.pressure_impulse);
        const Tensor<1, dim> impulse_before = -(before.impulse + before.pressure_impulse);
        const std::string name              = ObstacleParameters::prefix + obstacle->name + ' ';
        for (unsigned int a = 0; a < dim; ++a)
          add(name + "force " + "xyz"[a] + " (N)", mean_rate(impulse[a], impulse_before[a]));
        for (unsigned int r = 0; r < ObstacleBalance<dim>::n_rotations; ++r)
          add(name + "moment " + (dim == 2 ? 'z' : "xyz"[r]) + " (N m)",
              mean_rate(-now.moment_impulse[r], -before.moment_impulse[r]));
        for (unsigned int a = 0; a < dim; ++a)
          add(name + "impulse " + "xyz"[a] + " (N s)", impulse[a]);
        add(name + "dissipation (J)", now.dissipation);
        if (!obstacle->is_moving)
          continue;
        add(name + "work (J)", now.work);
        for (unsigned int a = 0; a < dim; ++a)
          add(name + "displacement " + "xyz"[a] + " (m)", obstacle->displacement()[a]);
      }
    obstacles_at_last_row = balance.obstacles;
    last_row_time         = time;
  }


  template <int dim>
  void Statistics<dim>::add_water_columns(const std::list<SoilBody<dim>> &bodies,
                                          const std::list<WaterPhase<dim>> &water,
                                          const PointSums<dim> &now,
                                          const RunTotals<dim> &totals,
                                          const unsigned long long step)
  {
    const WaterMeasures measures = measure_water(bodies, water, grid);
    add("Water points", measures.n_points);
    add("Water mass (kg)", measures.mass);
    add("Water outside soil (kg)", measures.mass_outside_soil);
    add("Water lost (kg)", totals.lost_water_mass);
    add("Smallest p (Pa)", measures.smallest_pressure);
    add("Largest p (Pa)", measures.largest_pressure);
    add("p oscillation (-)", pressure_oscillation(water, grid));
    add("Volume error (-)", measures.volume_error);
    const auto front = mass_percentiles(water, grid, 0, { 0.90, 0.99, 0.995 });
    add("Water front 90 % (m)", front[0]);
    add("Water front 99 % (m)", front[1]);
    add("Water front 99.5 % (m)", front[2]);
    add("Water tip (m)", measures.tip);
    if (!bodies.empty())
      add("Largest porosity (-)", now.largest_porosity);
    add("Drag dissipation (J)", totals.balance.drag_dissipation);

    const auto mean_of_steps = [&](const double now_in_all, double &at_last_row) {
      const double mean = step > last_row_step ? (now_in_all - at_last_row) / (step - last_row_step) : 0.;
      at_last_row       = now_in_all;
      return mean;
    };
    add("Cavitating corners", mean_of_steps(totals.balance.n_cavitating, cavitating_at_last_row));
    add("CG iterations per step", mean_of_steps(totals.balance.n_iterations, iterations_at_last_row));
    add("Preconditioners built", totals.balance.n_preconditioners);
    if (further.viscosity)
      {
        add("Viscous dissipation (J)", totals.balance.viscous_dissipation);
        add("Viscous iterations per step",
            mean_of_steps(totals.balance.n_viscous_iterations, viscous_iterations_at_last_row));
      }
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
  std::string Statistics<dim>::head() const
  {
    std::vector<std::string> columns;
    for (const auto &[column, value] : last_row)
      columns.push_back(column);
    return table_head(columns);
  }


  template <int dim>
  std::string Statistics<dim>::row() const
  {
    std::vector<double> values;
    for (const auto &[column, value] : last_row)
      values.push_back(value);
    return table_row(values);
  }


  template <int dim>
  void Statistics<dim>::print_last_row(std::ostream &out) const
  {
    out << std::scientific << std::setprecision(10);
    for (const auto &[column, value] : last_row)
      out << column << ": " << value << '\n';
  }

  template struct RunTotals<2>;
  template struct RunTotals<3>;
  template class Statistics<2>;
  template class Statistics<3>;
} // namespace scree
