// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_cell_sums_h
#define scree_transfer_cell_sums_h

#include <scree/mesh/node_rows.h>
#include <scree/mesh/node_values.h>
#include <scree/particles/cell_points.h>
#include <scree/simd/records.h>
#include <scree/transfer/transfer_parameters.h>

#include <deal.II/base/config.h>

#include <algorithm>
#include <utility>

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


  /// Mass, momentum and force of a cell's points at its nodes: one kernel for points of soil and of water. A point
  /// gives node (i, j, k), component by component,
  ///
  /// f_i f_j f_k value + g_i f_j f_k slope_0 + f_i g_j f_k slope_1 + f_i f_j g_k slope_2
  ///
  /// with the shape functions f of the axes. For the force, g is the derivative of f; for the momentum, f times the
  /// node's distance from the point.
  ///
  /// In three dimensions lanes are the components, in as many parts as they take registers. In two, the two terms of a
  /// force have lanes of their own, with their f or g, so that a point gives each node but one product of three factors
  /// (and one more for the affine momentum); they are added in the end.
  template <int dim, int n>
  class CellSums
  {
  public:
    /// @param width of the cell, m
    explicit CellSums(const double width)
        : inverse_width(1. / width)
    {
    }

    /// Adds m phi_i and m phi_i (v + C (x_i - x)), with C = 0 unless the momentum `is_affine`.
    ///
    /// @param velocity the point's slots
    /// @param affine its slots of the affine field, if it is read
    template <bool is_affine, typename Shape>
    DEAL_II_ALWAYS_INLINE inline void
    add_momentum(const Shape &shape, const double mass, const double *velocity, const double *affine)
    {
      add<true, false, is_affine>(shape, momentum_of(mass, velocity), slope_of<is_affine>(mass, affine), {});
    }

    /// Adds -V sigma grad phi_i.
    ///
    /// @param stress symmetric, dim x dim, Pa
    template <typename Shape, typename Stress>
    DEAL_II_ALWAYS_INLINE inline void add_force(const Shape &shape, const double volume, const Stress &stress)
    {
      add<false, true, false>(shape, {}, {}, force_of(volume, stress));
    }

    /// Adds both.
    template <bool is_affine, typename Shape, typename Stress>
    DEAL_II_ALWAYS_INLINE inline void add(const Shape &shape,
                                          const double mass,
                                          const double *velocity,
                                          const double *affine,
                                          const double volume,
                                          const Stress &stress)
    {
      add<true, true, is_affine>(
          shape, momentum_of(mass, velocity), slope_of<is_affine>(mass, affine), force_of(volume, stress));
    }

    /// Adds the sums to the field.
    void scatter(const unsigned int *nodes, NodalField<dim> &field) const
    {
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          const double *sum = reinterpret_cast<const double *>(sums[i]);
          double *values    = field[nodes[i]];
          if constexpr (dim == 2)
            {
              simd::TwoDoubles force, other;
              std::memcpy(&force, sum + Field::force, sizeof(force));
              std::memcpy(&other, sum + Field::force + dim, sizeof(other));
              force += other;
              simd::add_doubles<Field::force>(sum, values);
              simd::add_doubles<dim>(reinterpret_cast<const double *>(&force), values + Field::force);
            }
          else
            simd::add_doubles<Field::n_components>(sum, values);
        }
    }

    /// Adds the sums of momentum to other values, from a component on.
    template <typename Values>
    void scatter_momentum(const unsigned int *nodes, const unsigned int first, Values &values) const
    {
      for (unsigned int i = 0; i < n_nodes; ++i)
        simd::add_doubles<dim>(reinterpret_cast<const double *>(sums[i]) + 1, values[nodes[i]] + first);
    }

  private:
    using Field                           = NodalField<dim>;
    using Momentum                        = std::array<double, 1 + dim>;              // after the mass
    using Matrix                          = std::array<std::array<double, dim>, dim>; // by component and axis
    static constexpr unsigned int n_nodes = dealii::Utilities::pow(n, dim);
    static constexpr unsigned int n_lanes = dim == 2 ? 1 + dim + dim * dim : Field::n_components;
    static constexpr unsigned int n_parts = (n_lanes + batch_size - 1) / batch_size;

    static Momentum momentum_of(const double mass, const double *velocity)
    {
      Momentum result{ { mass } };
      for (unsigned int c = 0; c < dim; ++c)
        result[1 + c] = mass * velocity[c];
      return result;
    }

    /// m C, kg/s.
    template <bool is_affine>
    static Matrix slope_of(const double mass, [[maybe_unused]] const double *affine)
    {
      Matrix result{};
      if constexpr (is_affine)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int a = 0; a < dim; ++a)
            result[c][a] = mass * affine[c * dim + a];
      return result;
    }

    /// What the derivatives of the shape functions multiply, N.
    template <typename Stress>
    Matrix force_of(const double volume, const Stress &stress) const
    {
      const double scale = -volume * inverse_width;
      Matrix result;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int a = 0; a < dim; ++a)
          result[c][a] = scale * stress[c][a];
      return result;
    }

    /// A part of a node's numbers, from a function of the number.
    template <unsigned int part, typename Function>
    static DEAL_II_ALWAYS_INLINE inline Batch part_of(const Function &function)
    {
      return part_of<part>(function, std::make_index_sequence<batch_size>());
    }
    template <unsigned int part, typename Function, std::size_t... lane>
    static DEAL_II_ALWAYS_INLINE inline Batch part_of(const Function &function, std::index_sequence<lane...>)
    {
      return Batch{ function(part * batch_size + lane)... };
    }

    template <bool with_momentum, bool with_force, bool is_affine, typename Shape>
    DEAL_II_ALWAYS_INLINE inline void
    add(const Shape &shape, const Momentum &momentum, const Matrix &slope, const Matrix &force)
    {
      add_part<0, with_momentum, with_force, is_affine>(shape, momentum, slope, force);
      if constexpr (n_parts > 1)
        add_part<1, with_momentum, with_force, is_affine>(shape, momentum, slope, force);
      if constexpr (n_parts > 2)
        add_part<2, with_momentum, with_force, is_affine>(shape, momentum, slope, force);
      if constexpr (n_parts > 3)
        add_part<3, with_momentum, with_force, is_affine>(shape, momentum, slope, force);
    }

    template <unsigned int part, bool with_momentum, bool with_force, bool is_affine, typename Shape>
    DEAL_II_ALWAYS_INLINE inline void
    add_part(const Shape &shape, const Momentum &momentum, const Matrix &slope, const Matrix &force)
    {
      constexpr unsigned int begin = part * batch_size, end = begin + batch_size;
      constexpr bool momentum_here = with_momentum && begin < Field::force;
      constexpr bool force_here    = with_force && end > Field::force;
      constexpr bool affine_here   = is_affine && momentum_here;
      if constexpr (momentum_here || force_here)
        {
          if constexpr (dim == 2)
            add_products<part, force_here, affine_here>(shape, momentum, slope, force);
          else
            add_slopes<part, force_here, affine_here>(shape, momentum, slope, force);
        }
    }

    /// The momentum's slope along an axis, in its lanes.
    template <unsigned int part>
    static DEAL_II_ALWAYS_INLINE inline Batch slope_along(const Matrix &slope, const unsigned int a)
    {
      return part_of<part>([&](const unsigned int c) {
        return c >= Field::momentum && c < Field::force ? slope[c - Field::momentum][a] : 0.;
      });
    }

    /// Two dimensions: products of a factor of each axis and a number, lane by lane.
    template <unsigned int part, bool force_here, bool affine_here, typename Shape>
    DEAL_II_ALWAYS_INLINE inline void
    add_products(const Shape &shape, const Momentum &momentum, const Matrix &slope, const Matrix &force)
    {
      const Batch value = part_of<part>([&](const unsigned int c) {
        const unsigned int of_force = c - Field::force;
        return c < Field::force ? momentum[c] : c < n_lanes ? force[of_force % dim][of_force / dim] : 0.;
      });
      // f, or g in the lanes of the force that have the derivative along this axis
      const auto factor = [&](const unsigned int a, const unsigned int i) {
        const Batch f = simd::broadcast<Batch>(shape.basis.value[a][i]);
        if constexpr (!force_here)
          return f;
        const simd::Mask<Batch> is_derived = part_of<part>([&](const unsigned int c) {
                                               const bool here = c >= Field::force + a * dim;
                                               return here && c < Field::force + (a + 1) * dim ? 1. : 0.;
                                             }) > 0.;
        return simd::select<Batch>(is_derived, simd::broadcast<Batch>(shape.basis.derivative[a][i]), f);
      };
      Batch line[n], slope_of_line[n];
      for (unsigned int j = 0; j < n; ++j)
        {
          const Batch f = factor(1, j);
          line[j]       = f * value;
          if constexpr (affine_here)
            {
              line[j] += shape.moment[1][j] * slope_along<part>(slope, 1);
              slope_of_line[j] = f * slope_along<part>(slope, 0);
            }
        }
      for (unsigned int i = 0; i < n; ++i)
        {
          const Batch f = factor(0, i);
          for (unsigned int j = 0; j < n; ++j)
            {
              Batch &sum = sums[j * n + i][part];
              sum += f * line[j];
              if constexpr (affine_here)
                sum += shape.moment[0][i] * slope_of_line[j];
            }
        }
    }

    /// Three dimensions: value and slopes, component by component.
    template <unsigned int part, bool force_here, bool affine_here, typename Shape>
    DEAL_II_ALWAYS_INLINE inline void
    add_slopes(const Shape &shape, const Momentum &momentum, const Matrix &slope, const Matrix &force)
    {
      constexpr bool slope_here = force_here || affine_here;
      const Batch value = part_of<part>([&](const unsigned int c) { return c < Field::force ? momentum[c] : 0.; });
      [[maybe_unused]] Batch slopes[dim];
      if constexpr (slope_here)
        for (unsigned int a = 0; a < dim; ++a)
          slopes[a] = part_of<part>([&](const unsigned int c) {
            if (c >= Field::momentum && c < Field::force)
              return slope[c - Field::momentum][a];
            return c >= Field::force && c < Field::n_components ? force[c - Field::force][a] : 0.;
          });
      const auto &f = shape.basis.value;
      // g, in all lanes the same unless there are force and momentum among them
      const auto g = [&](const unsigned int a, const unsigned int i) {
        if constexpr (affine_here && force_here)
          return part_of<part>([&](const unsigned int c) {
            return c < Field::force ? shape.moment[a][i] : shape.basis.derivative[a][i];
          });
        else if constexpr (affine_here)
          return shape.moment[a][i];
        else
          return shape.basis.derivative[a][i];
      };
      for (unsigned int k = 0; k < n; ++k)
        {
          Batch of_plane = f[2][k] * value;
          if constexpr (slope_here)
            of_plane += g(2, k) * slopes[2];
          for (unsigned int j = 0; j < n; ++j)
            {
              Batch of_line = f[1][j] * of_plane;
              if constexpr (slope_here)
                of_line += g(1, j) * (f[2][k] * slopes[1]);
              for (unsigned int i = 0; i < n; ++i)
                {
                  Batch &sum = sums[(k * n + j) * n + i][part];
                  sum += f[0][i] * of_line;
                  if constexpr (slope_here)
                    sum += g(0, i) * (f[1][j] * (f[2][k] * slopes[0]));
                }
            }
        }
    }

    const double inverse_width;
    Batch sums[n_nodes][n_parts] = {};
  };
} // namespace scree

#endif
