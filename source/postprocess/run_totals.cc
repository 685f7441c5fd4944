// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/postprocess/run_totals.h>
#include <scree/step/values_of.h>

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
    RunTotals total                    = *this;
    const std::vector<double *> values = values_of(total);

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
