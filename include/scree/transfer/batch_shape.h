// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_batch_shape_h
#define scree_transfer_batch_shape_h

#include <scree/mesh/node_rows.h>
#include <scree/particles/cell_points.h>
#include <scree/simd/records.h>

#include <deal.II/base/config.h>

namespace scree
{
  /// A batch of points as the nodes of their cell see it.
  template <int dim, int n>
  struct BatchShape
  {
    const OpenKnots open;                 ///< walls that the cell touches
    const std::array<Batch, dim> x;       ///< places in the cell
    const CellBasis<dim, n, Batch> basis; ///< shape functions along the axes

    /// Evaluates the shape functions.
    /// @param places of the points in the cell, from 0 to 1 along each axis
    BatchShape(const RecordPointers<const double> &places, const OpenKnots open)
        : open(open)
        , x(read(places))
        , basis(x, open)
    {
    }

  private:
    static std::array<Batch, dim> read(const RecordPointers<const double> &places)
    {
      std::array<Batch, dim> x;
      simd::load_records<dim>(places, x.data());
      return x;
    }
  };


  /// phi_i (x_i - x) along each axis, m.
  ///
  /// @param x places in the cell
  template <int dim, int n>
  std::array<std::array<Batch, n>, dim> moment_factors(const CellBasis<dim, n, Batch> &basis,
                                                       const std::array<Batch, dim> &x,
                                                       const OpenKnots open,
                                                       const double width)
  {
    std::array<std::array<Batch, n>, dim> factors;
    for (unsigned int a = 0; a < dim; ++a)
      {
        const auto positions = CellBasis<dim, n>::node_positions(open, a);
        for (unsigned int i = 0; i < n; ++i)
          factors[a][i] = basis.value[a][i] * (width * (positions[i] - x[a]));
      }
    return factors;
  }


  /// A point of a batch as the nodes of its cell see it: what LaneShapes has of its lane.
  template <int dim, int n>
  struct LaneShape
  {
    /// Numbers by axis and node.
    using Factors = std::array<std::array<double, n>, dim>;

    /// Factors that the axes other than the first contribute to a row of nodes.
    struct Rows
    {
      std::array<double, RowFactors<dim, n>::n_rows> value; ///< products of shape functions
    };

    /// Shape functions along the axes.
    struct Basis
    {
      Factors value;      ///< shape functions
      Factors derivative; ///< per cell width
    };

    dealii::Point<dim> x; ///< place in the cell
    OpenKnots open;       ///< walls that the cell touches
    Basis basis;          ///< shape functions along the axes
    Factors moment;       ///< see moment_factors(), m
    Rows rows;            ///< factors of the axes other than the first
    NodeRow value_x;      ///< shape functions along the first axis
  };


  /// The shape functions of a batch, in memory, from where kernels that take one point after the other read them: the
  /// lanes of all points are computed at once, and a number that is read into all lanes costs no shuffle.
  template <int dim, int n>
  class LaneShapes
  {
  public:
    /// @param width of the cell, m
    DEAL_II_ALWAYS_INLINE LaneShapes(const BatchShape<dim, n> &shape, const double width)
        : open(shape.open)
    {
      const auto moments = moment_factors<dim, n>(shape.basis, shape.x, shape.open, width);
      for (unsigned int a = 0; a < dim; ++a)
        {
          simd::store(shape.x[a], x[a]);
          for (unsigned int i = 0; i < n; ++i)
            {
              simd::store(shape.basis.value[a][i], value[a][i]);
              simd::store(shape.basis.derivative[a][i], derivative[a][i]);
              simd::store(moments[a][i], moment[a][i]);
            }
        }
    }

    /// The point of a lane; only what the caller reads of it is loaded.
    DEAL_II_ALWAYS_INLINE LaneShape<dim, n> operator[](const unsigned int lane) const
    {
      LaneShape<dim, n> shape;
      shape.open = open;
      for (unsigned int a = 0; a < dim; ++a)
        {
          shape.x[a] = x[a][lane];
          for (unsigned int i = 0; i < n; ++i)
            {
              shape.basis.value[a][i]      = value[a][i][lane];
              shape.basis.derivative[a][i] = derivative[a][i][lane];
              shape.moment[a][i]           = moment[a][i][lane];
            }
        }
      for (unsigned int r = 0; r < shape.rows.value.size(); ++r)
        shape.rows.value[r] = dim == 2 ? value[1][r % n][lane] : value[1][r % n][lane] * value[dim - 1][r / n][lane];
      shape.value_x = make_row(shape.basis.value[0]);
      return shape;
    }

  private:
    const OpenKnots open;
    double x[dim][batch_size], value[dim][n][batch_size], derivative[dim][n][batch_size], moment[dim][n][batch_size];
  };


  /// Calls `act(point, shape)` with a PointView of each of a cell's points and its LaneShape, for all of a set's cells
  /// in turn.
  ///
  /// @param n_read of a point's properties, from the first on: memory is asked for these ahead
  /// @param open walls that the cell touches
  /// @param width of the cell, m
  template <int n, int dim, typename Number, typename Act>
  DEAL_II_ALWAYS_INLINE inline void for_each_record_with_shape(const CellPoints<dim, Number> &cell,
                                                               const unsigned int n_read,
                                                               const OpenKnots open,
                                                               const double width,
                                                               const Act &act)
  {
    for_each_batch(cell.n_points, [&](const BatchIndices &indices, const unsigned int n_used) DEAL_II_ALWAYS_INLINE {
      RecordPointers<const double> places;
      for (unsigned int l = 0; l < batch_size; ++l)
        places[l] = apart(&cell.reference_location_of(indices[l])[0]);
      const LaneShapes<dim, n> shapes(BatchShape<dim, n>(places, open), width);
      for (unsigned int l = 0; l < n_used; ++l)
        {
          const unsigned int p = indices[0] + l;
          cell.prefetch_after(p, n_read);
          act(
              PointView<dim, Number>{
                  cell.cell, cell.properties_of(p), cell.location_of(p), cell.reference_location_of(p) },
              shapes[l]);
        }
    });
  }
} // namespace scree

#endif
