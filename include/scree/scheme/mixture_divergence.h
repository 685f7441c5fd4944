// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_mixture_divergence_h
#define scree_scheme_mixture_divergence_h

#include <scree/scheme/free_surface.h>
#include <scree/transfer/water_transfer.h>

namespace scree
{
  /// The volume that the mixture's flow draws from the corners: integrals of -psi div u, where u = (1-n) v_s + n v_w is
  /// formed at the nodes.
  template <int dim>
  class MixtureDivergence
  {
  public:
    MixtureDivergence(const BackgroundGrid<dim> &grid, const NodeNumbering<dim> &corners, const Divergence form);

    /// Sets `sums`, m^3/s, at the corners of wet cells from the velocities and the volume fraction of grains at the
    /// nodes, whose ghosts hold values. Collective: owned corners hold the whole.
    void integrate(const Mixture<dim> &mixture,
                   const NodalField<dim> &soil,
                   const NodalField<dim> &water,
                   const PoreField<dim> &pores,
                   CornerVector &sums);

  private:
    static constexpr unsigned int n_gauss   = 2; // an axis: exact for slopes of quadratics times linear functions
    static constexpr unsigned int n_points  = dealii::Utilities::pow(n_gauss, dim);
    static constexpr unsigned int n_corners = 1 << dim;

    template <int n>
    void integrate_cells(const Mixture<dim> &mixture,
                         const NodalField<dim> &soil,
                         const NodalField<dim> &water,
                         const PoreField<dim> &pores,
                         CornerVector &sums);

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &corners;
    const Divergence form;
    std::array<dealii::Point<dim>, n_points> points; // of the unit cell
    std::array<double, n_points> weights;
    std::array<std::array<double, n_corners>, n_points> shapes;
    std::array<std::array<dealii::Tensor<1, dim>, n_corners>, n_points> shape_gradients; // per cell width
  };
} // namespace scree

#endif
