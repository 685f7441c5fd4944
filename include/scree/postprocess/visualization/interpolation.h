// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_visualization_interpolation_h
#define scree_postprocess_visualization_interpolation_h

#include <scree/mesh/nodal_field.h>

#include <deal.II/base/geometry_info.h>

#include <array>

namespace scree
{
  /// Velocity of a solved field, m/s, at the place `x` (in cell widths from the lower corner) of a cell of this rank.
  template <int dim>
  dealii::Tensor<1, dim> velocity_at(const dealii::Point<dim> &x,
                                     const BackgroundGrid<dim> &grid,
                                     const unsigned int cell,
                                     const NodalField<dim> &field);

  /// Velocity of the water relative to the soil, m/s, at the place `x` of a cell; nodes that only one of them reaches
  /// do not count.
  template <int dim>
  dealii::Tensor<1, dim> relative_velocity_at(const dealii::Point<dim> &x,
                                              const BackgroundGrid<dim> &grid,
                                              const unsigned int cell,
                                              const NodalField<dim> &soil,
                                              const NodalField<dim> &water);

  /// The pressure, Pa, at the place `x` (in cell widths from the lower corner) of a cell with the given values at its
  /// corners: linear along each axis.
  template <int dim>
  double pressure_at(const dealii::Point<dim> &x, const std::array<double, (1 << dim)> &corners)
  {
    double pressure = 0;
    for (unsigned int corner = 0; corner < corners.size(); ++corner)
      pressure += corners[corner] * dealii::GeometryInfo<dim>::d_linear_shape_function(x, corner);
    return pressure;
  }
} // namespace scree

#endif
