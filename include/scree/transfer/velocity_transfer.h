// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_velocity_transfer_h
#define scree_transfer_velocity_transfer_h

#include <scree/grid/nodal_field.h>
#include <scree/transfer/affine_field.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <cmath>

namespace scree
{
  /// Mass, momentum and force of a cell's points at its nodes: one kernel for points of soil and of water.
  template <int dim, int n>
  class CellSums
  {
    using Field = NodalField<dim>;

  public:
    static constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;

    /// @param width of the cell, m
    explicit CellSums(const double width)
        : width(width)
        , inverse_width(1. / width)
    {
    }

    /// Adds parts of one point, as the functions below make them, in one walk over the rows of nodes: a walk each costs
    /// a tenth more in three dimensions.
    template <typename... Parts>
    void add(const PointShape<dim, n> &shape, const Parts &...parts)
    {
      for (unsigned int r = 0; r < n_rows; ++r)
        (parts(shape.rows, r, sums[r]), ...);
    }

    /// m phi_i.
    static auto mass_part(const PointShape<dim, n> &shape, const double mass)
    {
      return [mass_x = shape.value_x * mass](const auto &rows, const unsigned int r, NodeRow *row) {
        row[Field::mass] += mass_x * rows.value[r];
      };
    }

    /// m phi_i (v + C (x_i - x)), with C = 0 for FLIP and PIC. What C does along the rows is added at once.
    ///
    /// @param velocity the point's slots
    /// @param affine its slots of the affine field, which FLIP and PIC do not read
    template <TransferMethod method>
    auto momentum_part(const PointShape<dim, n> &shape, const double mass, const double *velocity, const double *affine)
    {
      NodeRow momentum[dim];
      for (unsigned int c = 0; c < dim; ++c)
        momentum[c] = shape.value_x * (mass * velocity[c]);
      if constexpr (carries_affine(method))
        add_affine_momentum<method>(shape,
                                    width,
                                    mass,
                                    affine,
                                    momentum,
                                    [this](const unsigned int r, const unsigned int c, const NodeRow &part) {
                                      sums[r][Field::momentum + c] += part;
                                    });
      return [momentum](const auto &rows, const unsigned int r, NodeRow *row) {
        for (unsigned int c = 0; c < dim; ++c)
          row[Field::momentum + c] += momentum[c] * rows.value[r];
      };
    }

    /// -V sigma grad phi_i.
    ///
    /// @param stress symmetric, dim x dim, Pa
    template <typename Matrix>
    auto force_part(const PointShape<dim, n> &shape, const double volume, const Matrix &stress) const
    {
      const double scale = -volume * inverse_width;
      NodeRow along_x[dim], along_other[dim][dim - 1];
      for (unsigned int c = 0; c < dim; ++c)
        {
          along_x[c] = shape.derivative_x * (scale * stress[c][0]);
          for (unsigned int a = 1; a < dim; ++a)
            along_other[c][a - 1] = shape.value_x * (scale * stress[c][a]);
        }
      return [along_x, along_other](const auto &rows, const unsigned int r, NodeRow *row) {
        for (unsigned int c = 0; c < dim; ++c)
          {
            row[Field::force + c] += along_x[c] * rows.value[r];
            for (unsigned int a = 0; a < dim - 1; ++a)
              row[Field::force + c] += along_other[c][a] * rows.derivative[a][r];
          }
      };
    }

    /// The mass at a row of nodes.
    NodeRow &mass(const unsigned int row)
    {
      return sums[row][Field::mass];
    }

    /// Adds the sums to the field.
    void scatter(const unsigned int *nodes, NodalField<dim> &field) const
    {
      for (unsigned int r = 0; r < n_rows; ++r)
        for (unsigned int i = 0; i < n; ++i)
          {
            double *node = field[nodes[r * n + i]];
            for (unsigned int c = 0; c < Field::n_components; ++c)
              node[c] += sums[r][c][i];
          }
    }

  private:
    const double width, inverse_width;
    NodeRow sums[n_rows][Field::n_components] = {};
  };


  /// What a point takes from the nodes.
  template <int dim>
  struct PointMotion
  {
    double *velocity;                 ///< slots, m/s: changed
    double *affine;                   ///< slots of APIC, TPIC and AFLIP; else not touched
    dealii::Point<dim> *location;     ///< m: moved, unless null
    dealii::Tensor<2, dim> *gradient; ///< of the velocity, 1/s: set, unless null
  };


