// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_viscosity_viscous_force_h
#define scree_viscosity_viscous_force_h

#include <scree/bodies/water_phase.h>
#include <scree/transfer/velocity_transfer.h>

namespace scree
{
  /// Viscous stress 2 mu dev(sym grad v) of velocities at the nodes, and its force on them, -K v = -sum V 2 mu dev(sym
  /// grad v) grad phi_i over the points: symmetric, and blind to motion of a rigid body, so that it changes neither
  /// momentum nor moment of momentum. The transfer between points and nodes does not matter.
  ///
  /// Water has its viscosity in the volume that it takes.
  template <int dim>
  class ViscousForce
  {
  public:
    /// Keeps a reference to the grid.
    /// @param viscosity of the water, Pa s
    ViscousForce(const BackgroundGrid<dim> &grid, const double viscosity);

    /// Adds the force of the points, of the velocity of `motion`, whose ghosts hold values, to that of `field`.
    void add(const WaterPhase<dim> &water, const NodalField<dim> &motion, NodalField<dim> &field) const;

    /// A bound on the rates, 1/s, at which viscosity slows any motion of nodes with lumped masses, for this rank's
    /// points: the largest eigenvalue of M^-1 K is at most max 2 mu V/m sum |grad phi_i|^2/phi_i, by the inequality of
    /// Cauchy and Schwarz for |sum grad phi_i v_i|^2.
    double largest_rate(const WaterPhase<dim> &water) const;

  private:
    template <int n>
    void add_points(const WaterPhase<dim> &water, const NodalField<dim> &motion, NodalField<dim> &field) const;

    template <int n>
    double bound(const WaterPhase<dim> &water) const;

    const BackgroundGrid<dim> &grid;
    const double viscosity; // Pa s
  };
} // namespace scree

#endif
