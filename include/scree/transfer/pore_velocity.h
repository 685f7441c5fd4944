// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_pore_velocity_h
#define scree_transfer_pore_velocity_h

#include <scree/transfer/velocity_transfer.h>
#include <scree/transfer/water_transfer.h>

namespace scree
{
  /// Velocity of a cell's nodes as points of water take it: v_g + (n_i/n_p) (v_w - v_g), n_p the porosity about the
  /// point, 1/n_i the mean of 1/n_p over the water of a node. A flux U that does not change where soil begins moves the
  /// points by U/n_p on either side, instead of by the mean over the node's surroundings; and since
  /// sum m_p phi_i n_i/n_p is the node's mass, their momentum is that of the nodes, whatever n_p and v_g are.
  ///
  /// v_g = v_w + s_i (v_s - v_w) is the velocity of the grains that the water passes, s_i of soil_share(): the soil's,
  /// but where the node has next to nothing of the grains that n_p tells of.
  template <int dim, int n>
  class PoreVelocity
  {
  public:
    /// Whether water of any of the nodes has soil about it; else points take v_w.
    static bool differs(const unsigned int *nodes, const PoreField<dim> &pores)
    {
      bool any = false;
      for (unsigned int i = 0; i < n_nodes; ++i)
        any |= pores[nodes[i]][PoreField<dim>::local_solid_volume] > 0.;
      return any;
    }

    /// @param ids of the cell's nodes
    /// @param water its velocity at them
    /// @param water_density kg/m^3
    /// @param width of the cell, m
    PoreVelocity(const unsigned int *ids,
                 const CellVelocity<dim, n> &water,
                 const MixtureNodes<dim> &nodes,
                 const double water_density,
                 const double width)
        : grains(water.moved(shares(ids, nodes.pores), CellVelocity<dim, n>(ids, nodes.soil, width)))
        , flux(water.weighted_difference(porosities(ids, nodes, water_density), grains))
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
    static std::array<double, n_nodes>
    porosities(const unsigned int *ids, const MixtureNodes<dim> &nodes, const double water_density)
    {
      std::array<double, n_nodes> result;
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          const double mass   = nodes.water[ids[i]][NodalField<dim>::mass];
          const double grains = nodes.pores[ids[i]][PoreField<dim>::local_solid_volume];
          result[i]           = grains > 0. ? mass / (mass + water_density * grains) : 1.;
        }
      return result;
    }

    /// s_i
    static std::array<double, n_nodes> shares(const unsigned int *ids, const PoreField<dim> &pores)
    {
      std::array<double, n_nodes> result;
      for (unsigned int i = 0; i < n_nodes; ++i)
        result[i] = pores[ids[i]][PoreField<dim>::soil_share];
      return result;
    }

    const CellVelocity<dim, n> grains; // v_g
    const CellVelocity<dim, n> flux;   // n_i (v_w - v_g)
  };
} // namespace scree

#endif
