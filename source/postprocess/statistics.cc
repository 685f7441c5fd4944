// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/statistics.h>
#include <scree/tensor/vector.h>

#include <iomanip>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double rest_part     = 1e-3; // of sqrt(g h): soil at rest takes more than 1000 sqrt(h/g) for a cell
    constexpr double flow_part     = 0.1;  // of sqrt(g h): oscillations of soil at rest are slower
    constexpr double part_at_rest  = 0.99; // of the mass
    constexpr double least_change  = 0.1;  // of the cell size: less is no loss or deposit of a column
    constexpr double part_of_path  = 0.99; // of the deposit
    constexpr double steepest_wall = 0.5;  // cosine of the slope: steeper ground is a wall beside the soil

    /// Length normal to the ground over that along the last axis.
    template <int dim, typename PointOfSet>
    double cosine_of_ground(const DiscreteLevelSet<dim> *bed, const PointOfSet &point)
    {
      if (bed == nullptr || !bed->is_near(point.cell))
        return 1.;
      const double cosine = std::abs(bed->view(point.cell, point.reference_location).normal[dim - 1]);
      return cosine > steepest_wall ? cosine : 1.;
    }


    /// The value that half of the sum of all values exceeds; 0 if there are none.
    double median_by_volume(std::vector<double> values)
    {
      std::sort(values.begin(), values.end());
      double all = 0., below = 0.;
      for (const double value : values)
        all += value;
      for (const double value : values)
        if ((below += value) >= 0.5 * all)
          return value;
      return 0.;
    }
  } // namespace


  template <int dim>
  double SoilMotion<dim>::rest_speed() const
  {
    return rest_part * std::sqrt(gravity.norm() * grid.cell_size());
  }


  template <int dim>
  MotionNumbers SoilMotion<dim>::look(const std::list<SoilBody<dim>> &bodies, const double time)
  {
    const std::size_t n = columns.size();
    std::vector<double> sums(3 * n + 3, 0.); // thickness, its moment, moving; mass, moving mass, kinetic energy
    std::vector<PartOfMass> speeds;
    const bool is_start = start_thickness.empty();
    const auto include  = [&](const SoilBody<dim> &body, const auto &point) {
      const double mass    = point.properties[body.layout.mass];
      const double speed   = vector_of<dim>(point.properties + body.layout.velocity).norm();
      const double share   = point.properties[body.layout.volume] / columns.area();
      const bool is_moving = speed > rest_speed();
      const double moving =
          is_start || speed > flow_part / rest_part * rest_speed() ? share * cosine_of_ground(bed, point) : 0.;
      for (const auto &[column, weight] : columns.around(point.location))
        {
          sums[column] += weight * share;
          sums[n + column] += weight * share * point.location[dim - 1];
          sums[2 * n + column] += weight * moving;
        }
      sums[3 * n] += mass;
      sums[3 * n + 1] += is_moving ? mass : 0.;
      sums[3 * n + 2] += 0.5 * mass * speed * speed;
      speeds.push_back({ speed, mass });
    };
    for_each_moving_point(bodies, include);
    Utilities::MPI::sum(sums, grid.communicator(), sums);

    has_soil         = sums[3 * n] > 0.;
    last_time        = time;
    last.moving_part = has_soil ? sums[3 * n + 1] / sums[3 * n] : 0.;
    last.speed       = percentile(speeds, part_at_rest, grid.communicator());
    last.thickness   = median_by_volume({ sums.begin() + 2 * n, sums.begin() + 3 * n }) / grid.cell_size();
    if (last.speed > flow_part / rest_part * rest_speed() && sums[3 * n + 2] > largest_kinetic)
      {
        largest_kinetic = sums[3 * n + 2];
        thickness_then  = last.thickness;
      }
    std::vector<double> thickness(sums.begin(), sums.begin() + n), height(n);
    for (std::size_t c = 0; c < n; ++c) // of the surface, if the soil is in one layer
      height[c] = thickness[c] > 0. ? sums[n + c] / thickness[c] + 0.5 * thickness[c] : 0.;
    if (is_start)
      {
        start_thickness = thickness;
        start_height    = height;
      }
    find_path(thickness, height);
    return last;
  }


  template <int dim>
  void SoilMotion<dim>::find_path(const std::vector<double> &thickness, const std::vector<double> &height)
  {
    const Tensor<1, dim> up = gravity.norm() > 0. ? -gravity / gravity.norm() : Tensor<1, dim>();
    const double least      = least_change * grid.cell_size();
    const auto surface      = [&](const std::size_t column, const std::vector<double> &heights) {
      Point<dim> x = columns.middle(column);
      x[dim - 1]   = heights[column];
      return x;
    };
    struct Gain
    {
      double distance, volume, fall; // m, m^3, m
    };
    std::vector<Gain> gains;
    std::optional<Point<dim>> top;
    for (std::size_t c = 0; c < thickness.size(); ++c)
      if (start_thickness[c] - thickness[c] > least)
        if (const Point<dim> x = surface(c, start_height); !top || up * (x - *top) > 0.)
          top = x;
    last.area = last.volume = last.length = last.fall = last.travel_angle = 0.;
    for (std::size_t c = 0; c < thickness.size(); ++c)
      if (const double gain = thickness[c] - start_thickness[c]; gain > least)
        {
          const Tensor<1, dim> path = surface(c, height) - top.value_or(Point<dim>());
          gains.push_back({ (path - (path * up) * up).norm(), gain * columns.area(), -(path * up) });
          last.area += columns.area();
          last.volume += gain * columns.area();
        }
    if (!top || gains.empty())
      return;
    std::sort(gains.begin(), gains.end(), [](const Gain &a, const Gain &b) { return a.distance < b.distance; });
    double below = 0.;
    auto toe     = gains.begin();
    while (toe + 1 < gains.end() && below + toe->volume < part_of_path * last.volume)
      below += (toe++)->volume;
    const double part = (part_of_path * last.volume - below) / toe->volume; // of this column
    last.length       = std::max(0., toe->distance + (std::min(part, 1.) - 0.5) * grid.cell_size());
    last.fall         = toe->fall;
    last.travel_angle = std::atan2(last.fall, last.length) * 180. / numbers::PI;
  }


  template <int dim>
  std::vector<CheckResult> SoilMotion<dim>::results() const
  {
    if (largest_kinetic == 0. || gravity.norm() == 0.)
      return {};
    return { { "thickness of the moving soil " + short_text(thickness_then) + " cells",
               "at least " + short_text(least_cells) + ": cells of at most " +
                   short_text(thickness_then * grid.cell_size() / least_cells) + " m",
               thickness_then < least_cells } };
  }


  template <int dim>
  std::string SoilMotion<dim>::text() const
  {
    if (!has_soil || gravity.norm() == 0.)
      return "";
    const bool is_at_rest = last.moving_part <= 1. - part_at_rest;
    std::string lines     = std::string("Motion      ") + (is_at_rest ? "at rest" : "not at rest") +
                        " at the end, t = " + short_text(last_time) + " s: " + short_text(100. * last.moving_part) +
                        " % of the mass is faster than " + short_text(rest_speed()) +
                        " m/s\n            (0.001 sqrt(g h)), and 1 % of it faster than " + short_text(last.speed) +
                        " m/s";
    if (last.length > 0.)
      lines += std::string("\nRun-out     ") + (is_at_rest ? "" : "so far: ") + "H = " + short_text(last.fall) +
               " m, L = " + short_text(last.length) + " m, H/L = " + short_text(last.fall / last.length) +
               ", travel angle " + short_text(last.travel_angle) + " degrees;\n            deposit " +
               short_text(last.area) + (dim == 2 ? " m, " : " m^2, ") + short_text(last.volume) +
               (dim == 2 ? " m^3/m" : " m^3");
    return lines;
  }

  template class SoilMotion<2>;
  template class SoilMotion<3>;


  template <int dim>
  std::map<std::string, std::function<void(const Snapshot<dim> &, StatisticsRow &)>> &registered_columns()
  {
    static std::map<std::string, std::function<void(const Snapshot<dim> &, StatisticsRow &)>> all;
    return all; // made at the first call, whichever source file registers first
  }

  template decltype(registered_columns<2>) registered_columns<2>;
  template decltype(registered_columns<3>) registered_columns<3>;


  void add_value(StatisticsRow &row, const std::string &name, const std::string &unit, const double value)
  {
    row.emplace_back(unit.empty() ? name : name + " (" + unit + ')', value);
  }


  namespace
  {
    /// Least distance of a point from the surface, m, see DiscreteLevelSet::distance_of(). Collective.
    template <int dim>
    double least_distance(const Snapshot<dim> &now, const DiscreteLevelSet<dim> &surface)
    {
      double least       = surface.reach();
      const auto include = [&](const PointSet<dim> &points) {
        for (const auto &cell : points.cells())
          if (surface.least_distance(cell.cell) < least)
            for_each_point(cell, [&](const auto &point) {
              least = std::min(
                  least,
                  surface.distance_of(point.cell, point.reference_location, point.location, std::min(0., least)));
            });
      };
      for (const auto &body : now.bodies)
        if (!body.is_rigid)
          include(body.points);
      for (const auto &part : now.water)
        if (part.carrier() == nullptr)
          include(part.points());
      return Utilities::MPI::min(least, now.grid.communicator());
    }


    /// What each obstacle takes of soil and water: the opposite of what it gives them.
    template <int dim>
    void add_obstacles(const Snapshot<dim> &now, StatisticsRow &row)
    {
      auto obstacle = now.further.obstacles->begin();
      for (unsigned int o = 0; o < now.totals.balance.obstacles.size(); ++o, ++obstacle)
        {
          const ObstacleBalance<dim> &after   = now.totals.balance.obstacles[o],
                                     &before  = now.before.balance.obstacles[o];
          const Tensor<1, dim> impulse        = -(after.impulse + after.pressure_impulse);
          const Tensor<1, dim> impulse_before = -(before.impulse + before.pressure_impulse);
          const std::string name              = ObstacleParameters::prefix + obstacle->name + ' ';
          Tensor<1, dim> force;
          for (unsigned int a = 0; a < dim; ++a)
            force[a] = now.mean_rate(impulse[a], impulse_before[a]);
          add_value(row, name + "force", "N", force);
          for (unsigned int r = 0; r < ObstacleBalance<dim>::n_rotations; ++r)
            add_value(row,
                      name + "moment " + (dim == 2 ? 'z' : "xyz"[r]),
                      "N m",
                      now.mean_rate(-after.moment_impulse[r], -before.moment_impulse[r]));
          add_value(row, name + "impulse", "N s", impulse);
          add_value(row, name + "dissipation", "J", after.dissipation);
          if (obstacle->is_moving)
            {
              add_value(row, name + "work", "J", after.work);
              add_value(row, name + "displacement", "m", obstacle->displacement());
            }
        }
    }


    /// The x below which these parts of the mass are.
    template <int dim, typename Phases>
    void add_fronts(const Snapshot<dim> &now, const Phases &phases, const std::string &name, StatisticsRow &row)
    {
      const auto fronts = mass_percentiles(phases, now.grid, { 0.90, 0.99, 0.995 });
      add_value(row, name + " 90 %", "m", fronts[0]);
      add_value(row, name + " 99 %", "m", fronts[1]);
      add_value(row, name + " 99.5 %", "m", fronts[2]);
    }


    template <int dim>
    void add_soil(const Snapshot<dim> &now, StatisticsRow &row)
    {
      const PointSums<dim> &sums  = now.sums;
      const UpdateReport &updates = now.totals.material;
      const MotionNumbers &motion = now.motion;
      add_fronts(now, now.bodies, "Front", row);
      add_value(row, "Height", "m", std::max(sums.height, now.grid.lower_corner()[dim - 1]));
      add_value(row, "Stress oscillation", "-", stress_oscillation(now.bodies, now.grid));
      add_value(row, "Mean effective stress", "Pa", sums.soil_points > 0 ? sums.pressure / sums.soil_points : 0.);
      add_value(row, "Largest effective stress", "Pa", sums.largest_pressure);
      add_value(row, "Separated points", "", Utilities::MPI::sum(now.last_step.n_separated, now.grid.communicator()));
      add_value(row, "Substeps per update", "", updates.n_updates > 0 ? updates.n_substeps / updates.n_updates : 0.);
      add_value(row, "Fallbacks", "", updates.n_fallbacks);
      add_value(row, "Vertices", "", updates.n_vertices);
      add_value(row, "Unresolved", "", updates.n_unresolved);
      add_value(row, "Speed 99 %", "m/s", motion.speed);
      add_value(row, "Moving part", "-", motion.moving_part);
      add_value(row, "Moving thickness", "cells", motion.thickness);
      add_value(row, "Run-out length", "m", motion.length);
      add_value(row, "Fall height", "m", motion.fall);
      add_value(row, "Run-out H/L", "-", motion.length > 0. ? motion.fall / motion.length : 0.);
      add_value(row, "Travel angle", "degrees", motion.travel_angle);
      add_value(row, "Deposit area", "m^2", motion.area);
      add_value(row, "Deposit volume", "m^3", motion.volume);
    }


    template <int dim>
    void add_water(const Snapshot<dim> &now, StatisticsRow &row)
    {
      const WaterMeasures water  = measure_water(now.bodies, now.water, now.grid);
      const Budget<dim> &balance = now.totals.balance, &before = now.before.balance;
      add_value(row, "Water points", "", water.n_points);
      add_value(row, "Water mass", "kg", water.mass);
      add_value(row, "Water outside soil", "kg", water.mass_outside_soil);
      add_value(row, "Water lost", "kg", now.totals.lost_water_mass);
      add_value(row, "Smallest p", "Pa", water.smallest_pressure);
      add_value(row, "Largest p", "Pa", water.largest_pressure);
      add_value(row, "p oscillation", "-", pressure_oscillation(now.water, now.grid));
      add_value(row, "Volume error", "-", water.volume_error);
      add_fronts(now, now.water, "Water front", row);
      add_value(row, "Water tip", "m", water.tip);
      if (!now.bodies.empty())
        add_value(row, "Largest porosity", "-", now.sums.largest_porosity);
      add_value(row, "Drag dissipation", "J", balance.drag_dissipation);
      add_value(row, "Cavitating corners", "", now.mean_of_steps(balance.n_cavitating, before.n_cavitating));
      add_value(row, "CG iterations per step", "", now.mean_of_steps(balance.n_iterations, before.n_iterations));
      add_value(row, "Preconditioners built", "", balance.n_preconditioners);
      if (now.further.viscosity)
        {
          add_value(row, "Viscous dissipation", "J", balance.viscous_dissipation);
          add_value(row,
                    "Viscous iterations per step",
                    "",
                    now.mean_of_steps(balance.n_viscous_iterations, before.n_viscous_iterations));
        }
    }


    /// All columns of a scene, in their order. Collective.
    template <int dim>
    StatisticsRow row_of(const Snapshot<dim> &now)
    {
      const RunBalance<dim> &totals      = now.totals;
      const Budget<dim> &balance         = totals.balance;
      const BalanceState<dim> state      = now.balance();
      const SceneFeatures<dim> &features = now.further;
      StatisticsRow row;
      add_value(row, "Time", "s", now.time);
      add_value(row, "Step", "", now.step);
      add_value(row, "Time step", "s", now.time_step);
      add_value(row, "Points", "", now.sums.soil_points);
      add_value(row, "Mass", "kg", now.sums.soil_mass);
      add_value(row, "Momentum", "N s", now.sums.momentum);
      add_value(row, "Momentum residual", "N s", state.momentum_residual());
      add_value(row, "Kinetic energy", "J", now.sums.kinetic);
      add_value(row, "Potential energy", "J", now.sums.potential);
      add_value(row, "Elastic energy", "J", now.sums.elastic);
      add_value(row, "Plastic dissipation", "J", totals.material.plastic_dissipation);
      add_value(row, "Wall dissipation", "J", balance.wall_dissipation);
      add_value(row, "Numerical dissipation", "J", state.numerical_dissipation());
      if (!now.bodies.empty())
        add_soil(now, row);
      add_value(row, "Points lost", "", totals.n_lost);
      add_value(row, "Mass lost", "kg", totals.lost_mass);
      if (!now.water.empty())
        add_water(now, row);
      if (features.bed != nullptr)
        {
          add_value(row, "Bed dissipation", "J", balance.bed_dissipation);
          add_value(row, "Bed impulse", "N s", -balance.bed_impulse);
          add_value(row, "Least distance from bed", "m", least_distance(now, *features.bed));
        }
      if (features.obstacles != nullptr)
        add_obstacles(now, row);
      if (features.inflows)
        {
          add_value(row, "Points entered", "", totals.n_entered);
          add_value(row, "Mass entered", "kg", totals.entered_mass);
          if (!now.water.empty())
            add_value(row, "Water entered", "kg", totals.entered_water_mass);
          add_value(row, "Momentum entered", "N s", totals.entered_momentum);
          add_value(row, "Energy entered", "J", totals.entered_energy);
        }
      if (features.contacts)
        add_value(row, "Contact dissipation", "J", balance.contact_dissipation);
      if (features.loads)
        add_value(row, "Load work", "J", balance.load_work);
      if (features.pressure_work)
        add_value(row, "Pressure work", "J", balance.pressure_work);
      if (features.volume_correction)
        add_value(row, "Volume correction work", "J", balance.correction_work);
      for (const auto &[name, add] : registered_columns<dim>())
        add(now, row);
      return row;
    }
  } // namespace


  template <int dim>
  Snapshot<dim> Statistics<dim>::collect(const std::list<SoilBody<dim>> &bodies,
                                         const std::list<WaterPhase<dim>> &water,
                                         const RunBalance<dim> &local,
                                         const double time,
                                         const unsigned long long step,
                                         const double time_step,
                                         const UpdateReport &last_step)
  {
    const Snapshot<dim> now{ grid,
                             gravity,
                             further,
                             bodies,
                             water,
                             history,
                             last_step,
                             PointSums<dim>(bodies, water, gravity, grid),
                             bodies.empty() ? MotionNumbers() : motion.look(bodies, time),
                             local.sum_over_ranks(grid.communicator()),
                             time,
                             step,
                             time_step };
    if (BalanceStart<dim> &start = history.start; !start.is_known)
      {
        const BalanceState<dim> balance = now.balance();
        start = { true, balance.momentum() - now.totals.impulse(), balance.kept_energy(), false };
      }
    history.balance.obstacles.resize(now.totals.balance.obstacles.size());
    last_row        = row_of(now);
    history.step    = step;
    history.time    = time;
    history.balance = now.totals.balance;
    return now;
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
  void Statistics<dim>::print_last_row(std::ostream &out) const
  {
    out << std::scientific << std::setprecision(10);
    for (const auto &[column, value] : last_row)
      out << column << ": " << value << '\n';
  }

  template class Statistics<2>;
  template class Statistics<3>;
} // namespace scree
