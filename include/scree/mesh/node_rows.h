// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_node_rows_h
#define scree_mesh_node_rows_h

#include <scree/mesh/cell_basis.h>

namespace scree
{
  /// The up to three nodes of a cell along the first axis, as one register (the fourth lane stays 0). A compiler vector
  /// because Debian builds deal.II's VectorizedArray with a single lane.
  using NodeRow = double __attribute__((vector_size(4 * sizeof(double))));

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

  /// Four numbers that lie behind each other, on no boundary in particular.
  inline NodeRow load_row(const double *values)
  {
    NodeRow row;
    std::memcpy(&row, values, sizeof(row));
    return row;
  }

  /// Adds a row to numbers that lie behind each other.
  inline void add_row(const NodeRow &row, double *values)
  {
    NodeRow sum;
    std::memcpy(&sum, values, sizeof(sum));
    sum += row;
    std::memcpy(values, &sum, sizeof(sum));
  }

  /// Sum over the three nodes.
  inline double sum(const NodeRow &row)
  {
    return (row[0] + row[1]) + row[2];
  }

  /// A row of two or three numbers, filled up with 0.
  template <std::size_t n>
  NodeRow make_row(const std::array<double, n> &values)
  {
    if constexpr (n == 2)
      return NodeRow{ values[0], values[1], 0., 0. };
    else
      return NodeRow{ values[0], values[1], values[2], 0. };
  }

  /// A vector in a row.
  template <int dim>
  NodeRow to_row(const dealii::Tensor<1, dim> &vector)
  {
    NodeRow row{};
    for (unsigned int c = 0; c < dim; ++c)
      row[c] = vector[c];
    return row;
  }

  /// The vector that a row begins with.
  template <int dim>
  dealii::Tensor<1, dim> to_vector(const NodeRow &row)
  {
    dealii::Tensor<1, dim> vector;
    for (unsigned int c = 0; c < dim; ++c)
      vector[c] = row[c];
    return vector;
  }

  /// The factors that the axes other than the first contribute to a row of nodes: product of their shape functions, and
  /// the same with one of them differentiated.
  template <int dim, int n>
  struct RowFactors
  {
    static constexpr unsigned int n_rows = dealii::Utilities::pow(n, dim - 1); ///< rows of nodes in a cell

    std::array<double, n_rows> value;                           ///< products of shape functions
    std::array<std::array<double, n_rows>, dim - 1> derivative; ///< per cell width, along axes 1, 2

    /// Multiplies the shape functions at a point.
    explicit RowFactors(const CellBasis<dim, n> &basis)
    {
      for (unsigned int j = 0; j < n; ++j)
        if constexpr (dim == 2)
          {
            value[j]         = basis.value[1][j];
            derivative[0][j] = basis.derivative[1][j];
          }
        else
          for (unsigned int k = 0; k < n; ++k)
            {
              value[k * n + j]         = basis.value[1][j] * basis.value[2][k];
              derivative[0][k * n + j] = basis.derivative[1][j] * basis.value[2][k];
              derivative[1][k * n + j] = basis.value[1][j] * basis.derivative[2][k];
            }
    }
  };

  /// A point as the nodes of its cell see it.
  template <int dim, int n>
  struct PointShape
  {
    const dealii::Point<dim> &x;   ///< place in the cell
    const OpenKnots open;          ///< walls that the cell touches
    const CellBasis<dim, n> basis; ///< shape functions along the axes
    const RowFactors<dim, n> rows; ///< factors of the axes other than the first
    const NodeRow value_x,         ///< shape functions along the first axis
        derivative_x;              ///< their derivatives, per cell width

    /// Evaluates the shape functions.
    /// @param x place in the cell, from 0 to 1 along each axis; must live on
    /// @param open walls that the cell touches
    PointShape(const dealii::Point<dim> &x, const OpenKnots open)
        : x(x)
        , open(open)
        , basis(x, open)
        , rows(basis)
        , value_x(make_row(basis.value[0]))
        , derivative_x(make_row(basis.derivative[0]))
    {
    }
  };

  /// sum over the rows of factor times values
  template <std::size_t n_rows>
  NodeRow contract(const std::array<double, n_rows> &factor, const NodeRow (&values)[n_rows])
  {
    NodeRow result = values[0] * factor[0];
    for (unsigned int r = 1; r < n_rows; ++r)
      result += values[r] * factor[r];
    return result;
  }
} // namespace scree

#endif
