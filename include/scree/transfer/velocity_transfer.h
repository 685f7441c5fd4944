// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_velocity_transfer_h
#define scree_transfer_velocity_transfer_h

#include <scree/tensor/matrix.h>
#include <scree/transfer/cell_sums.h>
#include <scree/transfer/transfer_parameters.h>
#include <scree/mixture/wet_nodes.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace scree
{
  /// From the velocity gradient L over the places of a step's start, 1/s, to that over the places of its end,
  /// L (I + dt L)^-1, if it is smaller: so a lone point, to which no node says anything new, does not stretch for ever
  /// at the same rate, and one that is compressed does not shrink to nothing in a finite time.
  ///
  /// @param where points concerned
  template <int dim>
  void push_forward_gradient(Batch *gradient, const double time_step, const simd::Mask<Batch> &where)
  {
    Batch stretch[dim * dim], inverse[dim * dim], carried[dim * dim];
    Batch square = simd::broadcast<Batch>(0.), carried_square = square;
    for (unsigned int c = 0; c < dim * dim; ++c)
      stretch[c] = time_step * gradient[c] + (c % (dim + 1) == 0 ? 1. : 0.);
    invert_rows<dim>(stretch, inverse);
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int a = 0; a < dim; ++a)
        {
          Batch &sum = carried[c * dim + a];
          sum        = gradient[c * dim] * inverse[a];
          for (unsigned int m = 1; m < dim; ++m)
            sum += gradient[c * dim + m] * inverse[m * dim + a];
          carried_square += sum * sum;
          square += gradient[c * dim + a] * gradient[c * dim + a];
        }
    const simd::Mask<Batch> is_smaller = where & (determinant_of_rows<dim>(stretch) > 0.) & (carried_square < square);
    for (unsigned int c = 0; c < dim * dim; ++c)
      gradient[c] = simd::select<Batch>(is_smaller, carried[c], gradient[c]);
  }


  /// Takes the growth of volume out of the dF of points that are larger than a cell: in free flight they would grow
  /// until V sigma of the first touch is any force.
  ///
  /// @param where points concerned
  template <int dim>
  void hold_volume(Batch *increment, const simd::Mask<Batch> &where)
  {
    const Batch one    = simd::broadcast<Batch>(1.);
    const Batch growth = simd::select<Batch>(where, simd::max<Batch>(determinant_of_rows<dim>(increment), one), one);
    const Batch scale  = one / (dim == 2 ? simd::sqrt<Batch>(growth) : simd::cube_root<Batch>(growth));
    for (unsigned int c = 0; c < dim * dim; ++c)
      increment[c] *= scale;
  }


  /// The same of the velocity gradient that they carry, 1/s.
  template <int dim>
  void stop_growth(Batch *gradient, const simd::Mask<Batch> &where)
  {
    const Batch zero = simd::broadcast<Batch>(0.);
    Batch growth     = gradient[0];
    for (unsigned int a = 1; a < dim; ++a)
      growth += gradient[a * (dim + 1)];
    const Batch taken = simd::select<Batch>(where, simd::max<Batch>(growth, zero), zero) * (1. / dim);
    for (unsigned int a = 0; a < dim; ++a)
      gradient[a * (dim + 1)] -= taken;
  }


  /// Values of nodes at a batch of points; what is not read is not set.
  template <int dim>
  struct NodesAtPoints
  {
    Batch velocity[dim];       ///< at the end of the step, m/s
    Batch change[dim];         ///< over the step, m/s: for methods that keep their velocity
    Batch gradient[dim * dim]; ///< of the velocity, 1/s, row-major

    /// Adds `factor` times others.
    template <TransferMethod method>
    void add(const Batch &factor, const NodesAtPoints &other)
    {
      for (unsigned int c = 0; c < dim; ++c)
        {
          velocity[c] += factor * other.velocity[c];
          if constexpr (keeps_velocity(method))
            change[c] += factor * other.change[c];
        }
      for (unsigned int c = 0; c < dim * dim; ++c)
        {
          if constexpr (carries_affine(method))
            gradient[c] += factor * other.gradient[c];
        }
    }

    /// Gives points their velocity and affine field at the end of a step of `time_step` s; returns the squares of their
    /// speeds, m^2/s^2.
    ///
    /// @param keep see kept_velocity()
    template <TransferMethod method>
    Batch update(Batch *own_velocity, Batch *affine, const double keep, const double time_step) const
    {
      Batch square = simd::broadcast<Batch>(0.);
      for (unsigned int c = 0; c < dim; ++c)
        {
          if constexpr (keeps_velocity(method))
            own_velocity[c] = keep * (own_velocity[c] + change[c]) + (1. - keep) * velocity[c];
          else
            own_velocity[c] = velocity[c];
          square += own_velocity[c] * own_velocity[c];
        }
      if constexpr (carries_affine(method))
        std::copy_n(gradient, dim * dim, affine);
      if constexpr (method == TransferMethod::aflip)
        push_forward_gradient<dim>(affine, time_step, simd::first_lanes(batch_size));
      return square;
    }
  };


  /// End-of-step velocity and its change at a cell's nodes, and what they say to its points: one kernel for points of
  /// soil and of water.
  template <int dim, int n>
  class CellVelocity
  {
    static constexpr unsigned int n_nodes = dealii::Utilities::pow(n, dim);
    static constexpr unsigned int pitch   = 2 * dim; // of nodes: velocity, then change
    using Factors                         = std::array<std::array<Batch, n>, dim>;

  public:
    /// @param nodes of the cell
    /// @param width of the cell, m
    CellVelocity(const unsigned int *nodes, const NodalField<dim> &field, const double width)
        : width(width)
    {
      static_assert(NodalField<dim>::velocity_change == NodalField<dim>::velocity + dim, "The two lie together.");
      for (unsigned int i = 0; i < n_nodes; ++i)
        std::memcpy(values + i * pitch, field[nodes[i]] + NodalField<dim>::velocity, pitch * sizeof(double));
    }

    /// This velocity less another one, times a weight of each node.
    CellVelocity weighted_difference(const std::array<double, n_nodes> &weight, const CellVelocity &other) const
    {
      CellVelocity difference(width);
      for (unsigned int i = 0; i < n_nodes; ++i)
        for (unsigned int c = 0; c < pitch; ++c)
          difference.values[i * pitch + c] = weight[i] * (values[i * pitch + c] - other.values[i * pitch + c]);
      return difference;
    }


    /// What points take by a method, and the gradient if that or the caller reads it.
    template <TransferMethod method, bool with_gradient>
    DEAL_II_ALWAYS_INLINE inline NodesAtPoints<dim> at(const BatchShape<dim, n> &shape) const
    {
      NodesAtPoints<dim> result;
      for (unsigned int c = 0; c < dim; ++c)
        {
          if constexpr (with_gradient || carries_affine(method))
            {
              result.velocity[c] =
                  contract<true>(values + c, shape.basis.value, shape.basis.derivative, result.gradient + c * dim);
              for (unsigned int a = 0; a < dim; ++a)
                result.gradient[c * dim + a] *= 1. / width;
            }
          else
            result.velocity[c] = contract<false>(values + c, shape.basis.value, shape.basis.value, nullptr);
          if constexpr (keeps_velocity(method))
            result.change[c] = contract<false>(values + dim + c, shape.basis.value, shape.basis.value, nullptr);
        }
      return result;
    }

  private:
    /// To be filled.
    explicit CellVelocity(const double width)
        : width(width)
    {
    }

    /// sum phi_i u_i of a component u. With others: into `sums` the same with the factors of one axis replaced by
    /// others, axis by axis.
    template <bool with_others>
    DEAL_II_ALWAYS_INLINE static inline Batch
    contract(const double *component, const Factors &factor, const Factors &other, Batch *sums)
    {
      Batch total{}, totals[dim] = {};
      for (unsigned int i = 0; i < n; ++i)
        {
          Batch line{}, lines[dim] = {}; // of the nodes with this i
          for (unsigned int j = 0; j < n; ++j)
            {
              // A number in two dimensions: a vector of it would cost an addition.
              std::conditional_t<dim == 2, double, Batch> column{};
              Batch other_column{}; // of those with this j, too
              if constexpr (dim == 3)
                for (unsigned int k = 0; k < n; ++k)
                  {
                    const double u = component[((k * n + j) * n + i) * pitch];
                    column += factor[2][k] * u;
                    if constexpr (with_others)
                      other_column += other[2][k] * u;
                  }
              else
                column = component[(j * n + i) * pitch];
              line += factor[1][j] * column;
              if constexpr (with_others)
                {
                  lines[1] += other[1][j] * column;
                  if constexpr (dim == 3)
                    lines[2] += factor[1][j] * other_column;
                }
            }
          total += factor[0][i] * line;
          if constexpr (with_others)
            {
              totals[0] += other[0][i] * line;
              for (unsigned int a = 1; a < dim; ++a)
                totals[a] += factor[0][i] * lines[a];
            }
        }
      if constexpr (with_others)
        std::copy_n(totals, dim, sums);
      return total;
    }

    double width;
    double values[n_nodes * pitch];
  };


  /// The part of their own velocity that points keep over a step: all but what relaxes to that of the nodes at
  /// `pic_rate`, 1/s.
  inline double kept_velocity(const TransferMethod method, const double pic_rate, const double time_step)
  {
    return keeps_velocity(method) ? std::exp(-pic_rate * time_step) : 0.;
  }

  /// Velocity of a cell's nodes as points of water take it: v_s + (n_i/n_p) (v_w - v_s), n_p the porosity about the
  /// point, 1/n_i the mean of 1/n_p over the water of a node. A discharge that does not change where soil begins moves
  /// the points by q/n_p on either side, instead of by the mean over the node's surroundings; and since
  /// sum m_p phi_i n_i/n_p is the node's mass, their momentum is that of the nodes, whatever n_p and v_s are.
  template <int dim, int n>
  class PoreVelocity
  {
  public:
    /// Whether water of any of the nodes has soil about it; else points take v_w.
    static bool differs(const unsigned int *ids, const WetNodes<dim> &nodes)
    {
      bool any = false;
      for (unsigned int i = 0; i < n_nodes; ++i)
        any |= nodes.pores[ids[i]][Pores::grain_fraction] > 0.;
      return any;
    }

    /// @param ids of the cell's nodes
    /// @param water its velocity at them
    /// @param width of the cell, m
    PoreVelocity(const unsigned int *ids,
                 const CellVelocity<dim, n> &water,
                 const WetNodes<dim> &nodes,
                 const double width)
        : grains(ids, nodes.soil, width)
        , flux(water.weighted_difference(porosities(ids, nodes), grains))
    {
    }

    /// What points take that have 1 over this porosity about them.
    template <TransferMethod method>
    NodesAtPoints<dim> at(const BatchShape<dim, n> &shape, const Batch &inverse_porosity) const
    {
      NodesAtPoints<dim> result = grains.template at<method, false>(shape);
      result.template add<method>(inverse_porosity, flux.template at<method, false>(shape));
      return result;
    }

  private:
    static constexpr unsigned int n_nodes = dealii::Utilities::pow(n, dim);

    /// n_i
    static std::array<double, n_nodes> porosities(const unsigned int *ids, const WetNodes<dim> &nodes)
    {
      std::array<double, n_nodes> result;
      for (unsigned int i = 0; i < n_nodes; ++i)
        result[i] = nodes.porosity(ids[i]);
      return result;
    }

    const CellVelocity<dim, n> grains; // v_s
    const CellVelocity<dim, n> flux;   // n_i (v_w - v_s)
  };
} // namespace scree

#endif
