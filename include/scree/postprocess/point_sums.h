// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_point_sums_h
#define scree_postprocess_point_sums_h

#include <scree/bodies/soil_body.h>
#include <scree/bodies/water_phase.h>

#include <list>

namespace scree
{
  /// Sums over all points of all ranks (2D: per m). Momentum and energies are those of soil and water together.
  template <int dim>
  struct PointSums
  {
    double soil_points = 0;          ///< number of points
    double soil_mass   = 0;          ///< kg
    dealii::Tensor<1, dim> momentum; ///< N s
    double kinetic          = 0;     ///< of velocities and affine fields, J
    double potential        = 0;     ///< of gravity, J
    double elastic          = 0;     ///< of the soil, J
    double pressure         = 0;     ///< P of the soil, Pa, summed over points
    double largest_pressure = 0;     ///< P, Pa
    double height;                   ///< of the highest soil point, m; far below everything without soil
    double largest_porosity = 0;     ///< of soil points

    /// Collective.
    /// @param gravity m/s^2
    PointSums(const std::list<SoilBody<dim>> &bodies,
              const std::list<WaterPhase<dim>> &water,
              const dealii::Tensor<1, dim> &gravity,
              const MPI_Comm communicator);

  private:
    class Energies;

    void add(const SoilBody<dim> &body,
             const dealii::Point<dim> &x,
             const double *properties,
             const dealii::Tensor<1, dim> &gravity);

    /// Mass and velocity of a point of any phase: its momentum and energies.
    /// @param layout of the phase
    /// @param affine_inertia see TransferParameters
    template <typename Layout>
    void add_motion(const Layout &layout,
                    const double affine_inertia,
                    const double *properties,
                    const dealii::Point<dim> &x,
                    const dealii::Tensor<1, dim> &gravity);
  };
} // namespace scree

#endif
