// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_body_forces_h
#define scree_boundary_body_forces_h

#include <scree/mesh/background_grid.h>
#include <scree/boundary/body_force.h>

#include <memory>
#include <string>
#include <vector>

namespace scree
{
  /// What acts on all nodes besides stress, pressure and walls: gravity, all kinds of body force, and the
  /// damping of the trials of a factor search.
  template <int dim>
  class BodyForces
  {
  public:
    /// Makes the forces that are set; throws EntryError if that fails.
    /// @param gravity m/s^2, one number an axis
    /// @param mass_scaling mass that resists acceleration over mass that has weight
    BodyForces(const BackgroundGrid<dim> &grid,
               const std::vector<double> &gravity,
               const BodyForceParameters &parameters,
               const double mass_scaling = 1.);

    /// Gravity without other forces, m/s^2.
    const dealii::Tensor<1, dim> &gravity() const
    {
      return own_gravity;
    }

    /// Mass that resists acceleration over mass that has weight: that of the nodes over that of the points.
    double mass_scaling() const
    {
      return scaling;
    }

    /// Acceleration of what falls, m/s^2.
    dealii::Tensor<1, dim> fall() const
    {
      return own_gravity / scaling;
    }

    /// Whether nothing acts besides gravity.
    bool is_gravity_alone() const
    {
      return forces.empty();
    }

    /// The step, s, whose accelerations are asked for next.
    void set_step(const double time, const double time_step);

    /// As set_step() before the release.
    void set_start();

    /// What the log says of them, in lines; empty: nothing.
    std::string text() const;

    /// Acceleration of a node, m/s^2.
    dealii::Tensor<1, dim> acceleration(const unsigned int node) const
    {
      dealii::Tensor<1, dim> sum = uniform;
      for (const BodyForce<dim> *force : varying)
        sum += force->at(grid.node_position(node)) / scaling;
      return sum;
    }

    /// Velocity decays at `rate`, 1/s; 0: it does not.
    void set_damping(const double rate)
    {
      damping_rate = rate;
    }

    /// Whether there is damping.
    bool is_damped() const
    {
      return damping_rate > 0.;
    }

    /// What damping leaves of a velocity after a step.
    double decay(const double time_step) const;

  private:
    void sum_uniform();

    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> own_gravity;
    const std::vector<std::unique_ptr<BodyForce<dim>>> forces;
    const double scaling;                        // of masses
    std::vector<const BodyForce<dim> *> varying; // those that are not uniform
    dealii::Tensor<1, dim> uniform;              // gravity, and the other ones, over the scaling
    double damping_rate = 0;
  };
} // namespace scree

#endif
