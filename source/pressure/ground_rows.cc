// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/ground_rows.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void GroundRows<dim>::clear()
  {
    all.clear();
    facets.clear();
    of_flow.clear();
    of_discharge.clear();
  }


  template <int dim>
  void GroundRows<dim>::add(const GroundRow<dim> &row, const CutFacet<dim> &facet, const MixtureNodes<dim> &nodes)
  {
    all.push_back(row);
    facets.push_back(&facet);
    for (unsigned int i = 0; i < facet.shapes.size(); ++i)
      {
        const double porosity = 1. - nodes.pores[grid.nodes(facet.cell)[i]][PoreField<dim>::grain_fraction];
        const bool acts       = row.phase == Phase::soil || porosity > 0.;
        of_flow.push_back(acts ? row.area * facet.shapes[i] : 0.);
        of_discharge.push_back(of_flow.back() * (row.phase == Phase::soil ? -1. : acts ? 1. / porosity - 1. : 0.));
      }
  }


  template <int dim>
  void GroundRows<dim>::add_forces(const Vectors &tractions, FlowField<dim> &forces) const
  {
    const unsigned int n_nodes = grid.n_nodes_per_cell();
    for (unsigned int k = 0, first = 0; k < all.size(); ++k, first += n_nodes)
      {
        const unsigned int *nodes = grid.nodes(facets[k]->cell);
        for (unsigned int i = 0; i < n_nodes; ++i)
          for (unsigned int c = 0; c < dim; ++c)
            {
              forces[nodes[i]][c] -= of_flow[first + i] * tractions[k][c];
              forces[nodes[i]][dim + c] -= of_discharge[first + i] * tractions[k][c];
            }
      }
  }


  template <int dim>
  void GroundRows<dim>::add_unit_forces(FlowField<dim> &forces) const
  {
    for (unsigned int k = 0; k < all.size(); ++k)
      for (unsigned int i = 0; i < facets[k]->shapes.size(); ++i)
        forces[grid.nodes(facets[k]->cell)[i]][unsigned(all[k].phase)] += all[k].area * facets[k]->shapes[i];
  }


  template <int dim>
  void GroundRows<dim>::find_flows(const FlowField<dim> &flow, Vectors &result) const
  {
    const unsigned int n_nodes = grid.n_nodes_per_cell();
    result.resize(all.size());
    for (unsigned int k = 0, first = 0; k < all.size(); ++k, first += n_nodes)
      {
        const unsigned int *nodes = grid.nodes(facets[k]->cell);
        result[k]                 = Tensor<1, dim>();
        for (unsigned int i = 0; i < n_nodes; ++i)
          for (unsigned int c = 0; c < dim; ++c)
            result[k][c] += of_flow[first + i] * flow[nodes[i]][c] + of_discharge[first + i] * flow[nodes[i]][dim + c];
      }
  }


  template <int dim>
  void GroundRows<dim>::find_sums(const FlowField<dim> &values, const int power, std::vector<double> &result) const
  {
    result.assign(all.size(), 0.);
    for (unsigned int k = 0; k < all.size(); ++k)
      for (unsigned int i = 0; i < facets[k]->shapes.size(); ++i)
        {
          const double shape = all[k].area * facets[k]->shapes[i];
          result[k] +=
              (power == 1 ? shape : shape * shape) * values[grid.nodes(facets[k]->cell)[i]][unsigned(all[k].phase)];
        }
  }

  template class GroundRows<2>;
  template class GroundRows<3>;
} // namespace scree
