// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/statistics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Columns of all scenes, and of what enters, leaves and does work.
// Columns of the bed and of obstacles. Each feels the opposite of what soil and water do.

namespace scree
{
  namespace
  {
    template <int dim>
    double numerical_dissipation(const Snapshot<dim> &now)
    {
      return now.before.start_energy - now.energy() - now.totals.energy_taken();
    }


    const RegisterColumns run_columns(
        ColumnTopic::run,
        Always(),
        Column{ "Time", "s", [](const auto &now) { return now.time; } },
        Column{ "Step", "", [](const auto &now) { return now.step; } },
        Column{ "Time step", "s", [](const auto &now) { return now.time_step; } },
        Column{ "Points", "", [](const auto &now) { return now.sums.soil_points; } },
        Column{ "Mass", "kg", [](const auto &now) { return now.sums.soil_mass; } },
        Column{ "Momentum", "N s", [](const auto &now) { return now.sums.momentum; } },
        Column{ "Momentum residual",
                "N s",
                [](const auto &now) { return (now.momentum() - now.before.start_momentum - now.impulse()).norm(); } },
        Column{ "Kinetic energy", "J", [](const auto &now) { return now.sums.kinetic; } },
        Column{ "Potential energy", "J", [](const auto &now) { return now.sums.potential; } },
        Column{ "Elastic energy", "J", [](const auto &now) { return now.sums.elastic; } },
        Column{ "Plastic dissipation", "J", [](const auto &now) { return now.totals.plastic_dissipation; } },
        Column{ "Wall dissipation", "J", [](const auto &now) { return now.totals.balance.wall_dissipation; } },
        Column{ "Numerical dissipation", "J", [](const auto &now) { return numerical_dissipation(now); } });

    const RegisterColumns
        lost_columns(ColumnTopic::lost,
                     Always(),
                     Column{ "Points lost", "", [](const auto &now) { return now.totals.n_lost; } },
                     Column{ "Mass lost", "kg", [](const auto &now) { return now.totals.lost_mass; } });

    const RegisterColumns inflow_columns(
        ColumnTopic::inflows,
        [](const auto &now) { return now.further.inflows; },
        Column{ "Points entered", "", [](const auto &now) { return now.totals.n_entered; } },
        Column{ "Mass entered", "kg", [](const auto &now) { return now.totals.entered_mass; } },
        Column{ "Water entered",
                "kg",
                [](const auto &now) { return now.totals.entered_water_mass; },
                [](const auto &now) { return !now.water.empty(); } },
        Column{ "Momentum entered", "N s", [](const auto &now) { return now.totals.entered_momentum; } },
        Column{ "Energy entered", "J", [](const auto &now) { return now.totals.entered_energy; } });

    const RegisterColumns work_columns(ColumnTopic::work,
                                       Always(),
                                       Column{ "Contact dissipation",
                                               "J",
                                               [](const auto &now) { return now.totals.balance.contact_dissipation; },
                                               [](const auto &now) { return now.further.contacts; } },
                                       Column{ "Load work",
                                               "J",
                                               [](const auto &now) { return now.totals.balance.load_work; },
                                               [](const auto &now) { return now.further.loads; } },
                                       Column{ "Volume correction work",
                                               "J",
                                               [](const auto &now) { return now.totals.balance.correction_work; },
                                               [](const auto &now) { return now.further.volume_correction; } });
  } // namespace


  namespace
  {
    template <int dim>
    double n_separated(const Snapshot<dim> &now)
    {
      return dealii::Utilities::MPI::sum(double(now.last_step.n_separated), now.grid.communicator());
    }


    const RegisterColumns soil_columns(
        ColumnTopic::soil,
        [](const auto &now) { return !now.bodies.empty(); },
        Column{ "Front 90 %", "m", [](const auto &now) { return now.fronts[0]; } },
        Column{ "Front 99 %", "m", [](const auto &now) { return now.fronts[1]; } },
        Column{ "Front 99.5 %", "m", [](const auto &now) { return now.fronts[2]; } },
        Column{ "Height",
                "m",
                [](const auto &now) { return std::max(now.sums.height, now.grid.lower_corner()[now.dimension - 1]); } },
        Column{ "Stress oscillation", "-", [](const auto &now) { return stress_oscillation(now.bodies, now.grid); } },
        Column{
            "Mean effective stress",
            "Pa",
            [](const auto &now) { return now.sums.soil_points > 0 ? now.sums.pressure / now.sums.soil_points : 0.; } },
        Column{ "Largest effective stress", "Pa", [](const auto &now) { return now.sums.largest_pressure; } },
        Column{ "Separated points", "", [](const auto &now) { return n_separated(now); } },
        Column{ "Substeps per update",
                "",
                [](const auto &now) {
                  return now.totals.n_updates > 0 ? now.totals.n_substeps / now.totals.n_updates : 0.;
                } },
        Column{ "Fallbacks", "", [](const auto &now) { return now.totals.n_fallbacks; } },
        Column{ "Vertices", "", [](const auto &now) { return now.totals.n_vertices; } },
        Column{ "Unresolved", "", [](const auto &now) { return now.totals.n_unresolved; } });

