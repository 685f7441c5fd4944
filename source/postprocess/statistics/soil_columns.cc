// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/statistics/column.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
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
} // namespace scree
