// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_pore_velocity_h
#define scree_transfer_pore_velocity_h

#include <scree/transfer/velocity_transfer.h>
#include <scree/transfer/water_transfer.h>

namespace scree
{
  /// Velocity of a cell's nodes as points of water take it: v_s + (n_i/n_p) (v_w - v_s), n_p the porosity about the
  /// point, 1/n_i the mean of 1/n_p over the water of a node. A discharge that does not change where soil begins moves
  /// the points by q/n_p on either side, instead of by the mean over the node's surroundings; and since
  /// sum m_p phi_i n_i/n_p is the node's mass, their momentum is that of the nodes, whatever n_p and v_s are.
  template <int dim, int n>
  class PoreVelocity
  {
  public:
    /// Whether water of any of the nodes has soil about it; else points take v_w.
    static bool differs(const unsigned int *nodes, const PoreField<dim> &pores)
    {
      bool any = false;
      for (unsigned int i = 0; i < n_nodes; ++i)
        any |= pores[nodes[i]][PoreField<dim>::grain_fraction] > 0.;
      return any;
    }

    /// @param ids of the cell's nodes
    /// @param water its velocity at them
    /// @param width of the cell, m
    PoreVelocity(const unsigned int *ids,
                 const CellVelocity<dim, n> &water,
                 const MixtureNodes<dim> &nodes,
                 const double width)
        : grains(ids, nodes.soil, width)
        , flux(water.weighted_difference(porosities(ids, nodes.pores), grains))
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
    static std::array<double, n_nodes> porosities(const unsigned int *ids, const PoreField<dim> &pores)
    {
      std::array<double, n_nodes> result;
      for (unsigned int i = 0; i < n_nodes; ++i)
        result[i] = 1. - pores[ids[i]][PoreField<dim>::grain_fraction];
      return result;
    }

    const CellVelocity<dim, n> grains; // v_s
    const CellVelocity<dim, n> flux;   // n_i (v_w - v_s)
  };
} // namespace scree

#endif
