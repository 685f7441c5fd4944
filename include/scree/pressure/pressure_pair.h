// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_pressure_pair_h
#define scree_pressure_pressure_pair_h

#include <scree/pressure/filled_part.h>

#include <functional>

namespace scree
{
  /// Flow at the nodes, and what the pressure does to it: the mixture's velocity u = v_s + q, m/s, and the discharge q,
  /// m/s; or a force on u and one on q beside it, N.
  template <int dim>
  using FlowField = NodeValues<dim, 2 * dim>;

  /// The divergence B of a flow at the vertices, and its transpose, the force of a pressure. As they are transposes,
  /// the pressure's work is what B leaves of the divergence, and pressure makes no energy, whatever the part of the
  /// cells that water fills is taken to be.
  ///
  /// (B u)_a = - int psi_a div u + int_Gamma psi_a u.nu + sum_c grad psi_a . sum_i delta_ci q_i
  ///
  /// over the part of the cells that water fills, and the ground and walls Gamma that bound it, but for walls that no
  /// point has reached; nu points out of it. So what walls give the soil is the effective stress. The sum makes gravity
  /// on scattered points a gradient of pressure, nearly: Delta_i = sum V_p phi_i/n_p - int phi_i is what the water's
  /// points have at a node beside the part; each cell takes its share of it but for the mean, which is passed on to the
  /// nodes. sum_i delta_ci = 0, so that a uniform flow has no divergence, and forces add up to 0.
  template <int dim>
  class PressurePair
  {
  public:
    /// All are kept by reference.
    PressurePair(const BackgroundGrid<dim> &grid, const NodeNumbering<dim> &vertices, const FilledPart<dim> &part);

    /// Fits the pair to the grid's current partition.
    void reinit();

    /// Finds the moments of a step whose parts are known. Collective.
    /// @param volume sum V_p phi_i/n_p of the water at an owned node, m^3
    void find_moments(const std::function<double(unsigned int node)> &volume);

    /// int phi_i over the parts, of an owned node, m^3, after find_moments().
    double filled_volume(const unsigned int node) const
    {
      return defects[node][volume];
    }

    /// Adds B of a flow whose ghosts hold values to `sums`, m^3/s; owned vertices hold this rank's part.
    void add_divergence(const FlowField<dim> &flow, VertexVector &sums) const;

    /// Adds the squares of the entries of B in each cell, without its moments, m^4, times mobilities of u at the nodes.
    void add_squares(const FlowField<dim> &mobilities, VertexVector &sums) const;

    /// Adds -B^T p to forces, N: this rank's part.
    /// @param pressure Pa, with ghosts
    void add_force(const VertexVector &pressure, FlowField<dim> &forces) const;

    /// Adds to the force on the discharge that of a pressure which acts on this alone, N: - int phi_i grad t.
    void add_suction(const VertexVector &pressure, FlowField<dim> &forces) const;

  private:
    template <int n>
    void add_divergence_of_cells(const FlowField<dim> &flow, VertexVector &sums) const;
    template <int n>
    void add_force_of_cells(const VertexVector &pressure, FlowField<dim> &forces) const;

    /// Of a node.
    enum Defect : unsigned int
    {
      volume, // int phi_i, m^3
      surplus // Delta_i, m^3
    };

    static constexpr unsigned int n_passes = 8;   ///< of what cells do not take to the nodes
    static constexpr double largest_defect = 0.5; ///< of Delta_i, over int phi_i

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    const FilledPart<dim> &part;
    NodeValues<dim, 2> defects, passed_on; // Defect; of the second, only what is next
    std::vector<NodeRow> moments;          // delta_ci: rows of the parts' cells
  };
} // namespace scree

#endif
