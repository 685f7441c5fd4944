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
  void add_nodal_forces(const NodalField<dim> &soil,
                        const NodalField<dim> *water,
                        const BodyForces<dim> &forces,
                        const double time_step,
                        NodalForces &sums)
  {
    using Field          = NodalField<dim>;
    const double gravity = forces.fall().norm();
    for (const unsigned int node : soil.active_nodes())
      if (const double *of_soil = soil[node]; of_soil[Field::mass] > 0.)
        {
          double mass            = of_soil[Field::mass];
          Tensor<1, dim> impulse = mass * vector_of<dim>(of_soil + Field::velocity_change);
          if (water != nullptr)
            {
              const double *of_water = (*water)[node];
              mass += of_water[Field::mass];
              impulse += of_water[Field::mass] * vector_of<dim>(of_water + Field::velocity_change);
            }
          sums.unbalanced += (impulse / time_step).norm_square();
          sums.weight += mass * gravity * mass * gravity;
          sums.kinetic += mass * vector_of<dim>(of_soil + Field::velocity).norm_square();
        }
  }

  template void
  add_nodal_forces(const NodalField<2> &, const NodalField<2> *, const BodyForces<2> &, const double, NodalForces &);
  template void
  add_nodal_forces(const NodalField<3> &, const NodalField<3> *, const BodyForces<3> &, const double, NodalForces &);
} // namespace scree
