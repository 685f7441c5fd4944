// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_viscous_force_h
#define scree_transfer_viscous_force_h

#include <scree/points/suspension.h>
#include <scree/points/water_parameters.h>
#include <scree/points/water_phase.h>
#include <scree/transfer/velocity_transfer.h>

#include <list>

namespace scree
{
  /// Viscous stress 2 mu dev(sym grad v) of velocities at the nodes, and its force on them, -K v = -sum V 2 mu dev(sym
  /// grad v) grad phi_i over the points: symmetric, and blind to motion of a rigid body, so that it changes neither
  /// momentum nor moment of momentum. The transfer between points and nodes does not matter.
  ///
  /// Water has its viscosity in the volume that it takes. Soil that has lost contact (see Suspension) has what its
  /// grains add, in its whole volume: mu_s less n mu, so that grains and water that move as one have mu_s.
  template <int dim>
  class ViscousForce
  {
  public:
    ViscousForce(const BackgroundGrid<dim> &grid, const WaterParameters &water);

    /// Adds the force on this rank's points, of the velocity of `motion`, whose ghosts hold values, to that of `field`.
    void add(const WaterPhase<dim> &water, const NodalField<dim> &motion, NodalField<dim> &field) const;
    void add(const SoilBody<dim> &soil, const NodalField<dim> &motion, NodalField<dim> &field) const;

    /// A bound on the rates, 1/s, at which viscosity slows any motion of nodes with lumped masses, for this rank's
    /// points: the largest eigenvalue of M^-1 K is at most max 2 mu V/m sum |grad phi_i|^2/phi_i, by the inequality of
    /// Cauchy and Schwarz for |sum grad phi_i v_i|^2.
    double largest_rate(const WaterPhase<dim> &water) const;
    double largest_rate(const SoilBody<dim> &soil) const;

  private:
    /// Viscosity times volume of a point, Pa s m^3 (2D: per m), from its properties.
    auto coefficient_of(const WaterPhase<dim> &water) const;
    auto coefficient_of(const SoilBody<dim> &soil) const;

    template <int n, typename Coefficient>
    void add_points(const PointSet<dim> &points,
                    const Coefficient &coefficient,
                    const NodalField<dim> &motion,
                    NodalField<dim> &field) const;

    template <int n, typename Coefficient>
    double
    largest_rate(const PointSet<dim> &points, const unsigned int mass_slot, const Coefficient &coefficient) const;

    const BackgroundGrid<dim> &grid;
    const double viscosity; // of the water, Pa s
    const Suspension suspension;
  };
} // namespace scree

#endif
