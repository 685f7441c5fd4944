// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_viscosity_viscous_force_h
#define scree_viscosity_viscous_force_h

#include <scree/bodies/suspension.h>
#include <scree/bodies/water_parameters.h>
#include <scree/bodies/water_phase.h>
#include <scree/transfer/velocity_transfer.h>

#include <vector>

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
    /// Keeps a reference to the grid.
    ViscousForce(const BackgroundGrid<dim> &grid, const WaterParameters &water);

    /// Viscosity times volume of this rank's points, Pa s m^3 (2D: per m), in their order; empty if all are 0.
    std::vector<double> coefficients(const WaterPhase<dim> &water) const;

    /// The same of suspended soil.
    std::vector<double> coefficients(const SoilBody<dim> &soil) const;

    /// Adds the force of points with these coefficients, of the velocity of `motion`, whose ghosts hold values, to that
    /// of `field`.
    void add(const PointSet<dim> &points,
             const std::vector<double> &coefficients,
             const NodalField<dim> &motion,
             NodalField<dim> &field) const;

    /// A bound on the rates, 1/s, at which viscosity slows any motion of nodes with lumped masses, for this rank's
    /// points: the largest eigenvalue of M^-1 K is at most max 2 mu V/m sum |grad phi_i|^2/phi_i, by the inequality of
    /// Cauchy and Schwarz for |sum grad phi_i v_i|^2.
    /// @param mass_slot of the points
    double largest_rate(const PointSet<dim> &points,
                        const std::vector<double> &coefficients,
                        const unsigned int mass_slot) const;

  private:
    template <int n>
    void add_points(const PointSet<dim> &points,
                    const std::vector<double> &coefficients,
                    const NodalField<dim> &motion,
                    NodalField<dim> &field) const;

    template <int n>
    double
    bound(const PointSet<dim> &points, const std::vector<double> &coefficients, const unsigned int mass_slot) const;

    const BackgroundGrid<dim> &grid;
    const double viscosity; // of the water, Pa s
    const Suspension suspension;
  };
} // namespace scree

#endif
