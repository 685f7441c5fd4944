// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/ground_rows.h>
#include <scree/tensor/vector.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The row that ends with the discharge among the 2 dim numbers of a node's flow: where it starts there, and which
    /// of its lanes is the discharge's first.
    template <int dim>
    constexpr unsigned int start_of_discharge = 2 * dim - 4;
    template <int dim>
    constexpr unsigned int lane_of_discharge = 4 - dim;
  } // namespace


  template <int dim>
  void GroundRows<dim>::clear()
  {
    all.clear();
    facets.clear();
    of_flow.clear();
    of_discharge.clear();
  }


  template <int dim>
  void GroundRows<dim>::add(const GroundRow<dim> &row,
                            const CutFacet<dim> &facet,
                            const double least_mass,
                            const NodalField<dim> &phase,
                            const WetNodes<dim> *of_mixture)
  {
    all.push_back(row);
    facets.push_back(&facet);
    Tensor<1, dim> &flow = all.back().flow = Tensor<1, dim>();
    for (unsigned int i = 0; i < facet.shapes.size(); ++i)
      {
        const unsigned int node = grid.nodes(facet.cell)[i];
        const double *values    = phase[node];
        const double mass       = values[NodalField<dim>::mass];
        const double porosity   = of_mixture ? of_mixture->porosity(node) : 0.;
        const bool acts         = mass > 0. && (row.phase == Phase::soil || porosity > 0.);
        of_flow.push_back(acts ? row.area * std::min(facet.shapes[i], mass / least_mass) : 0.);
        of_discharge.push_back(of_flow.back() * (row.phase == Phase::soil ? -1. : acts ? 1. / porosity - 1. : 0.));
        if (acts)
          flow += of_flow.back() * vector_of<dim>(values + NodalField<dim>::velocity);
      }
  }


  template <int dim>
  void GroundRows<dim>::add_forces(const Vectors &tractions, FlowField<dim> &forces) const
  {
    const unsigned int n_nodes = grid.n_nodes_per_cell();
    for (unsigned int k = 0; k < all.size(); ++k)
      {
        const Tensor<1, dim> traction = tractions[k];
        if (traction.norm_square() == 0.)
          continue; // It has lifted off.
        const unsigned int *nodes = grid.nodes(facets[k]->cell);
        for (unsigned int i = 0, j = k * n_nodes; i < n_nodes; ++i, ++j)
          {
            double *force = forces[nodes[i]];
            for (unsigned int c = 0; c < dim; ++c)
              force[c] -= of_flow[j] * traction[c];
            for (unsigned int c = 0; c < dim; ++c)
              force[dim + c] -= of_discharge[j] * traction[c];
          }
      }
  }


  template <int dim>
  void GroundRows<dim>::find_flows(const FlowField<dim> &flow, Vectors &result) const
  {
    const unsigned int n_nodes = grid.n_nodes_per_cell();
    result.resize(all.size());
    for (unsigned int k = 0, first = 0; k < all.size(); ++k, first += n_nodes)
      {
        const unsigned int *nodes = grid.nodes(facets[k]->cell);
        NodeRow flows{}, discharges{};
        for (unsigned int i = 0; i < n_nodes; ++i)
          {
            const double *of_node = flow[nodes[i]];
            flows += of_flow[first + i] * load_row(of_node);
            discharges += of_discharge[first + i] * load_row(of_node + start_of_discharge<dim>);
          }
        for (unsigned int c = 0; c < dim; ++c)
          result[k][c] = flows[c] + discharges[lane_of_discharge<dim> + c];
      }
  }


  template <int dim>
  void GroundRows<dim>::set_responses(const FlowField<dim> &inverse_masses, const double time_step)
  {
    const unsigned int n_nodes = grid.n_nodes_per_cell();
    unsigned int n_numbers     = 0;
    number_of_node.assign(2 * grid.numbering().n_local(), dealii::numbers::invalid_unsigned_int);
    corners.clear();
    responses.clear();
    for (unsigned int k = 0; k < all.size(); ++k)
      {
        all[k].diagonal = 0.;
        for (unsigned int i = 0; i < n_nodes; ++i)
          {
            const unsigned int node = nodes(k)[i], phase = unsigned(all[k].phase);
            unsigned int &number = number_of_node[2 * node + phase];
            if (number == dealii::numbers::invalid_unsigned_int)
              number = n_numbers++;
            corners.push_back(number);
            responses.push_back(weight(k, i) * time_step * inverse_masses[node][phase]);
            all[k].diagonal += weight(k, i) * responses.back();
          }
      }
    motions.resize(n_numbers);
  }


  template <int dim>
  void GroundRows<dim>::precondition(const Vectors &flows, Vectors &tractions)
  {
    const unsigned int n_nodes = grid.n_nodes_per_cell();
    tractions.assign(all.size(), Tensor<1, dim>());
    motions.assign(motions.size(), NodeRow{});
    const auto relax = [&](const unsigned int k) {
      const GroundRow<dim> &row = all[k];
      if (row.diagonal == 0. || !(row.holds_across || row.holds_along))
        return; // Nothing of the phase is there, or it has lifted off.
      NodeRow flow{};
      for (unsigned int j = k * n_nodes; j < (k + 1) * n_nodes; ++j)
        flow += of_flow[j] * motions[corners[j]];
      const Tensor<1, dim> change =
          row.traction_of(flows[k] - to_vector<dim>(flow) - row.compliance * row.along(tractions[k]));
      tractions[k] += change;
      const NodeRow added = to_row<dim>(change);
      for (unsigned int j = k * n_nodes; j < (k + 1) * n_nodes; ++j)
        motions[corners[j]] += responses[j] * added;
    };
    for (unsigned int k = 0; k < all.size(); ++k)
      relax(k);
    for (unsigned int k = all.size(); k-- > 0;)
      relax(k);
  }

  template class GroundRows<2>;
  template class GroundRows<3>;
} // namespace scree
