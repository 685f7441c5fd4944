// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_output_interpolation_h
#define scree_output_interpolation_h

#include <scree/grid/nodal_field.h>

#include <deal.II/base/geometry_info.h>

#include <array>
#include <functional>

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

  /// Pressure at a corner of a cell, Pa; corners in deal.II's order (lexicographic).
  using CornerPressure = std::function<double(const unsigned int cell, const unsigned int corner)>;

  /// The pressures at the corners of one cell.
  template <int dim>
  class CellPressure
  {
  public:
    CellPressure(const CornerPressure &pressure_at_corner, const unsigned int cell)
    {
      for (unsigned int corner = 0; corner < corners.size(); ++corner)
        corners[corner] = pressure_at_corner(cell, corner);
    }

    /// Pa, at a corner.
    double operator[](const unsigned int corner) const
    {
      return corners[corner];
    }

    /// Pa, multilinear at the place `x`, in cell widths from the lower corner.
    double at(const dealii::Point<dim> &x) const
    {
      double pressure = 0;
      for (unsigned int corner = 0; corner < corners.size(); ++corner)
        pressure += corners[corner] * dealii::GeometryInfo<dim>::d_linear_shape_function(x, corner);
      return pressure;
    }

  private:
    std::array<double, dealii::GeometryInfo<dim>::vertices_per_cell> corners;
  };
} // namespace scree

#endif