  /// From the velocity gradient L over the places of a step's start, 1/s, to that over the places of its end,
  /// L (I + dt L)^-1, if it is smaller: so a lone point, to which no node says anything new, does not stretch for ever
  /// at the same rate, and one that is compressed does not shrink to nothing in a finite time.
  template <int dim>
  void carry_along(double *gradient, const double time_step)
  {
    dealii::Tensor<2, dim> L;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int a = 0; a < dim; ++a)
        L[c][a] = gradient[c * dim + a];
    const dealii::Tensor<2, dim> stretch = dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) + time_step * L;
    if (!(determinant(stretch) > 0))
      return;
    const dealii::Tensor<2, dim> carried = L * invert(stretch);
    if (!(carried.norm_square() < L.norm_square()))
      return;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int a = 0; a < dim; ++a)
        gradient[c * dim + a] = carried[c][a];
  }


  /// End-of-step velocity and its change at a cell's nodes, and what they do to its points: one kernel for points of
  /// soil and of water.
  template <int dim, int n>
  class CellVelocity
  {
    static constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;

  public:
    /// @param nodes of the cell
    /// @param width of the cell, m
    CellVelocity(const unsigned int *nodes, const NodalField<dim> &field, const double width)
        : width(width)
        , inverse_width(1. / width)
    {
      for (unsigned int r = 0; r < n_rows; ++r)
        {
          std::array<const double *, n> node;
          for (unsigned int i = 0; i < n; ++i)
            node[i] = field[nodes[r * n + i]];
          for (unsigned int c = 0; c < dim; ++c)
            {
              std::array<double, n> v, dv;
              for (unsigned int i = 0; i < n; ++i)
                {
                  v[i]  = node[i][NodalField<dim>::velocity + c];
                  dv[i] = node[i][NodalField<dim>::velocity_change + c];
                }
              velocity[c][r] = make_row(v);
              change[c][r]   = make_row(dv);
            }
        }
    }

    /// Gradient at a point, 1/s.
    dealii::Tensor<2, dim> gradient(const PointShape<dim, n> &shape) const
    {
      dealii::Tensor<2, dim> result;
      for (unsigned int c = 0; c < dim; ++c)
        {
          result[c][0] = inverse_width * sum(contract(shape.rows.value, velocity[c]) * shape.derivative_x);
          for (unsigned int a = 1; a < dim; ++a)
            result[c][a] = inverse_width * sum(contract(shape.rows.derivative[a - 1], velocity[c]) * shape.value_x);
        }
      return result;
    }

    /// This velocity less another one, times a weight of each node.
    CellVelocity weighted_difference(const std::array<NodeRow, n_rows> &weight, const CellVelocity &other) const
    {
      CellVelocity difference(width);
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int r = 0; r < n_rows; ++r)
          {
            difference.velocity[c][r] = weight[r] * (velocity[c][r] - other.velocity[c][r]);
            difference.change[c][r]   = weight[r] * (change[c][r] - other.change[c][r]);
          }
      return difference;
    }

    /// This velocity and `factor` times another one; its change is set only where move<method>() reads it.
    template <TransferMethod method>
    CellVelocity plus(const double factor, const CellVelocity &other) const
    {
      CellVelocity sum(width);
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int r = 0; r < n_rows; ++r)
          {
            sum.velocity[c][r] = velocity[c][r] + factor * other.velocity[c][r];
            if constexpr (keeps_velocity(method))
              sum.change[c][r] = change[c][r] + factor * other.change[c][r];
          }
      return sum;
    }

    /// Gives a point its velocity, affine field and place at the end of a step of `time_step` s; returns the square of
    /// its speed, m^2/s^2.
    ///
    /// @param keep see kept_velocity()
    template <TransferMethod method>
    double move(const PointShape<dim, n> &shape,
                const PointMotion<dim> &point,
                const double keep,
                const double time_step) const
    {
      double square = 0;
      for (unsigned int c = 0; c < dim; ++c)
        {
          const NodeRow along       = contract(shape.rows.value, velocity[c]);
          const double new_velocity = sum(along * shape.value_x);
          double &own               = point.velocity[c];
          if constexpr (keeps_velocity(method))
            own =
                keep * (own + sum(contract(shape.rows.value, change[c]) * shape.value_x)) + (1. - keep) * new_velocity;
          else
            own = new_velocity;
          if (point.location != nullptr)
            (*point.location)[c] += time_step * new_velocity;
          square += own * own;

          if constexpr (method == TransferMethod::apic)
            affine_moment<dim, n>(shape, width, velocity[c], point.affine + c * dim);
          if (carries_gradient(method) || point.gradient != nullptr)
            {
              double slope[dim];
              slope[0] = inverse_width * sum(along * shape.derivative_x);
              for (unsigned int a = 1; a < dim; ++a)
                slope[a] = inverse_width * sum(contract(shape.rows.derivative[a - 1], velocity[c]) * shape.value_x);
              for (unsigned int a = 0; a < dim; ++a)
                {
                  if constexpr (carries_gradient(method))
                    point.affine[c * dim + a] = slope[a];
                  if (point.gradient != nullptr)
                    (*point.gradient)[c][a] = slope[a];
                }
            }
        }
      if constexpr (method == TransferMethod::aflip)
        carry_along<dim>(point.affine, time_step);
      return square;
    }

  private:
    /// To be filled.
    explicit CellVelocity(const double width)
        : width(width)
        , inverse_width(1. / width)
    {
    }

    double width, inverse_width;
    NodeRow velocity[dim][n_rows];
    NodeRow change[dim][n_rows];
  };


  /// The part of their own velocity that points keep over a step: all but what PIC damps at `pic_rate`, 1/s.
  inline double kept_velocity(const TransferMethod method, const double pic_rate, const double time_step)
  {
    return keeps_velocity(method) ? std::exp(-pic_rate * time_step) : 0.;
  }
} // namespace scree

#endif
