// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_base_motion_h
#define scree_boundary_base_motion_h

#include <scree/input/time_record.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace scree
{
  /// Subsection Base motion: an earthquake.
  struct BaseMotionParameters
  {
    std::string record; ///< file of time, s, and acceleration of the box an axis, m/s^2 times `scale`; empty: at rest
    double scale = 1;   ///< m/s^2 of a unit of the record

    /// Declares the subsection and its entries.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Reads the record. Throws EntryError if that fails, or at a scale without a record.
    void check(const unsigned int dim) const;
  };

  /// The motion of the box with all its walls. What is in it is described relative to the box, in whose frame the
  /// negative acceleration acts on all masses.
  template <int dim>
  class BaseMotion
  {
  public:
    /// Reads the record; throws EntryError if that fails.
    explicit BaseMotion(const BaseMotionParameters &parameters);

    /// Velocity of the box, m/s: the integral of the record, linear between its rows, 0 before and after them.
    dealii::Tensor<1, dim> velocity(const double time) const
    {
      return acceleration.integral(time);
    }

    /// Mean over a step, m/s^2: with it the velocity is met in each step, however long.
    dealii::Tensor<1, dim> mean_acceleration(const double time, const double time_step) const
    {
      return (velocity(time + time_step) - velocity(time)) / time_step;
    }

    /// Length and largest acceleration, for the log.
    std::string text() const;

  private:
    TimeRecord<dealii::Tensor<1, dim>> acceleration; // m/s^2
  };
} // namespace scree

#endif
