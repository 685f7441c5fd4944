// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/momentum/nodal_forces.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  NodalForces NodalForces::sum_over_ranks(const MPI_Comm communicator) const
  {
    std::vector<double> sums{ unbalanced, weight, kinetic };
    Utilities::MPI::sum(sums, communicator, sums);
    return { sums[0], sums[1], sums[2] };
  }


  double NodalForces::ratio() const
  {
    return std::sqrt(unbalanced / weight);
  }


  template <int dim>
  void add_nodal_forces(const NodalField<dim> &field,
                        const BodyForces<dim> &forces,
                        const double time_step,
                        NodalForces &sums)
  {
    using Field          = NodalField<dim>;
    const double gravity = forces.gravity().norm();
    for (const unsigned int node : field.active_nodes())
      if (const double *values = field[node]; values[Field::mass] > 0.)
        {
          const double mass = values[Field::mass];
          sums.unbalanced += (mass / time_step * vector_of<dim>(values + Field::velocity_change)).norm_square();
          sums.weight += mass * gravity * mass * gravity;
          sums.kinetic += mass * vector_of<dim>(values + Field::velocity).norm_square();
        }
  }

  template void add_nodal_forces(const NodalField<2> &, const BodyForces<2> &, const double, NodalForces &);
  template void add_nodal_forces(const NodalField<3> &, const BodyForces<3> &, const double, NodalForces &);
} // namespace scree
