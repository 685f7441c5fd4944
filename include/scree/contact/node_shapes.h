// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_node_shapes_h
#define scree_contact_node_shapes_h

#include <scree/mesh/cell_basis.h>
#include <scree/simd/records.h>

#include <algorithm>
#include <array>

namespace scree
{
  /// A point, as a ball of its size.
  template <int dim>
  struct Ball
  {
    dealii::Point<dim> place; ///< in its cell
    double volume;            ///< m^3
    double radius;            ///< cell widths
  };

  /// Of points around a node, weighted by volume and shape function: volume, m^3, first and second moments of the place
  /// from the node in cell widths, the gradient of the volume with the place, and the volume times the friction
  /// coefficient.
  template <int dim>
  struct MomentLayout
  {
    static constexpr unsigned int first_moments = 1,                   ///< dim numbers, m^3
        second_moments                          = first_moments + dim, ///< lower triangle, row by row, m^3
        gradient  = second_moments + dim * (dim + 1) / 2,              ///< dim numbers, m^3 per cell width
        friction  = gradient + dim,                                    ///< m^3
        n_moments = friction + 1;                                      ///< numbers in total
  };


  /// The shape functions of a cell's nodes, a lane each, as polynomials c_0 + c_1 s + c_2 s^2 along the axes, and the
  /// moments of points under them.
  template <int dim, int n>
  class NodeShapes
  {
  public:
    using Moments = MomentLayout<dim>; ///< layout of the moments

    static constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes,              ///< nodes that act on a cell
        n_batches                         = (n_nodes + batch_size - 1) / batch_size; ///< batches of these

    OpenKnots open; ///< walls that the cell touches

    /// Finds the coefficients of the polynomials.
    /// @param open walls that the cell touches
    explicit NodeShapes(const OpenKnots open)
        : open(open)
    {
      dealii::Point<dim> end;
      const CellBasis<dim, n> at_start(end, open);
      for (unsigned int a = 0; a < dim; ++a)
        end[a] = 1.;
      const CellBasis<dim, n> at_end(end, open);
      const auto node_places = node_positions(open);
      for (unsigned int i = 0; i < n_nodes; ++i)
        for (unsigned int a = 0; a < dim; ++a)
          {
            const unsigned int b = i / batch_size, l = i % batch_size, j = along(a, i);
            const double start = at_start.value[a][j], slope = at_start.derivative[a][j];
            position[b][a][l]        = node_places[i][a];
            coefficients[b][a][0][l] = start;
            coefficients[b][a][1][l] = slope;
            coefficients[b][a][2][l] = at_end.value[a][j] - start - slope;
          }
    }

    /// The moments of points, without friction, around the nodes of batch `b`.
    void sum_moments(const unsigned int b, const Ball<dim> *ball, const Ball<dim> *end, Batch *result) const
    {
      Batch sums[Moments::friction] = {};
      for (; ball != end; ++ball)
        {
          Batch value[dim], slope[dim], x[dim];
          for (unsigned int a = 0; a < dim; ++a)
            {
              const Batch *c = coefficients[b][a];
              const double s = ball->place[a];
              x[a]           = s - position[b][a];
              value[a]       = c[0] + s * (c[1] + s * c[2]);
              slope[a]       = c[1] + (2. * s) * c[2];
            }
          Batch part = ball->volume * value[0];
          for (unsigned int a = 1; a < dim; ++a)
            part *= value[a];
          sums[0] += part;
          for (unsigned int a = 0, k = Moments::second_moments; a < dim; ++a)
            {
              const Batch moment = part * x[a];
              sums[Moments::first_moments + a] += moment;
              for (unsigned int c = 0; c <= a; ++c, ++k)
                sums[k] += moment * x[c];
              Batch along_axis = ball->volume * slope[a];
              for (unsigned int c = 0; c < dim; ++c)
                if (c != a)
                  along_axis *= value[c];
              sums[Moments::gradient + a] += along_axis;
            }
        }
      std::copy_n(sums, Moments::friction, result);
    }

    /// Of the nodes, cell widths from the cell's lower corner.
    static std::array<dealii::Point<dim>, n_nodes> node_positions(const OpenKnots open)
    {
      std::array<dealii::Point<dim>, n_nodes> result;
      for (unsigned int a = 0; a < dim; ++a)
        {
          const auto of_axis = CellBasis<dim, n>::node_positions(open, a);
          for (unsigned int i = 0; i < result.size(); ++i)
            result[i][a] = of_axis[along(a, i)];
        }
      return result;
    }

  private:
    /// Node `i` of a cell along an axis.
    static unsigned int along(const unsigned int axis, const unsigned int i)
    {
      return i / dealii::Utilities::pow(n, axis) % n;
    }

    Batch position[n_batches][dim] = {}, coefficients[n_batches][dim][3] = {};
  };
} // namespace scree

#endif
