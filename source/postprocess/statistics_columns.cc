// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/statistics.h>


// Columns of all scenes, of what enters, leaves and does work, and of soil and water. Bed and obstacles feel the
// opposite of what soil and water do.

/// A function of the Snapshot `now`.
#define OF_NOW(...) [](const auto &now) { return __VA_ARGS__; }

namespace scree
{
  namespace
  {
    const RegisterColumns
        run_columns(ColumnTopic::run,
                    Always(),
                    Column{ "Time", "s", OF_NOW(now.time) },
                    Column{ "Step", "", OF_NOW(now.step) },
                    Column{ "Time step", "s", OF_NOW(now.time_step) },
                    Column{ "Points", "", OF_NOW(now.sums.soil_points) },
                    Column{ "Mass", "kg", OF_NOW(now.sums.soil_mass) },
                    Column{ "Momentum", "N s", OF_NOW(now.sums.momentum) },
                    Column{ "Momentum residual", "N s", OF_NOW(now.momentum_residual()) },
                    Column{ "Kinetic energy", "J", OF_NOW(now.sums.kinetic) },
                    Column{ "Potential energy", "J", OF_NOW(now.sums.potential) },
                    Column{ "Elastic energy", "J", OF_NOW(now.sums.elastic) },
                    Column{ "Plastic dissipation", "J", OF_NOW(now.totals.material.plastic_dissipation) },
                    Column{ "Wall dissipation", "J", OF_NOW(now.totals.balance.wall_dissipation) },
                    Column{ "Numerical dissipation", "J", OF_NOW(now.numerical_dissipation()) });

    const RegisterColumns lost_columns(ColumnTopic::lost,
                                       Always(),
                                       Column{ "Points lost", "", OF_NOW(now.totals.n_lost) },
                                       Column{ "Mass lost", "kg", OF_NOW(now.totals.lost_mass) });

    const RegisterColumns inflow_columns(
        ColumnTopic::inflows,
        OF_NOW(now.further.inflows),
        Column{ "Points entered", "", OF_NOW(now.totals.n_entered) },
        Column{ "Mass entered", "kg", OF_NOW(now.totals.entered_mass) },
        Column{ "Water entered", "kg", OF_NOW(now.totals.entered_water_mass), OF_NOW(!now.water.empty()) },
        Column{ "Momentum entered", "N s", OF_NOW(now.totals.entered_momentum) },
        Column{ "Energy entered", "J", OF_NOW(now.totals.entered_energy) });

    const RegisterColumns
        work_columns(ColumnTopic::work,
                     Always(),
                     Column{ "Contact dissipation",
                             "J",
                             OF_NOW(now.totals.balance.contact_dissipation),
                             OF_NOW(now.further.contacts) },
                     Column{ "Load work", "J", OF_NOW(now.totals.balance.load_work), OF_NOW(now.further.loads) },
                     Column{ "Volume correction work",
                             "J",
                             OF_NOW(now.totals.balance.correction_work),
                             OF_NOW(now.further.volume_correction) });


    template <int dim>
    double n_separated(const Snapshot<dim> &now)
    {
      return dealii::Utilities::MPI::sum(now.last_step.n_separated, now.grid.communicator());
    }


    const RegisterColumns soil_columns(
        ColumnTopic::soil,
        OF_NOW(!now.bodies.empty()),
        Column{ "Front 90 %", "m", OF_NOW(now.fronts[0]) },
        Column{ "Front 99 %", "m", OF_NOW(now.fronts[1]) },
        Column{ "Front 99.5 %", "m", OF_NOW(now.fronts[2]) },
        Column{ "Height", "m", OF_NOW(std::max(now.sums.height, now.grid.lower_corner()[now.dimension - 1])) },
        Column{ "Stress oscillation", "-", OF_NOW(stress_oscillation(now.bodies, now.grid)) },
        Column{ "Mean effective stress",
                "Pa",
                OF_NOW(now.sums.soil_points > 0 ? now.sums.pressure / now.sums.soil_points : 0.) },
        Column{ "Largest effective stress", "Pa", OF_NOW(now.sums.largest_pressure) },
        Column{ "Separated points", "", OF_NOW(n_separated(now)) },
        Column{ "Substeps per update",
                "",
                OF_NOW(now.totals.material.n_updates > 0
                           ? now.totals.material.n_substeps / now.totals.material.n_updates
                           : 0.) },
        Column{ "Fallbacks", "", OF_NOW(now.totals.material.n_fallbacks) },
        Column{ "Vertices", "", OF_NOW(now.totals.material.n_vertices) },
        Column{ "Unresolved", "", OF_NOW(now.totals.material.n_unresolved) },
        Column{ "Speed 99 %", "m/s", OF_NOW(now.motion.speed) },
        Column{ "Moving part", "-", OF_NOW(now.motion.moving_part) },
        Column{ "Moving thickness", "cells", OF_NOW(now.motion.thickness) },
        Column{ "Run-out length", "m", OF_NOW(now.motion.length) },
        Column{ "Fall height", "m", OF_NOW(now.motion.fall) },
        Column{ "Run-out H/L", "-", OF_NOW(now.motion.length > 0. ? now.motion.fall / now.motion.length : 0.) },
        Column{ "Travel angle", "degrees", OF_NOW(now.motion.travel_angle) },
        Column{ "Deposit area", "m^2", OF_NOW(now.motion.area) },
        Column{ "Deposit volume", "m^3", OF_NOW(now.motion.volume) });


