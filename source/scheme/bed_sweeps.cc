// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/bed_contact.h>
#include <scree/tensor/vector.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline Batch product(const Batch *a, const Batch *b)
    {
      Batch sum = a[0] * b[0];
      for (unsigned int c = 1; c < dim; ++c)
        sum += a[c] * b[c];
      return sum;
    }

    /// Coulomb's law, coulomb_friction(), in lanes.
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline void
    limit_friction(const Batch &coefficient, const Batch &normal_impulse, Batch *impulse)
    {
      const Batch none{}, one = simd::broadcast<Batch>(1.);
      const Batch available = simd::select<Batch>(normal_impulse > 0., coefficient * normal_impulse, none);
      const Batch size      = simd::sqrt(product<dim>(impulse, impulse));
      const Batch part =
          simd::select<Batch>(size < available, one, simd::select<Batch>(size > 0., available / size, none));
      for (unsigned int a = 0; a < dim; ++a)
        impulse[a] *= part;
    }

    constexpr double smallest = 1e-9; // of the free point's mobility: below, walls hold it
  }                                   // namespace


  template <int dim>
  std::array<const unsigned int *, batch_size> BedContact<dim>::nodes_of(const CellLanes &lanes) const
  {
    std::array<const unsigned int *, batch_size> result;
    for (unsigned int l = 0; l < batch_size; ++l)
      result[l] = &nodes_of_cells[cells[lanes.cells[l]].nodes];
    return result;
  }


  template <int dim>
  void BedContact<dim>::fill_lanes(const CellLanes &lanes, const unsigned int k, ContactLanes<dim> &to) const
  {
    const Contact nothing{};
    for (unsigned int l = 0; l < batch_size; ++l)
      {
        const Cell &cell       = cells[lanes.cells[l]];
        const Contact &contact = k < cell.n ? contacts[cell.first + k] : nothing;
        to.approach[l]         = contact.approach;
        to.friction[l]         = contact.friction;
        to.normal_impulse[l]   = contact.normal_impulse;
        for (unsigned int a = 0; a < dim; ++a)
          {
            to.normal[a][l]           = contact.normal[a];
            to.tangent_impulse[a][l]  = contact.tangent_impulse[a];
            to.surface_velocity[a][l] = surfaces[contact.surface].velocity[a];
          }
      }
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::start(const CellLanes &lanes)
  {
    using OfNodes                  = NodeLanes<dim, n>;
    constexpr unsigned int n_nodes = OfNodes::n_nodes;
    OfNodes of_nodes(nodes, nodes_of(lanes));
    of_nodes.find_free_axes(lanes.is_held);
    std::array<OpenKnots, batch_size> open;
    Batch most_mobility;
    for (unsigned int l = 0; l < batch_size; ++l)
      {
        open[l]          = grid.open_knots(cells[lanes.cells[l]].number);
        most_mobility[l] = cells[lanes.cells[l]].most_mobility;
      }
    const Batch none{}, one = simd::broadcast<Batch>(1.);
    bool is_changed = false;
    for (unsigned int k = 0; k < lanes.n; ++k)
      {
        ContactLanes<dim> &contact = contact_lanes[lanes.first + k];
        fill_lanes(lanes, k, contact);
        std::array<Batch, dim> place, to_foot;
        simd::BatchBits is_there;
        for (unsigned int l = 0; l < batch_size; ++l)
          {
            const Cell &cell = cells[lanes.cells[l]];
            const Contact &c = contacts[cell.first + std::min(k, cell.n - 1)];
            is_there[l]      = k < cell.n ? -1 : 0;
            for (unsigned int a = 0; a < dim; ++a)
              {
                place[a][l]   = c.place[a];
                to_foot[a][l] = c.to_foot[a];
              }
          }
        set_shapes<dim, n>(place, to_foot, open, most_mobility, of_nodes, contact);
        contact.inertia        = simd::select<Batch>(is_there, contact.inertia, none);
        contact.normal_inertia = contact.inertia;
        if (lanes.is_held)
          {
            Batch across{};
            for (unsigned int a = 0; a < dim; ++a)
              {
                contact.mobility[a] = none;
                for (unsigned int i = 0; i < n_nodes; ++i)
                  contact.mobility[a] += contact.shape[i] * contact.shape[i] * of_nodes.inverse_mass(i, a);
                across += contact.normal[a] * contact.normal[a] * contact.mobility[a];
              }
            contact.normal_inertia = simd::select<Batch>(across * contact.inertia >= smallest, one / across, none);
          }
        if (!simd::any(contact.normal_impulse > 0.))
          continue;
        is_changed = true;
        Batch impulse[dim];
        for (unsigned int a = 0; a < dim; ++a)
          impulse[a] = contact.normal_impulse * contact.normal[a] + contact.tangent_impulse[a];
        of_nodes.push(contact.shape, impulse);
      }
    if (is_changed)
      of_nodes.store();
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::start()
  {
    for (const CellLanes &lanes : cell_lanes)
      start<n>(lanes);
    if (std::find(is_colour_shared.begin(), is_colour_shared.end(), true) != is_colour_shared.end())
      nodes.exchange();
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::sweep(const CellLanes &lanes, const bool is_forward)
  {
    NodeLanes<dim, n> of_nodes(nodes, nodes_of(lanes));
    of_nodes.find_free_axes(lanes.is_held);
    const Batch none{};
    bool is_changed = false;
    for (unsigned int k = 0; k < lanes.n; ++k)
      {
        ContactLanes<dim> &contact = contact_lanes[lanes.first + (is_forward ? k : lanes.n - 1 - k)];
        Batch slip[dim]; // at the foot, from the surface
        of_nodes.velocity_at(contact.shape, slip);
        for (unsigned int a = 0; a < dim; ++a)
          slip[a] -= contact.surface_velocity[a];
        const Batch across = product<dim>(slip, contact.normal);
        const Batch before = contact.normal_impulse;
        const Batch normal = simd::max<Batch>(before - (across - contact.approach) * contact.normal_inertia, none);
        if (!simd::any((normal > 0.) | (before > 0.)))
          continue; // None of them touches.
        const Batch more       = normal - before;
        contact.normal_impulse = normal;
        is_changed             = true;
        for (unsigned int a = 0; a < dim; ++a)
          slip[a] -= across * contact.normal[a];
        // An impulse across the surface does nothing along it, but where walls hold nodes.
        Batch inertia = contact.inertia;
        if (lanes.is_held)
          {
            Batch gained[dim], along{};
            for (unsigned int a = 0; a < dim; ++a)
              gained[a] = more * contact.mobility[a] * contact.normal[a];
            const Batch gained_across = product<dim>(gained, contact.normal);
            for (unsigned int a = 0; a < dim; ++a)
              {
                slip[a] += gained[a] - gained_across * contact.normal[a];
                along += slip[a] * slip[a] * contact.mobility[a];
              }
            const Batch square = product<dim>(slip, slip);
            inertia            = simd::select<Batch>(
                (square > 0.) & (along * contact.inertia >= smallest * square), square / along, none);
          }
        Batch tangent[dim], change[dim];
        for (unsigned int a = 0; a < dim; ++a)
          tangent[a] = contact.tangent_impulse[a] - inertia * slip[a];
        limit_friction<dim>(contact.friction, normal, tangent);
        for (unsigned int a = 0; a < dim; ++a)
          {
            tangent[a] = simd::select<Batch>(contact.normal_inertia > 0., tangent[a], contact.tangent_impulse[a]);
            change[a]  = more * contact.normal[a] + (tangent[a] - contact.tangent_impulse[a]);
            contact.tangent_impulse[a] = tangent[a];
          }
        of_nodes.push(contact.shape, change);
      }
    if (is_changed)
      of_nodes.store();
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::sweep(const bool is_forward)
  {
    const unsigned int n_colours = is_colour_shared.size();
    for (unsigned int k = 0; k < n_colours; ++k)
      {
        const unsigned int colour = is_forward ? k : n_colours - 1 - k;
        const unsigned int first = first_of_colour[colour], last = first_of_colour[colour + 1];
        for (unsigned int i = first; i < last; ++i)
          sweep<n>(cell_lanes[is_forward ? i : first + last - 1 - i], is_forward);
        if (is_colour_shared[colour])
          nodes.exchange();
      }
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::add_reactions(const CellLanes &lanes, StepBalance<dim> &balance)
  {
    const double *axes = nodes.free_axes();
    for (unsigned int l = 0; l < lanes.n_cells; ++l)
      {
        const Cell &cell = cells[lanes.cells[l]];
        for (unsigned int i = 0; i < CellBasis<dim, n>::n_nodes && cell.is_held; ++i)
          {
            const unsigned int number = nodes_of_cells[cell.nodes + i];
            if (!nodes.is_held(number))
              continue;
            Tensor<1, dim> reaction;
            for (unsigned int k = 0; k < cell.n; ++k)
              {
                const ContactLanes<dim> &contact = contact_lanes[lanes.first + k];
                for (unsigned int a = 0; a < dim; ++a)
                  reaction[a] -= contact.shape[i][l] *
                                 (contact.normal_impulse[l] * contact.normal[a][l] + contact.tangent_impulse[a][l]);
              }
            for (unsigned int a = 0; a < dim; ++a)
              reaction[a] *= 1. - axes[number * ContactNodes<dim>::n_doubles + a];
            balance.wall_impulse += reaction;
            balance.soil_walls.add(constraints.at(nodes.node(number))->soil_faces, reaction);
          }
      }
  }


  template <int dim>
  template <int n>
  void BedContact<dim>::finish(const double time_step, StepBalance<dim> &balance)
  {
    constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes;
    for (const CellLanes &lanes : cell_lanes)
      {
        const NodeLanes<dim, n> working(nodes, nodes_of(lanes));
        for (unsigned int k = 0; k < lanes.n; ++k)
          {
            const ContactLanes<dim> &in_lanes = contact_lanes[lanes.first + k];
            Batch velocity[dim], impulses[dim], sum{};
            working.velocity_at(in_lanes.shape, velocity);
            for (unsigned int i = 0; i < n_nodes; ++i)
              sum += in_lanes.shape[i];
            for (unsigned int a = 0; a < dim; ++a)
              impulses[a] = in_lanes.normal_impulse * in_lanes.normal[a] + in_lanes.tangent_impulse[a];
            const Batch work_at_nodes = product<dim>(impulses, velocity);
            for (unsigned int l = 0; l < lanes.n_cells; ++l)
              {
                const Cell &cell = cells[lanes.cells[l]];
                if (k >= cell.n)
                  continue;
                const Contact &contact = contacts[cell.first + k];
                Tensor<1, dim> impulse;
                for (unsigned int a = 0; a < dim; ++a)
                  {
                    contact.force[a] = impulses[a][l] / time_step;
                    impulse[a]       = sum[l] * impulses[a][l];
                  }
                const RigidSurface<dim> &surface = surfaces[contact.surface];
                if (surface.obstacle == nullptr)
                  {
                    balance.bed_impulse += impulse;
                    balance.bed_dissipation -= work_at_nodes[l];
                    continue;
                  }
                ObstacleBalance<dim> &obstacle = balance.obstacles[contact.surface - (surfaces.size() - n_obstacles)];
                const double work              = impulse * surface.velocity;
                obstacle.impulse += impulse;
                obstacle.add_moment(contact.foot - surface.obstacle->pivot, impulse);
                obstacle.work += work;
                obstacle.dissipation += work - work_at_nodes[l];
              }
          }
        if (lanes.is_held)
          add_reactions<n>(lanes, balance);
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
  template void BedContact<2>::finish<2>(const double, StepBalance<2> &);
  template void BedContact<2>::finish<3>(const double, StepBalance<2> &);
  template void BedContact<3>::finish<2>(const double, StepBalance<3> &);
  template void BedContact<3>::finish<3>(const double, StepBalance<3> &);
} // namespace scree
