// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_momentum_nodal_forces_h
#define scree_momentum_nodal_forces_h

#include <scree/boundary/body_forces.h>
#include <scree/mesh/node_values.h>

namespace scree
{
  /// Sums over nodes: how far a state is from equilibrium, and how it moves there.
  struct NodalForces
  {
    double unbalanced = 0, ///< squares of the out-of-balance forces, N^2
        weight        = 0, ///< squares of the weights, N^2
        kinetic       = 0; ///< twice the kinetic energy of the soil's motion, J

    /// Of all ranks. Collective.
    NodalForces sum_over_ranks(const MPI_Comm communicator) const;

    /// Root mean square of the out-of-balance forces over that of the weights.
    double ratio() const;
  };

  /// Adds the nodes with soil of a solved field: mass times acceleration, with the reactions of walls and beds, where
  /// no damping acts. With water, mass and forces are those of the mixture, and the motion is the soil's: what seeps
  /// through soil at rest does not count.
  /// @param water null in a dry scene
  template <int dim>
  void add_nodal_forces(const NodalField<dim> &soil,
                        const NodalField<dim> *water,
                        const BodyForces<dim> &forces,
                        const double time_step,
                        NodalForces &sums);
} // namespace scree

#endif
