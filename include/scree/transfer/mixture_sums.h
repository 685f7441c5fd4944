// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_mixture_sums_h
#define scree_transfer_mixture_sums_h

#include <scree/transfer/water_transfer.h>

#include <cstring>
#include <type_traits>

namespace scree
{
  // What a point of soil or water adds to the sums of its cell of the mixture.

  using EightDoubles = double __attribute__((vector_size(8 * sizeof(double)))); ///< a register of eight doubles

  /// A number for each corner of a cell, in registers: numbers that are stored one by one and read as a vector wait for
  /// each other.
  template <int dim>
  using VertexRow = std::conditional_t<dim == 2, NodeRow, EightDoubles>;

  /// `upper` at the corners on the upper face of an axis, `lower` at the others.
  template <int dim>
  DEAL_II_ALWAYS_INLINE inline VertexRow<dim> on_faces(const unsigned int axis, const double lower, const double upper)
  {
    VertexRow<dim> row;
    for (unsigned int v = 0; v < (1 << dim); ++v)
      row[v] = v >> axis & 1 ? upper : lower;
    return row;
  }

  /// The linear functions of a cell's corners at one of its points.
  template <int dim>
  DEAL_II_ALWAYS_INLINE inline VertexRow<dim> vertex_values(const dealii::Point<dim> &x)
  {
    VertexRow<dim> values = on_faces<dim>(0, 1. - x[0], x[0]);
    for (unsigned int a = 1; a < dim; ++a)
      values *= on_faces<dim>(a, 1. - x[a], x[a]);
    return values;
  }

  /// Adds a row to sums of a cell.
  template <int dim>
  DEAL_II_ALWAYS_INLINE inline void add_row(const VertexRow<dim> &row, typename MixtureCell<dim>::AtVertices &sums)
  {
    VertexRow<dim> sum;
    std::memcpy(&sum, sums.data(), sizeof(sum));
    sum += row;
    std::memcpy(sums.data(), &sum, sizeof(sum));
  }

  /// The monomials x^m of places of a cell but that of all axes, bit a of m standing for x_a.
  template <int dim, typename Number, typename Place>
  std::array<Number, (1 << dim) - 1> monomials(const Place &x)
  {
    std::array<Number, (1 << dim) - 1> values;
    values[0] = simd::broadcast<Number>(1.);
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int m = 0; m < (1u << a); ++m)
        if (const unsigned int with = m | (1 << a); with < values.size())
          values[with] = values[m] * x[a];
    return values;
  }

  /// Adds a point's number, shared by the shape functions, to rows of nodes.
  template <typename Shape, unsigned long n_rows>
  DEAL_II_ALWAYS_INLINE inline void add_row_sums(const Shape &shape, const double number, NodeRow (&sums)[n_rows])
  {
    const NodeRow number_x = shape.value_x * number;
    for (unsigned int r = 0; r < n_rows; ++r)
      sums[r] += number_x * shape.rows.value[r];
  }

  /// Adds rows of nodes to a component of the pores.
  template <int dim, int n, unsigned long n_rows>
  void
  scatter(const NodeRow (&sums)[n_rows], const unsigned int *nodes, const unsigned int component, PoreField<dim> &pores)
  {
    for (unsigned int r = 0; r < n_rows; ++r)
      for (unsigned int i = 0; i < n; ++i)
        pores[nodes[r * n + i]][component] += sums[r][i];
  }

  /// Adds volume and pressure of a point of water to the corners of its cell.
  ///
  /// @param rise of the pressure along each axis over the cell's width, Pa
  template <int dim>
  DEAL_II_ALWAYS_INLINE inline void add_to_vertices(const dealii::Point<dim> &x,
                                                    const double volume,
                                                    const double pressure,
                                                    const std::array<double, dim> &rise,
                                                    MixtureCell<dim> &sums)
  {
    double pressure_at_lower = pressure;
    for (unsigned int a = 0; a < dim; ++a)
      pressure_at_lower -= rise[a] * x[a];
    VertexRow<dim> pressure_at_vertex = on_faces<dim>(0, pressure_at_lower, pressure_at_lower + rise[0]);
    for (unsigned int a = 1; a < dim; ++a)
      pressure_at_vertex += on_faces<dim>(a, 0., rise[a]);
    const VertexRow<dim> volume_at_vertex = volume * vertex_values(x);
    add_row<dim>(volume_at_vertex, sums.water_at_vertex);
    add_row<dim>(volume_at_vertex * pressure_at_vertex, sums.pressure_at_vertex);
  }
} // namespace scree

#endif
