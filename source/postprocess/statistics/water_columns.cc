// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/statistics/column.h>

namespace scree
{
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
} // namespace scree