    const auto is_viscous = OF_NOW(now.further.viscosity);

    const RegisterColumns water_columns(
        ColumnTopic::water,
        OF_NOW(!now.water.empty()),
        Column{ "Water points", "", OF_NOW(now.of_water.n_points) },
        Column{ "Water mass", "kg", OF_NOW(now.of_water.mass) },
        Column{ "Water outside soil", "kg", OF_NOW(now.of_water.mass_outside_soil) },
        Column{ "Water lost", "kg", OF_NOW(now.totals.lost_water_mass) },
        Column{ "Smallest p", "Pa", OF_NOW(now.of_water.smallest_pressure) },
        Column{ "Largest p", "Pa", OF_NOW(now.of_water.largest_pressure) },
        Column{ "p oscillation", "-", OF_NOW(pressure_oscillation(now.water, now.grid)) },
        Column{ "Volume error", "-", OF_NOW(now.of_water.volume_error) },
        Column{ "Water front 90 %", "m", OF_NOW(now.water_fronts[0]) },
        Column{ "Water front 99 %", "m", OF_NOW(now.water_fronts[1]) },
        Column{ "Water front 99.5 %", "m", OF_NOW(now.water_fronts[2]) },
        Column{ "Water tip", "m", OF_NOW(now.of_water.tip) },
        Column{ "Largest porosity", "-", OF_NOW(now.sums.largest_porosity), OF_NOW(!now.bodies.empty()) },
        Column{ "Drag dissipation", "J", OF_NOW(now.totals.balance.drag_dissipation) },
        Column{ "Cavitating corners",
                "",
                OF_NOW(now.mean_of_steps(now.totals.balance.n_cavitating, now.before.balance.n_cavitating)) },
        Column{ "CG iterations per step",
                "",
                OF_NOW(now.mean_of_steps(now.totals.balance.n_iterations, now.before.balance.n_iterations)) },
        Column{ "Preconditioners built", "", OF_NOW(now.totals.balance.n_preconditioners) },
        Column{ "Viscous dissipation", "J", OF_NOW(now.totals.balance.viscous_dissipation), is_viscous },
        Column{
            "Viscous iterations per step",
            "",
            OF_NOW(now.mean_of_steps(now.totals.balance.n_viscous_iterations, now.before.balance.n_viscous_iterations)),
            is_viscous });


    template <int dim>
    StatisticsRow obstacle_row(const Snapshot<dim> &now)
    {
      StatisticsRow row;
      auto obstacle = now.further.obstacles->begin();
      for (unsigned int o = 0; o < now.totals.balance.obstacles.size(); ++o, ++obstacle)
        {
          const ObstacleBalance<dim> &after           = now.totals.balance.obstacles[o],
                                     &before          = now.before.balance.obstacles[o];
          const dealii::Tensor<1, dim> impulse        = -(after.impulse + after.pressure_impulse);
          const dealii::Tensor<1, dim> impulse_before = -(before.impulse + before.pressure_impulse);
          const std::string name                      = ObstacleParameters::prefix + obstacle->name + ' ';
          dealii::Tensor<1, dim> force;
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
      return row;
    }


    const auto has_bed = OF_NOW(now.further.bed != nullptr);

    const RegisterColumns
        rigid_columns(ColumnTopic::rigid,
                      Always(),
                      Column{ "Bed dissipation", "J", OF_NOW(now.totals.balance.bed_dissipation), has_bed },
                      Column{ "Bed impulse", "N s", OF_NOW(-now.totals.balance.bed_impulse), has_bed },
                      Column{ "Least distance from bed",
                              "m",
                              OF_NOW(least_distance(now.bodies, now.water, *now.further.bed, now.grid.communicator())),
                              has_bed },
                      Column{ "Obstacles",
                              "",
                              OF_NOW(obstacle_row(now)),
                              OF_NOW(now.further.obstacles != nullptr && !now.further.obstacles->empty()) });
  } // namespace
} // namespace scree

#undef OF_NOW
