// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_contact_row_h
#define scree_scheme_contact_row_h

#include <scree/grid/cell_basis.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <cstring>

namespace scree
{
  /// A number of each of a cell's nodes, in vectors of four with zeros at the end: a sum over nodes of doubles one
  /// after the other would wait for each of its additions.
  template <int dim, int n>
  class OfCell
  {
    using Vector = double __attribute__((vector_size(4 * sizeof(double))));

  public:
    static constexpr unsigned int n_nodes   = CellBasis<dim, n>::n_nodes;
    static constexpr unsigned int n_vectors = (n_nodes + 3) / 4;
    static constexpr unsigned int n_doubles = 4 * n_vectors;

    OfCell() = default;

    /// @param values n_doubles of them
    explicit OfCell(const double *values)
    {
      std::memcpy(vectors, values, sizeof(vectors));
    }

    void set(const unsigned int node, const double value)
    {
      vectors[node / 4][node % 4] = value;
    }
    double get(const unsigned int node) const
    {
      return vectors[node / 4][node % 4];
    }

    /// Sum of products.
    double product(const OfCell &other) const
    {
      Vector sum = vectors[0] * other.vectors[0];
      for (unsigned int v = 1; v < n_vectors; ++v)
        sum += vectors[v] * other.vectors[v];
      return (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }

    /// Products node by node.
    OfCell times(const OfCell &other) const
    {
      OfCell result;
      for (unsigned int v = 0; v < n_vectors; ++v)
        result.vectors[v] = vectors[v] * other.vectors[v];
      return result;
    }

    /// Adds `factor` times other numbers.
    void add(const double factor, const OfCell &other)
    {
      for (unsigned int v = 0; v < n_vectors; ++v)
        vectors[v] += factor * other.vectors[v];
    }

  private:
    Vector vectors[n_vectors] = {};
  };


  /// The shape functions A_i at the foot of a point in contact, and the mobility sum A_i^2/m_i of the point there.
  template <int dim, int n>
  struct ContactRow
  {
    static constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes;
    using OfNodes                         = std::array<double, n_nodes>;

    OfNodes shape;
    double mobility; ///< 1/kg

    /// The functions of the point's own cell, also where the foot is outside: A_i = phi_i(x - d n). Beside light nodes
    /// these would let a small impulse do much; then A_i = phi_i(x) - d n . grad phi_i(x).
    ///
    /// @param place of the point in its cell
    /// @param to_foot - d n, in cell widths
    /// @param inverse_masses of the nodes, 1/kg; 0 where no soil is
    /// @param most_mobility 1/kg
    ContactRow(const dealii::Point<dim> &place,
               const dealii::Tensor<1, dim> &to_foot,
               const OpenKnots open,
               const OfNodes &inverse_masses,
               const double most_mobility)
    {
      set(product(CellBasis<dim, n>(place + to_foot, open).value), inverse_masses);
      if (mobility <= most_mobility)
        return;
      const CellBasis<dim, n> at_point(place, open);
      OfNodes row = product(at_point.value);
      for (unsigned int a = 0; a < dim; ++a)
        {
          auto factors        = at_point.value;
          factors[a]          = at_point.derivative[a];
          const OfNodes slope = product(factors);
          for (unsigned int i = 0; i < n_nodes; ++i)
            row[i] += to_foot[a] * slope[i];
        }
      set(row, inverse_masses);
    }

  private:
    /// The products of factors along the axes, the first axis fastest.
    static OfNodes product(const std::array<std::array<double, n>, dim> &factors)
    {
      OfNodes result;
      result[0]         = 1.;
      unsigned int size = 1;
      for (unsigned int a = dim; a-- > 0; size *= n)
        for (unsigned int j = size; j-- > 0;)
          for (unsigned int i = n; i-- > 0;)
            result[j * n + i] = result[j] * factors[a][i];
      return result;
    }

    /// Takes the functions at nodes with soil.
    void set(const OfNodes &row, const OfNodes &inverse_masses)
    {
      mobility = 0.;
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          shape[i] = inverse_masses[i] > 0. ? row[i] : 0.;
          mobility += shape[i] * shape[i] * inverse_masses[i];
        }
    }
  };
} // namespace scree

#endif
