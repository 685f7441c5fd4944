// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/graphics.h>
#include <scree/postprocess/statistics.h>
#include <scree/tensor/vector.h>

#include <iomanip>

namespace scree
{
  using namespace dealii;

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


    /// Force of the pore pressure on each face of the box, N, of all ranks.
    template <int dim>
    std::array<double, 2 * dim> pressure_forces(const WaterView<dim> &view, const BackgroundGrid<dim> &grid)
    {
      constexpr unsigned int n = 8; // places along each axis of a cell's face: p has a kink where it is cut off at 0
      const double area        = Utilities::fixed_power<dim - 1>(grid.cell_size() / n);
      std::array<double, 2 * dim> forces{};
      std::set<unsigned int> wet_cells;
      for (const auto &water : view.water)
        for (const auto &cell : water.points().cells())
          wet_cells.insert(cell.cell);
      for (const unsigned int cell : wet_cells)
        if (const std::uint8_t walls = grid.open_knots(cell); walls != 0 && grid.numbering().has_nodes(cell))
          {
            const auto corners = view.pressure_of_cell(cell);
            for (const unsigned int face : GeometryInfo<dim>::face_indices())
              if ((walls >> face) & 1)
                for (unsigned int i = 0; i < Utilities::fixed_power<dim - 1>(n); ++i)
                  {
                    Point<dim> x;
                    for (unsigned int a = 0, rest = i; a < dim; ++a)
                      if (a == face / 2)
                        x[a] = face % 2;
                      else
                        {
                          x[a] = (rest % n + 0.5) / n;
                          rest /= n;
                        }
                    forces[face] += (face % 2 == 0 ? -1. : 1.) * area * std::max(0., pressure_at<dim>(x, corners));
                  }
          }
      Utilities::MPI::sum(ArrayView<const double>(forces.data(), forces.size()),
                          grid.communicator(),
                          ArrayView<double>(forces.data(), forces.size()));
      return forces;
    }


    /// The mean forces of soil and water on walls since the last row (what walls take of their motion; the soil's is
    /// the effective one), and the pore pressure's across the wall at this instant, of its positive part over the cells
    /// that hold water.
    template <int dim>
    void add_walls(const Snapshot<dim> &now, StatisticsRow &row)
    {
      const auto pressure = now.view ? pressure_forces(*now.view, now.grid) : std::array<double, 2 * dim>();
      for (const unsigned int face : now.further.walls)
        {
          const std::string name    = FaceEntries::names(dim)[face];
          const auto add_force_from = [&](const std::string &phase, const WallImpulses<dim> Budget<dim>::*walls) {
            Tensor<1, dim> force; // the opposite of what the wall gives
            for (unsigned int a = 0; a < dim; ++a)
              force[a] = now.mean_rate(-(now.totals.balance.*walls).of_face[face][a],
                                       -(now.before.balance.*walls).of_face[face][a]);
            add_value(row, name + phase, "N", force);
          };
          add_force_from(" soil", &Budget<dim>::soil_walls);
          if (now.water.empty())
            continue;
          add_force_from(" water", &Budget<dim>::water_walls);
          add_value(row, name + " pressure " + "xyz"[face / 2], "N", pressure[face]);
        }
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
      add_value(row, "Mean speed", "m/s", motion.mean_speed);
      add_value(row, "Toe speed", "m/s", motion.toe_speed);
      add_value(row, "Moving thickness", "cells", motion.thickness);
      add_value(row, "Toe displacement", "m", motion.toe_displacement);
      add_value(row, "Largest displacement", "m", motion.largest_displacement);
      add_value(row, "Run-out length", "m", motion.length);
      add_value(row, "Fall height", "m", motion.fall);
      add_value(row, "Run-out H/L", "-", motion.ratio);
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
      add_value(row, "Void share", "-", water.void_share);
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
      if (!now.bodies.empty())
        add_value(row, "Energy of the averaging", "J", state.averaging_energy());
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
      if (!features.walls.empty())
        add_walls(now, row);
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
      if (features.stages)
        {
          add_value(row, "Mass removed", "kg", totals.removed_mass);
          add_value(row, "Mass added", "kg", totals.added_mass);
        }
      if (features.contacts)
        add_value(row, "Contact dissipation", "J", balance.contact_dissipation);
      if (features.absorbing_walls)
        add_value(row, "Dashpot dissipation", "J", balance.dashpot_dissipation);
      if (features.loads || features.absorbing_walls)
        add_value(row, "Load work", "J", balance.load_work);
      if (features.pressure_work)
        add_value(row, "Pressure work", "J", balance.pressure_work);
      if (features.volume_correction)
        add_value(row, "Volume correction work", "J", balance.correction_work);
      for (const auto &[name, add] : registered_columns<dim>())
        add(now, row);
      return row;
    }


    /// What is judged by its mean over time: column, bound (those of the time_sums are of the stability maps), and
    /// what to do.
    struct TimeMean
    {
      const char *column;
      double bound;
      const char *remedy;
    };
    constexpr TimeMean judged_means[] = {
      { "Stress oscillation",
        0.2,
        "do not use single values of p'; write the recommended points per cell, or a smaller \"Courant number\"" },
      { "p oscillation",
        0.1,
        "do not use single values of p; write the recommended points per cell, or smaller cells" },
      { "Void share",
        0.05,
        "levels of free water are too high by this share; write the same points per cell for soil and water" }
    };
  } // namespace


  template <int dim>
  std::vector<CheckResult> Statistics<dim>::results() const
  {
    std::vector<CheckResult> list;
    for (unsigned int m = 0; m < time_sums.size(); ++m)
      if (const double mean = time_sums[m] / history.time; mean > 0.)
        {
          const auto &[column, bound, remedy] = judged_means[m];
          list.push_back({ column, short_text(mean), short_text(bound), mean > bound, remedy, Finding::resolution });
        }
    return list;
  }


  template <int dim>
  Snapshot<dim> Statistics<dim>::collect(const std::list<SoilBody<dim>> &bodies,
                                         const std::list<WaterPhase<dim>> &water,
                                         const RunBalance<dim> &local,
                                         const double time,
                                         const unsigned long long step,
                                         const double time_step,
                                         const UpdateReport &last_step,
                                         const WaterView<dim> *view)
  {
    const RunBalance<dim> totals = local.sum_over_ranks(grid.communicator());
    const Snapshot<dim> now{ grid,
                             gravity,
                             further,
                             bodies,
                             water,
                             view,
                             history,
                             last_step,
                             PointSums<dim>(bodies, water, gravity, grid),
                             bodies.empty() ? MotionNumbers() : motion.look(bodies, totals.lost_through, time),
                             totals,
                             time,
                             step,
                             time_step };
    if (BalanceStart<dim> &start = history.start; !start.is_known)
      {
        start.begin(0., 0., totals.material.averaging_work);
        const BalanceState<dim> balance = now.balance();
        start.momentum                  = balance.momentum() - now.totals.impulse();
        start.energy                    = balance.kept_energy();
        start.is_known                  = true;
      }
    history.balance.obstacles.resize(now.totals.balance.obstacles.size());
    last_row = row_of(now);
    for (const auto &[column, value] : last_row)
      for (unsigned int m = 0; m < time_sums.size(); ++m)
        if (column == std::string(judged_means[m].column) + " (-)")
          time_sums[m] += value * (time - history.time);
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
