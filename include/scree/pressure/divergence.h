// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_divergence_h
#define scree_pressure_divergence_h

#include <scree/boundary/ground_gaps.h>
#include <scree/pressure/soil_gaps.h>
#include <scree/transfer/water_transfer.h>

#include <cmath>

namespace scree
{
  /// The volume that the mixture's flow draws from the vertices: integrals of -psi div u, where u = (1-n) v_s + n v_w
  /// is formed at the nodes. In partly full cells with soil they are over the part that material fills: beyond it the
  /// nodes' few points tell next to nothing of u, and soil that answers a pressure that heeds it makes energy without
  /// bound. In cells that rigid ground cuts they are over the open part, and what u carries through the ground is
  /// drawn, too: the pressure has to stop it. Ground that moves into the open gives the volume that it takes.
  template <int dim>
  class MixtureDivergence
  {
  public:
    /// @param gravity m/s^2
    /// @param cut_cells what rigid ground leaves of the cells; null: all
    /// @param ground_gaps between the ground and particles
    MixtureDivergence(const BackgroundGrid<dim> &grid,
                      const NodeNumbering<dim> &vertices,
                      const FreeSurface<dim> &surface,
                      const double gravity,
                      const CutCells<dim> *cut_cells,
                      const GroundGaps<dim> &ground_gaps);

    /// Sets `sums`, m^3/s, at the vertices of wet cells from the velocities and the volume fraction of grains at the
    /// nodes, whose ghosts hold values. Collective: owned vertices hold the whole.
    void integrate(const Mixture<dim> &mixture,
                   const NodalField<dim> &soil,
                   const NodalField<dim> &water,
                   const PoreField<dim> &pores,
                   const double time_step,
                   VertexVector &sums);

    /// Sets the cells' factors of the soil's volume, from the velocities at the end of a step of `time_step` s.
    ///
    /// A solve balances flow at vertices, and may leave a cell closing at a rate d although water fills its pores: what
    /// one cell takes too much its neighbour takes too little. Soil that falls on a wall would be pressed together by
    /// this for ever. So the part of d that water cannot leave by, the drag's share C/(C + m_w) for the drag C of the
    /// step, is no strain where it is fast: times d^2/(d^2 + g/h). A slow one is left in, as consolidation needs it.
    /// Beside a gap between bodies all of d is the gap's. Closing cells only.
    void find_volume_factors(Mixture<dim> &mixture,
                             const NodalField<dim> &soil,
                             const NodalField<dim> &water,
                             const PoreField<dim> &pores,
                             const SoilGaps<dim> &gaps,
                             const double time_step) const;

  private:
    static constexpr unsigned int n_vertices = 1 << dim;
    using AtVertices                         = std::array<double, n_vertices>;

    /// Gauss points of the unit cell, n_1d along an axis.
    template <unsigned int n_1d>
    struct Rule
    {
      static constexpr unsigned int n_points = dealii::Utilities::pow(n_1d, dim);

      std::array<dealii::Point<dim>, n_points> points;
      std::array<double, n_points> weights;
      std::array<std::array<double, n_vertices>, n_points> shapes;

      Rule();

      /// Of the points.
      void find_shapes();
    };

    /// The mixture's velocity at a cell's nodes, component by component in rows.
    template <int n>
    struct Flow
    {
      NodeRow rows[dim][RowFactors<dim, n>::n_rows];
    };

    template <int n>
    Flow<n> flow_in(const unsigned int cell,
                    const NodalField<dim> &soil,
                    const NodalField<dim> &water,
                    const PoreField<dim> &pores) const;

    /// Its mean divergence over a cell's material, 1/s.
    template <int n>
    double mean_divergence(const MixtureCell<dim> &cell, const Flow<n> &flow) const;

    template <int n>
    void set_volume_factors(Mixture<dim> &mixture,
                            const NodalField<dim> &soil,
                            const NodalField<dim> &water,
                            const PoreField<dim> &pores,
                            const SoilGaps<dim> &gaps,
                            const double time_step) const;

    template <int n>
    void integrate_cells(const Mixture<dim> &mixture,
                         const NodalField<dim> &soil,
                         const NodalField<dim> &water,
                         const PoreField<dim> &pores,
                         const double time_step,
                         VertexVector &sums);

    /// Adds `scale` times the integrals over a cell to those of its vertices.
    template <int n, unsigned int n_1d>
    void add_integrals(const Rule<n_1d> &rule,
                       const double *weights,
                       const double scale,
                       const OpenKnots open,
                       const Flow<n> &flow,
                       AtVertices &integrals) const;

    /// Where material is taken to be in a partly full cell with soil: to reach from its centre as far to either side as
    /// the cell does to the nearer one along each axis, exact where it fills the cell from one side. Returns how far
    /// the centre is off the cell's middle, cell widths.
    dealii::Tensor<1, dim> off_middle(const MixtureCell<dim> &cell) const;

    /// A place of the unit cell in that box, which is as far off the cell's middle along an axis.
    static double in_box(const double place, const double off)
    {
      return 0.5 + off + (1. - 2. * std::abs(off)) * (place - 0.5);
    }

    /// Points over it.
    Rule<2> rule_in(const MixtureCell<dim> &cell) const;

    /// Adds what flows through a segment of the ground, beside its own motion and beyond what closes its gap.
    template <int n>
    void
    add_ground(const unsigned int segment, const Flow<n> &flow, const double time_step, AtVertices &integrals) const;

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &vertices;
    const FreeSurface<dim> &surface;
    const double square_of_slow;    // g/h, 1/s^2
    const CutCells<dim> *cut_cells; // may be null
    const GroundGaps<dim> &ground_gaps;
    const Rule<2> whole; // exact for slopes of quadratics times linear functions
    const Rule<CubicWeights<dim>::n_1d> cut_rule;
  };
} // namespace scree

#endif
