// SPDX-License-Identifier: LGPL-2.1-or-later
// Columns of the bed and of obstacles. Each feels the opposite of what soil and water do.
#include <scree/postprocess/statistics/column.h>

namespace scree
{
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
