// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_contact_lanes_h
#define scree_scheme_contact_lanes_h

#include <scree/grid/cell_basis.h>
#include <scree/scheme/contact_nodes.h>
#include <scree/simd/records.h>

#include <array>

namespace scree
{
  /// Contacts of points with rigid surfaces, a lane each, all of them in cells of their own that share no nodes.
  template <int dim>
  struct ContactLanes
  {
    Batch normal[dim];           ///< of the surface, unit, into the open
    Batch surface_velocity[dim]; ///< m/s
    Batch approach;              ///< least velocity along the normal from the surface, m/s
    Batch friction;              ///< coefficient
    Batch normal_impulse;        ///< N s, not negative
    Batch tangent_impulse[dim];  ///< N s
    Batch inertia;               ///< 1/sum A_i^2/m_i, kg; 0 where nothing can move
    Batch normal_inertia;        ///< the same along the normal with what walls hold; 0 where they hold it
    Batch mobility[dim];         ///< sum A_i^2/m_i over the nodes that are free along an axis, 1/kg
    Batch shape[dealii::Utilities::pow(3, dim)]; ///< A_i, of which linear shape functions fill a part
  };


  /// The numbers of the nodes of as many cells, a lane each.
  template <int dim, int n>
  class NodeLanes
  {
    using Nodes                             = ContactNodes<dim>;
    static constexpr unsigned int n_doubles = Nodes::n_doubles;

  public:
    static constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes;

    /// @param numbers of each cell's nodes
    NodeLanes(Nodes &nodes, const std::array<const unsigned int *, batch_size> &numbers)
        : nodes(nodes)
        , numbers(numbers)
    {
      for (unsigned int i = 0; i < n_nodes; ++i)
        simd::load_records<n_doubles>(as_constant(records(nodes.motions(), i)), values[i]);
    }

    /// Reads along which axes nodes are free, where walls hold any.
    void find_free_axes(const bool any_is_held)
    {
      is_held = any_is_held;
      if (!is_held)
        return;
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          simd::load_records<n_doubles>(as_constant(records(nodes.free_axes(), i)), axes[i]);
          for (unsigned int a = 0; a < dim; ++a)
            axes[i][a] *= inverse_mass(i);
        }
    }

    void store()
    {
      for (unsigned int i = 0; i < n_nodes; ++i)
        simd::store_records<n_doubles>(values[i], records(nodes.motions(), i));
    }

    /// 1/kg
    const Batch &inverse_mass(const unsigned int i) const
    {
      return values[i][Nodes::inverse_mass];
    }

    /// The same along an axis: 0 where walls hold the node.
    const Batch &inverse_mass(const unsigned int i, const unsigned int axis) const
    {
      return is_held ? axes[i][axis] : inverse_mass(i);
    }

