// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_cell_sums_h
#define scree_transfer_cell_sums_h

#include <scree/mesh/nodal_field.h>
#include <scree/simd/sums.h>
#include <scree/transfer/affine_field.h>

#include <algorithm>
#include <utility>

namespace scree
{
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
        : width(width)
        , inverse_width(1. / width)
    {
    }

    /// Adds m phi_i and m phi_i (v + C (x_i - x)), with C = 0 for FLIP.
    ///
    /// @param velocity the point's slots
    /// @param affine its slots of the affine field, which FLIP does not read
    template <TransferMethod method, typename Shape>
    DEAL_II_ALWAYS_INLINE inline void
    add_momentum(const Shape &shape, const double mass, const double *velocity, const double *affine)
    {
      add<true, false, carries_affine(method)>(
          shape, momentum_of(mass, velocity), affine_momentum<method, dim, n>(shape, mass, affine), no_stress);
    }

    /// Adds -V sigma grad phi_i.
    ///
    /// @param stress symmetric, dim x dim, Pa
    template <typename Shape, typename Matrix>
    DEAL_II_ALWAYS_INLINE inline void add_force(const Shape &shape, const double volume, const Matrix &stress)
    {
      add<false, true, false>(shape, {}, {}, force_of(volume, stress));
    }

    /// Adds both.
    template <TransferMethod method, typename Shape, typename Matrix>
    DEAL_II_ALWAYS_INLINE inline void add(const Shape &shape,
                                          const double mass,
                                          const double *velocity,
                                          const double *affine,
                                          const double volume,
                                          const Matrix &stress)
    {
      add<true, true, carries_affine(method)>(shape,
                                              momentum_of(mass, velocity),
                                              affine_momentum<method, dim, n>(shape, mass, affine),
                                              force_of(volume, stress));
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

  private:
    using Field                           = NodalField<dim>;
    using Momentum                        = std::array<double, 1 + dim>;              // after the mass
    using Matrix                          = std::array<std::array<double, dim>, dim>; // by component and axis
    static constexpr unsigned int n_nodes = dealii::Utilities::pow(n, dim);
    static constexpr unsigned int n_lanes = dim == 2 ? 1 + dim + dim * dim : Field::n_components;
    static constexpr unsigned int n_parts = (n_lanes + batch_size - 1) / batch_size;
    static constexpr Matrix no_stress{};

    static Momentum momentum_of(const double mass, const double *velocity)
    {
      Momentum result{ { mass } };
      for (unsigned int c = 0; c < dim; ++c)
        result[1 + c] = mass * velocity[c];
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
    add(const Shape &shape, const Momentum &momentum, const AffineMomentum<dim, n> &affine, const Matrix &force)
    {
      add_part<0, with_momentum, with_force, is_affine>(shape, momentum, affine, force);
      if constexpr (n_parts > 1)
        add_part<1, with_momentum, with_force, is_affine>(shape, momentum, affine, force);
      if constexpr (n_parts > 2)
        add_part<2, with_momentum, with_force, is_affine>(shape, momentum, affine, force);
      if constexpr (n_parts > 3)
        add_part<3, with_momentum, with_force, is_affine>(shape, momentum, affine, force);
    }

    template <unsigned int part, bool with_momentum, bool with_force, bool is_affine, typename Shape>
    DEAL_II_ALWAYS_INLINE inline void
    add_part(const Shape &shape, const Momentum &momentum, const AffineMomentum<dim, n> &affine, const Matrix &force)
    {
      constexpr unsigned int begin = part * batch_size, end = begin + batch_size;
      constexpr bool momentum_here = with_momentum && begin < Field::force;
      constexpr bool force_here    = with_force && end > Field::force;
      constexpr bool affine_here   = is_affine && momentum_here;
      if constexpr (momentum_here || force_here)
        {
          if constexpr (dim == 2)
            add_products<part, force_here, affine_here>(shape, momentum, affine, force);
          else
            add_slopes<part, force_here, affine_here>(shape, momentum, affine, force);
        }
    }

    /// The momentum's slope along an axis, in its lanes.
    template <unsigned int part>
    static DEAL_II_ALWAYS_INLINE inline Batch slope_of(const AffineMomentum<dim, n> &affine, const unsigned int a)
    {
      return part_of<part>([&](const unsigned int c) {
        return c >= Field::momentum && c < Field::force ? affine.slope[c - Field::momentum][a] : 0.;
      });
    }

    /// Two dimensions: products of a factor of each axis and a number, lane by lane.
    template <unsigned int part, bool force_here, bool affine_here, typename Shape>
    DEAL_II_ALWAYS_INLINE inline void add_products(const Shape &shape,
                                                   const Momentum &momentum,
                                                   const AffineMomentum<dim, n> &affine,
                                                   const Matrix &force)
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
              line[j] += affine.factor[1][j] * slope_of<part>(affine, 1);
              slope_of_line[j] = f * slope_of<part>(affine, 0);
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
                sum += affine.factor[0][i] * slope_of_line[j];
            }
        }
    }

    /// Three dimensions: value and slopes, component by component.
    template <unsigned int part, bool force_here, bool affine_here, typename Shape>
    DEAL_II_ALWAYS_INLINE inline void
    add_slopes(const Shape &shape, const Momentum &momentum, const AffineMomentum<dim, n> &affine, const Matrix &force)
    {
      constexpr bool slope_here = force_here || affine_here;
      const Batch value = part_of<part>([&](const unsigned int c) { return c < Field::force ? momentum[c] : 0.; });
      [[maybe_unused]] Batch slope[dim];
      if constexpr (slope_here)
        for (unsigned int a = 0; a < dim; ++a)
          slope[a] = part_of<part>([&](const unsigned int c) {
            if (c >= Field::momentum && c < Field::force)
              return affine.slope[c - Field::momentum][a];
            return c >= Field::force && c < Field::n_components ? force[c - Field::force][a] : 0.;
          });
      const auto &f = shape.basis.value;
      // g, in all lanes the same unless there are force and momentum among them
      const auto g = [&](const unsigned int a, const unsigned int i) {
        if constexpr (affine_here && force_here)
          return part_of<part>([&](const unsigned int c) {
            return c < Field::force ? affine.factor[a][i] : shape.basis.derivative[a][i];
          });
        else if constexpr (affine_here)
          return affine.factor[a][i];
        else
          return shape.basis.derivative[a][i];
      };
      for (unsigned int k = 0; k < n; ++k)
        {
          Batch of_plane = f[2][k] * value;
          if constexpr (slope_here)
            of_plane += g(2, k) * slope[2];
          for (unsigned int j = 0; j < n; ++j)
            {
              Batch of_line = f[1][j] * of_plane;
              if constexpr (slope_here)
                of_line += g(1, j) * (f[2][k] * slope[1]);
              for (unsigned int i = 0; i < n; ++i)
                {
                  Batch &sum = sums[(k * n + j) * n + i][part];
                  sum += f[0][i] * of_line;
                  if constexpr (slope_here)
                    sum += g(0, i) * (f[1][j] * (f[2][k] * slope[0]));
                }
            }
        }
    }

    const double width, inverse_width;
    Batch sums[n_nodes][n_parts] = {};
  };
} // namespace scree

#endif