    const RegisterColumns motion_columns(
        ColumnTopic::soil,
        [](const auto &now) { return !now.bodies.empty(); },
        Column{ "Speed 99 %", "m/s", [](const auto &now) { return now.motion.speed; } },
        Column{ "Moving part", "-", [](const auto &now) { return now.motion.moving_part; } },
        Column{ "Moving thickness", "cells", [](const auto &now) { return now.motion.thickness; } },
        Column{ "Run-out length", "m", [](const auto &now) { return now.motion.length; } },
        Column{ "Fall height", "m", [](const auto &now) { return now.motion.fall; } },
        Column{ "Run-out H/L",
                "-",
                [](const auto &now) { return now.motion.length > 0. ? now.motion.fall / now.motion.length : 0.; } },
        Column{ "Travel angle", "degrees", [](const auto &now) { return now.motion.travel_angle; } },
        Column{ "Deposit area", "m^2", [](const auto &now) { return now.motion.area; } },
        Column{ "Deposit volume", "m^3", [](const auto &now) { return now.motion.volume; } });
  } // namespace


  namespace
  {
    const auto is_viscous = [](const auto &now) { return now.further.viscosity; };

    const RegisterColumns water_columns(
        ColumnTopic::water,
        [](const auto &now) { return !now.water.empty(); },
        Column{ "Water points", "", [](const auto &now) { return now.of_water.n_points; } },
        Column{ "Water mass", "kg", [](const auto &now) { return now.of_water.mass; } },
        Column{ "Water outside soil", "kg", [](const auto &now) { return now.of_water.mass_outside_soil; } },
        Column{ "Water lost", "kg", [](const auto &now) { return now.totals.lost_water_mass; } },
        Column{ "Smallest p", "Pa", [](const auto &now) { return now.of_water.smallest_pressure; } },
        Column{ "Largest p", "Pa", [](const auto &now) { return now.of_water.largest_pressure; } },
        Column{ "p oscillation", "-", [](const auto &now) { return pressure_oscillation(now.water, now.grid); } },
        Column{ "Volume error", "-", [](const auto &now) { return now.of_water.volume_error; } },
        Column{ "Water front 90 %", "m", [](const auto &now) { return now.water_fronts[0]; } },
        Column{ "Water front 99 %", "m", [](const auto &now) { return now.water_fronts[1]; } },
        Column{ "Water front 99.5 %", "m", [](const auto &now) { return now.water_fronts[2]; } },
        Column{ "Water tip", "m", [](const auto &now) { return now.of_water.tip; } },
        Column{ "Largest porosity",
                "-",
                [](const auto &now) { return now.sums.largest_porosity; },
                [](const auto &now) { return !now.bodies.empty(); } },
        Column{ "Drag dissipation", "J", [](const auto &now) { return now.totals.balance.drag_dissipation; } },
        Column{ "Cavitating corners",
                "",
                [](const auto &now) {
                  return now.mean_of_steps(now.totals.balance.n_cavitating, now.before.n_cavitating);
                } },
        Column{ "CG iterations per step",
                "",
                [](const auto &now) {
                  return now.mean_of_steps(now.totals.balance.n_iterations, now.before.n_iterations);
                } },
        Column{ "Preconditioners built", "", [](const auto &now) { return now.totals.balance.n_preconditioners; } },
        Column{ "Viscous dissipation",
                "J",
                [](const auto &now) { return now.totals.balance.viscous_dissipation; },
                is_viscous },
        Column{ "Viscous iterations per step",
                "",
                [](const auto &now) {
                  return now.mean_of_steps(now.totals.balance.n_viscous_iterations, now.before.n_viscous_iterations);
                },
                is_viscous });
  } // namespace


  namespace
  {
    template <int dim>
    StatisticsRow obstacle_row(const Snapshot<dim> &now)
    {
      StatisticsRow row;
      auto obstacle = now.further.obstacles->begin();
      for (unsigned int o = 0; o < now.totals.balance.obstacles.size(); ++o, ++obstacle)
        {
          const ObstacleBalance<dim> &after = now.totals.balance.obstacles[o], &before = now.before.obstacles[o];
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


    const auto has_bed = [](const auto &now) { return now.further.bed != nullptr; };

    const RegisterColumns rigid_columns(
        ColumnTopic::rigid,
        Always(),
        Column{ "Bed dissipation", "J", [](const auto &now) { return now.totals.balance.bed_dissipation; }, has_bed },
        Column{ "Bed impulse", "N s", [](const auto &now) { return -now.totals.balance.bed_impulse; }, has_bed },
        Column{ "Least distance from bed",
                "m",
                [](const auto &now) {
                  return least_distance(now.bodies, now.water, *now.further.bed, now.grid.communicator());
                },
                has_bed },
        Column{ "Obstacles",
                "",
                [](const auto &now) { return obstacle_row(now); },
                [](const auto &now) { return now.further.obstacles != nullptr && !now.further.obstacles->empty(); } });
  } // namespace
} // namespace scree
