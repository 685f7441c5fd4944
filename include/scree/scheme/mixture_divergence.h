// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_mixture_divergence_h
#define scree_scheme_mixture_divergence_h

#include <scree/scheme/free_surface.h>
#include <scree/transfer/water_transfer.h>

namespace scree
{
  /// The volume that the mixture's flow draws from the corners: integrals of -psi div u, where u = (1-n) v_s + n v_w is
  /// formed at the nodes. In partly full cells with soil they are over the part that material fills: beyond it the
  /// nodes' few points tell next to nothing of u, and soil that answers a pressure that heeds it makes energy without
  /// bound. In cells that rigid ground cuts they are over the open part, and what u carries through the ground is
  /// drawn, too: the pressure has to stop it. Ground that moves into the open gives the volume that it takes.
  template <int dim>
  class MixtureDivergence
  {
  public:
    /// @param open_cells what rigid ground leaves of the cells; null: all
    MixtureDivergence(const BackgroundGrid<dim> &grid,
                      const NodeNumbering<dim> &corners,
                      const FreeSurfaceLocator<dim> &surface,
                      const Divergence form,
                      const OpenCells<dim> *open_cells);

    /// Sets `sums`, m^3/s, at the corners of wet cells from the velocities and the volume fraction of grains at the
    /// nodes, whose ghosts hold values. Collective: owned corners hold the whole.
    void integrate(const Mixture<dim> &mixture,
                   const NodalField<dim> &soil,
                   const NodalField<dim> &water,
                   const PoreField<dim> &pores,
                   CornerVector &sums);

  private:
    static constexpr unsigned int n_corners = 1 << dim;
    using AtCorners                         = std::array<double, n_corners>;

    /// Gauss points of the unit cell, n_1d along an axis.
    template <unsigned int n_1d>
    struct Rule
    {
      static constexpr unsigned int n_points = dealii::Utilities::pow(n_1d, dim);

      std::array<dealii::Point<dim>, n_points> points;
      std::array<double, n_points> weights;
      std::array<std::array<double, n_corners>, n_points> shapes;
      std::array<std::array<dealii::Tensor<1, dim>, n_corners>, n_points> shape_gradients; // per cell width

      Rule();

      /// Of the points.
      void find_shapes();
    };

    /// The mixture's velocity at a cell's nodes, component by component in rows.
    template <int n>
    using Flow = NodeRow[dim][RowFactors<dim, n>::n_rows];

    template <int n>
    void integrate_cells(const Mixture<dim> &mixture,
                         const NodalField<dim> &soil,
                         const NodalField<dim> &water,
                         const PoreField<dim> &pores,
                         CornerVector &sums);

    /// Adds `scale` times the integrals over a cell to those of its corners.
    template <int n, unsigned int n_1d>
    void add_integrals(const Rule<n_1d> &rule,
                       const double *weights,
                       const double scale,
                       const OpenKnots open,
                       const Flow<n> &flow,
                       AtCorners &integrals) const;

    /// Points over the part of a cell that material fills, taken to reach from its centre as far to either side as the
    /// cell does to the nearer one along each axis: exact where it fills the cell from one side.
    Rule<2> rule_in(const MixtureCell<dim> &cell) const;

    /// Adds what flows through a segment of the ground, beside its own motion.
    template <int n>
    void add_ground(const GroundSegment<dim> &segment, const Flow<n> &flow, AtCorners &integrals) const;

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &corners;
    const FreeSurfaceLocator<dim> &surface;
    const Divergence form;
    const OpenCells<dim> *open_cells; // may be null
    const Rule<2> whole;              // exact for slopes of quadratics times linear functions
    const Rule<CutCell<dim>::n_gauss> cut_rule;
  };
} // namespace scree

#endif
