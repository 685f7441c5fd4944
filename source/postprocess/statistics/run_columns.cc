// SPDX-License-Identifier: LGPL-2.1-or-later
// Columns of all scenes, and of what enters, leaves and does work.
#include <scree/postprocess/statistics/column.h>

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
} // namespace scree
