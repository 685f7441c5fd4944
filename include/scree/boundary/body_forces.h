// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_body_forces_h
#define scree_boundary_body_forces_h

#include <scree/mesh/background_grid.h>
#include <scree/boundary/base_motion.h>

#include <deal.II/base/function.h>
#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace scree
{
  /// Entry Body force: an acceleration beside gravity, for verification.
  struct BodyForceParameters
  {
    std::string expression; ///< m/s^2, of x, y (z) and t, one an axis; empty: none

    /// Declares the entry.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError unless the expression reads: x, y (z) and t, one component an axis.
    void check(const unsigned int dim) const;
  };

  /// What acts on all nodes besides stress, pressure and walls: gravity, body force, the motion of the base, and the
  /// damping of the settling.
  template <int dim>
  class BodyForces
  {
  public:
    /// Reads expression and record; throws EntryError if that fails.
    /// @param gravity m/s^2, one number an axis
    BodyForces(const BackgroundGrid<dim> &grid,
               const std::vector<double> &gravity,
               const BodyForceParameters &body_force,
               const BaseMotionParameters &base_motion);

    /// Gravity without body force and base motion, m/s^2.
    const dealii::Tensor<1, dim> &gravity() const
    {
      return own_gravity;
    }

    /// The step, s, whose accelerations are asked for next: body forces are those of its start, the base's the mean.
    void set_step(const double time, const double time_step);

    /// As set_step() before the release: the base is at rest.
    void set_start();

    /// What the log says of the base; empty if it is at rest.
    std::string text_of_base() const
    {
      return base_motion ? base_motion->text() : "";
    }

    /// Acceleration of a node, m/s^2.
    dealii::Tensor<1, dim> acceleration(const unsigned int node) const
    {
      dealii::Tensor<1, dim> sum = uniform;
      if (body_force)
        for (unsigned int c = 0; c < dim; ++c)
          sum[c] += body_force->value(grid.node_position(node), c);
      return sum;
    }

    /// Velocity decays at `rate`, 1/s; 0: it does not.
    void set_damping(const double rate)
    {
      damping_rate = rate;
    }

    /// Whether the damping of the settling is on.
    bool is_damped() const
    {
      return damping_rate > 0.;
    }

    /// What damping leaves of a velocity after a step.
    double decay(const double time_step) const;

  private:
    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> own_gravity;
    dealii::Tensor<1, dim> uniform; // gravity, and what the base's motion adds
    std::unique_ptr<dealii::Function<dim>> body_force;
    std::unique_ptr<BaseMotion<dim>> base_motion;
    double damping_rate = 0;
  };
} // namespace scree

#endif
