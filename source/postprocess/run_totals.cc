// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/run_totals.h>

#include <deal.II/base/mpi.h>

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
  Tensor<1, dim> RunTotals<dim>::impulse() const
  {
    return balance.wall_impulse + balance.body_impulse + balance.pressure_impulse + balance.load_impulse +
           balance.bed_impulse + balance.obstacle_impulse() + entered_momentum - lost_momentum;
  }


  template <int dim>
  double RunTotals<dim>::energy_taken() const
  {
    return plastic_dissipation + balance.wall_dissipation + balance.bed_dissipation + balance.contact_dissipation +
           balance.drag_dissipation + balance.viscous_dissipation + lost_energy - balance.load_work -
           balance.correction_work - balance.obstacle_energy() - entered_energy;
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
                                  &balance.motion,
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

  template struct RunTotals<2>;
  template struct RunTotals<3>;
} // namespace scree
