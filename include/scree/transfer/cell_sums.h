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
  /// Mass, momentum and force of a cell's points at its nodes: one kernel for points of soil and of water.
  ///
  /// Lanes are the numbers of a node, in as many parts as they take registers. Lane by lane a point gives node
  /// (i, j, k)
  ///
  /// f_i f_j f_k value + g_i f_j f_k slope_0 + f_i g_j f_k slope_1 + f_i f_j g_k slope_2
  ///
  /// with the shape functions f of the axes. For the force, g is the derivative of f; for the momentum, f times the
  /// node's distance from the point.
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

    /// Adds m phi_i and m phi_i (v + C (x_i - x)), with C = 0 for FLIP and PIC.
    ///
    /// @param velocity the point's slots
    /// @param affine its slots of the affine field, which FLIP and PIC do not read
    template <TransferMethod method>
    DEAL_II_ALWAYS_INLINE inline void
    add_momentum(const PointShape<dim, n> &shape, const double mass, const double *velocity, const double *affine)
    {
      add<true, false, carries_affine(method)>(
          shape, momentum_of(mass, velocity), affine_momentum<method>(shape, width, mass, affine), no_stress);
    }

    /// Adds -V sigma grad phi_i.
    ///
    /// @param stress symmetric, dim x dim, Pa
    template <typename Matrix>
    DEAL_II_ALWAYS_INLINE inline void
    add_force(const PointShape<dim, n> &shape, const double volume, const Matrix &stress)
    {
      add<false, true, false>(shape, {}, {}, force_of(volume, stress));
    }

    /// Adds both.
    template <TransferMethod method, typename Matrix>
    DEAL_II_ALWAYS_INLINE inline void add(const PointShape<dim, n> &shape,
                                          const double mass,
                                          const double *velocity,
                                          const double *affine,
                                          const double volume,
                                          const Matrix &stress)
    {
      add<true, true, carries_affine(method)>(shape,
                                              momentum_of(mass, velocity),
                                              affine_momentum<method>(shape, width, mass, affine),
                                              force_of(volume, stress));
    }

    /// Adds the sums to the field.
    void scatter(const unsigned int *nodes, NodalField<dim> &field) const
    {
      for (unsigned int i = 0; i < n_nodes; ++i)
        simd::add_doubles<Field::n_components>(reinterpret_cast<const double *>(sums[i]), field[nodes[i]]);
    }

  private:
    using Field                           = NodalField<dim>;
    using Momentum                        = std::array<double, 1 + dim>;              // after the mass
    using Matrix                          = std::array<std::array<double, dim>, dim>; // by component and axis
    static constexpr unsigned int n_nodes = dealii::Utilities::pow(n, dim);
    static constexpr unsigned int n_parts = (Field::n_components + batch_size - 1) / batch_size;
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

    template <bool with_momentum, bool with_force, bool is_affine>
    DEAL_II_ALWAYS_INLINE inline void add(const PointShape<dim, n> &shape,
                                          const Momentum &momentum,
                                          const AffineMomentum<dim, n> &affine,
                                          const Matrix &force)
    {
      add_part<0, with_momentum, with_force, is_affine>(shape, momentum, affine, force);
      if constexpr (n_parts > 1)
        add_part<1, with_momentum, with_force, is_affine>(shape, momentum, affine, force);
      if constexpr (n_parts > 2)
        add_part<2, with_momentum, with_force, is_affine>(shape, momentum, affine, force);
      if constexpr (n_parts > 3)
        add_part<3, with_momentum, with_force, is_affine>(shape, momentum, affine, force);
    }

    template <unsigned int part, bool with_momentum, bool with_force, bool is_affine>
    DEAL_II_ALWAYS_INLINE inline void add_part(const PointShape<dim, n> &shape,
                                               const Momentum &momentum,
                                               const AffineMomentum<dim, n> &affine,
                                               const Matrix &force)
    {
      constexpr unsigned int begin = part * batch_size, end = begin + batch_size;
      constexpr bool momentum_here = with_momentum && begin < Field::force;
      constexpr bool force_here    = with_force && end > Field::force;
      constexpr bool affine_here   = is_affine && momentum_here;
      constexpr bool slope_here    = force_here || affine_here;
      if constexpr (momentum_here || force_here)
        {
          [[maybe_unused]] const Batch value =
              part_of<part>([&](const unsigned int c) { return c < Field::force ? momentum[c] : 0.; });
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
          const auto add_line = [&](const Batch &of_line, const Batch &slope_of_line, const unsigned int first) {
            for (unsigned int i = 0; i < n; ++i)
              {
                Batch &sum = sums[first + i][part];
                sum += f[0][i] * of_line;
                if constexpr (slope_here)
                  sum += g(0, i) * slope_of_line;
              }
          };
          const auto add_plane =
              [&](const Batch &of_plane, const Batch &slope_0, const Batch &slope_1, const unsigned int first) {
                for (unsigned int j = 0; j < n; ++j)
                  if constexpr (slope_here)
                    add_line(f[1][j] * of_plane + g(1, j) * slope_1, f[1][j] * slope_0, first + j * n);
                  else
                    add_line(f[1][j] * of_plane, of_plane, first + j * n);
              };
          if constexpr (dim == 2)
            add_plane(value, slope[0], slope[1], 0);
          else
            for (unsigned int k = 0; k < n; ++k)
              if constexpr (slope_here)
                add_plane(f[2][k] * value + g(2, k) * slope[2], f[2][k] * slope[0], f[2][k] * slope[1], k * n * n);
              else
                add_plane(f[2][k] * value, value, value, k * n * n);
        }
    }

    const double width, inverse_width;
    Batch sums[n_nodes][n_parts] = {};
  };
} // namespace scree

#endif
