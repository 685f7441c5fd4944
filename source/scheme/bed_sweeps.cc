// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/bed_contact.h>
#include <scree/scheme/contact_row.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  template <int n>
  void BedContact<dim>::push(const Cell &cell, const unsigned int contact, const Tensor<1, dim> &impulse)
  {
    constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes;
    const double *row              = &rows[std::size_t(contact) * OfCell<dim, n>::n_doubles];
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        auto &node                  = nodes[nodes_of_cells[cell.nodes + i]];
        const Tensor<1, dim> change = row[i] * node.inverse_mass * impulse;
        node.velocity += node.held == nodes.free ? change : nodes.held(node).free_part(change);
      }
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::start()
  {
    for (const Cell &cell : cells)
      for (unsigned int c = cell.first; c < cell.first + cell.n; ++c)
        push<n>(cell, c, contacts[c].normal_impulse * contacts[c].normal + contacts[c].tangent_impulse);
    if (std::find(is_colour_shared.begin(), is_colour_shared.end(), true) != is_colour_shared.end())
      nodes.exchange();
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::sweep_cell(const Cell &cell, const bool is_forward)
  {
    using Lanes                 = OfCell<dim, n>;
    const unsigned int *numbers = &nodes_of_cells[cell.nodes];
    Lanes velocity[dim], inverse_mass;
    for (unsigned int i = 0; i < Lanes::n_nodes; ++i)
      {
        inverse_mass.set(i, nodes[numbers[i]].inverse_mass);
        for (unsigned int a = 0; a < dim; ++a)
          velocity[a].set(i, nodes[numbers[i]].velocity[a]);
      }
    for (unsigned int k = 0; k < cell.n; ++k)
      {
        const unsigned int c = is_forward ? cell.first + k : cell.first + cell.n - 1 - k;
        Contact &contact     = contacts[c];
        const Lanes row(&rows[std::size_t(c) * Lanes::n_doubles]);
        const RigidSurface<dim> &surface = surfaces[contact.surface];
        Tensor<1, dim> at_foot; // from the surface
        for (unsigned int a = 0; a < dim; ++a)
          at_foot[a] = row.product(velocity[a]) - surface.velocity[a];

        // An impulse across the surface does nothing along it: both follow from one velocity.
        const double across = at_foot * contact.normal;
        const double normal = std::max(0., contact.normal_impulse - (across - contact.approach) * contact.inertia);
        if (normal == 0. && contact.normal_impulse == 0.)
          continue;
        const Tensor<1, dim> tangent =
            coulomb_friction<dim>(contact.tangent_impulse - contact.inertia * (at_foot - across * contact.normal),
                                  contact.available(normal))
                .impulse;
        const Tensor<1, dim> change =
            (normal - contact.normal_impulse) * contact.normal + (tangent - contact.tangent_impulse);
        contact.normal_impulse  = normal;
        contact.tangent_impulse = tangent;
        const Lanes response    = row.times(inverse_mass);
        for (unsigned int a = 0; a < dim; ++a)
          velocity[a].add(change[a], response);
      }
    for (unsigned int i = 0; i < Lanes::n_nodes; ++i)
      for (unsigned int a = 0; a < dim; ++a)
        nodes[numbers[i]].velocity[a] = velocity[a].get(i);
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::sweep_held_cell(const Cell &cell, const bool is_forward)
  {
    constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes;
    const unsigned int *numbers    = &nodes_of_cells[cell.nodes];
    for (unsigned int k = 0; k < cell.n; ++k)
      {
        const unsigned int c             = is_forward ? cell.first + k : cell.first + cell.n - 1 - k;
        const double *row                = &rows[std::size_t(c) * OfCell<dim, n>::n_doubles];
        Contact &contact                 = contacts[c];
        const RigidSurface<dim> &surface = surfaces[contact.surface];
        const auto velocity              = [&] { // from the surface
          Tensor<1, dim> sum = -surface.velocity;
          for (unsigned int i = 0; i < n_nodes; ++i)
            sum += row[i] * nodes[numbers[i]].velocity;
          return sum;
        };
        // What an impulse of 1 along a direction gives to the velocity along it.
        const auto mobility = [&](const Tensor<1, dim> &direction) {
          double sum = 0.;
          for (unsigned int i = 0; i < n_nodes; ++i)
            {
              const auto &node          = nodes[numbers[i]];
              const Tensor<1, dim> free = node.held == nodes.free ? direction : nodes.held(node).free_part(direction);
              sum += row[i] * row[i] * node.inverse_mass * (free * direction);
            }
          return sum;
        };
        constexpr double smallest = 1e-9; // of the free point's: below, walls hold it
        const double across       = mobility(contact.normal);
        if (across * contact.inertia < smallest)
          continue;
        const double normal =
            std::max(0., contact.normal_impulse - (velocity() * contact.normal - contact.approach) / across);
        if (normal == 0. && contact.normal_impulse == 0.)
          continue;
        push<n>(cell, c, (normal - contact.normal_impulse) * contact.normal);
        contact.normal_impulse = normal;

        Tensor<1, dim> slip = velocity();
        slip -= (slip * contact.normal) * contact.normal;
        const double speed = slip.norm();
        const double along = speed > 0. ? mobility(slip / speed) : 0.;
        const Tensor<1, dim> needed =
            contact.tangent_impulse - (along * contact.inertia >= smallest ? slip / along : Tensor<1, dim>());
        const Tensor<1, dim> tangent = coulomb_friction<dim>(needed, contact.available(normal)).impulse;
        push<n>(cell, c, tangent - contact.tangent_impulse);
        contact.tangent_impulse = tangent;
      }
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::sweep(const bool is_forward)
  {
    const unsigned int n_colours = is_colour_shared.size();
    for (unsigned int k = 0; k < n_colours; ++k)
      {
        const unsigned int colour = is_forward ? k : n_colours - 1 - k;
        const unsigned int first = first_of_colour[colour], n_cells = first_of_colour[colour + 1] - first;
        for (unsigned int i = 0; i < n_cells; ++i)
          {
            const Cell &cell = cells[is_forward ? first + i : first + n_cells - 1 - i];
            if (cell.is_held)
              sweep_held_cell<n>(cell, is_forward);
            else
              sweep_cell<n>(cell, is_forward);
          }
        if (is_colour_shared[colour])
          nodes.exchange();
      }
  }

  template void BedContact<2>::start<2>();
  template void BedContact<2>::start<3>();
  template void BedContact<3>::start<2>();
  template void BedContact<3>::start<3>();
  template void BedContact<2>::sweep<2>(const bool);
  template void BedContact<2>::sweep<3>(const bool);
  template void BedContact<3>::sweep<2>(const bool);
  template void BedContact<3>::sweep<3>(const bool);
} // namespace scree