    /// The velocity, m/s, at the foot of contacts with these shape functions.
    DEAL_II_ALWAYS_INLINE inline void velocity_at(const Batch *shape, Batch *velocity) const
    {
      // Several sums, as each addition would wait for the one before.
      Batch sums[n][dim];
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int a = 0; a < dim; ++a)
          sums[j][a] = shape[j] * values[j][a];
      for (unsigned int i = n; i < n_nodes; i += n)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int a = 0; a < dim; ++a)
            sums[j][a] += shape[i + j] * values[i + j][a];
      for (unsigned int a = 0; a < dim; ++a)
        {
          velocity[a] = sums[0][a];
          for (unsigned int j = 1; j < n; ++j)
            velocity[a] += sums[j][a];
        }
    }

    /// Adds impulses, N s, at the feet of contacts, as far as walls let the nodes go.
    DEAL_II_ALWAYS_INLINE inline void push(const Batch *shape, const Batch *impulse)
    {
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          const Batch response = shape[i] * inverse_mass(i);
          for (unsigned int a = 0; a < dim; ++a)
            values[i][a] += (is_held ? shape[i] * axes[i][a] : response) * impulse[a];
        }
    }

  private:
    RecordPointers<double> records(double *first, const unsigned int i) const
    {
      RecordPointers<double> result;
      for (unsigned int l = 0; l < batch_size; ++l)
        result[l] = apart(first + std::size_t(numbers[l][i]) * n_doubles);
      return result;
    }

    Nodes &nodes;
    const std::array<const unsigned int *, batch_size> numbers;
    bool is_held = false;
    Batch values[n_nodes][n_doubles];
    Batch axes[n_nodes][n_doubles]; // where walls hold any: inverse masses along the axes
  };


  /// The basis at a place in a cell each.
  /// @param open faces of the cells
  template <int dim, int n>
  CellBasis<dim, n, Batch> basis_in_lanes(const std::array<Batch, dim> &place,
                                          const std::array<OpenKnots, batch_size> &open)
  {
    CellBasis<dim, n, Batch> result(place, open[0]);
    for (unsigned int l = 1; l < batch_size; ++l)
      if (open[l] != open[0]) // beside a wall
        {
          std::array<double, dim> own_place;
          for (unsigned int a = 0; a < dim; ++a)
            own_place[a] = place[a][l];
          const CellBasis<dim, n> own(own_place, open[l]);
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int i = 0; i < n; ++i)
              {
                result.value[a][i][l]      = own.value[a][i];
                result.derivative[a][i][l] = own.derivative[a][i];
              }
        }
    return result;
  }


  /// Sets the shape functions A_i at the feet of points in contact and the mobility sum A_i^2/m_i of the points there.
  ///
  /// They are the functions of the point's own cell, also where the foot is outside: A_i = phi_i(x - d n). Beside light
  /// nodes these would let a small impulse do much; then A_i = phi_i(x) - d n . grad phi_i(x).
  ///
  /// @param place of the points in their cells
  /// @param to_foot - d n, in cell widths
  /// @param open faces of the cells
  /// @param most_mobility 1/kg
  template <int dim, int n>
  void set_shapes(const std::array<Batch, dim> &place,
                  const std::array<Batch, dim> &to_foot,
                  const std::array<OpenKnots, batch_size> &open,
                  const Batch &most_mobility,
                  const NodeLanes<dim, n> &nodes,
                  ContactLanes<dim> &contact)
  {
    using Basis                    = CellBasis<dim, n, Batch>;
    constexpr unsigned int n_nodes = Basis::n_nodes;
    // The product of factors along the axes.
    const auto at = [](const std::array<std::array<Batch, n>, dim> &factors, const unsigned int i) {
      Batch product = factors[0][i % n] * factors[1][i / n % n];
      if constexpr (dim == 3)
        product *= factors[2][i / (n * n)];
      return product;
    };
    const Batch none{};
    // Takes the functions at nodes with soil.
    const auto set = [&](const auto &row) {
      Batch mobility{};
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          contact.shape[i] = simd::select<Batch>(nodes.inverse_mass(i) > 0., row(i), none);
          mobility += contact.shape[i] * contact.shape[i] * nodes.inverse_mass(i);
        }
      return mobility;
    };
    std::array<Batch, dim> foot;
    for (unsigned int a = 0; a < dim; ++a)
      foot[a] = place[a] + to_foot[a];
    const Basis at_foot = basis_in_lanes<dim, n>(foot, open);
    Batch mobility      = set([&](const unsigned int i) { return at(at_foot.value, i); });
    if (const simd::BatchBits is_large = mobility > most_mobility; simd::any(is_large))
      {
        const Basis at_point = basis_in_lanes<dim, n>(place, open);
        std::array<std::array<std::array<Batch, n>, dim>, dim> slopes;
        for (unsigned int a = 0; a < dim; ++a)
          {
            slopes[a]    = at_point.value;
            slopes[a][a] = at_point.derivative[a];
          }
        mobility = set([&](const unsigned int i) {
          Batch linear = at(at_point.value, i);
          for (unsigned int a = 0; a < dim; ++a)
            linear += to_foot[a] * at(slopes[a], i);
          return simd::select<Batch>(is_large, linear, contact.shape[i]);
        });
      }
    const Batch one = simd::broadcast<Batch>(1.);
    contact.inertia = simd::select<Batch>(mobility > 0., one / mobility, none);
  }
} // namespace scree

#endif
