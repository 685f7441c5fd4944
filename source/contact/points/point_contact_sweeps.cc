// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/mesh/cell_basis.h>
#include <scree/contact/points/point_contact.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Scales an impulse along a surface to what Coulomb's law allows, coulomb_friction().
    DEAL_II_ALWAYS_INLINE inline void limit(const double available, NodeRow &impulse)
    {
      const double square = sum(impulse * impulse);
      if (square > available * available)
        impulse *= available / std::sqrt(square);
    }

    /// A cell's nodes while impulses act on them: copies that lie together.
    template <int dim, int n>
    class CellMotion
    {
    public:
      static constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes;

      CellMotion(ContactDofs<dim> &nodes, const unsigned int *numbers)
          : nodes(nodes)
          , numbers(numbers)
      {
        for (unsigned int i = 0; i < n_nodes; ++i)
          motions[i] = nodes.motion(numbers[i]);
      }

      /// The velocity, m/s, at the foot of a contact with these shape functions, and their sum beside.
      DEAL_II_ALWAYS_INLINE inline NodeRow velocity_at(const double *shape) const
      {
        // Several sums, as each addition would wait for the one before.
        NodeRow sums[n];
        for (unsigned int j = 0; j < n; ++j)
          sums[j] = shape[j] * motions[j];
        for (unsigned int i = n; i < n_nodes; i += n)
          for (unsigned int j = 0; j < n; ++j)
            sums[j] += shape[i + j] * motions[i + j];
        for (unsigned int j = 1; j < n; ++j)
          sums[0] += sums[j];
        return sums[0];
      }

      /// Adds an impulse, N s, there, as far as walls let the nodes go; 0 beside it.
      DEAL_II_ALWAYS_INLINE inline void push(const double *shape, const NodeRow &impulse)
      {
        if (!is_pushed)
          for (unsigned int i = 0; i < n_nodes; ++i)
            mobilities[i] = nodes.mobility(numbers[i]);
        is_pushed = true;
        for (unsigned int i = 0; i < n_nodes; ++i)
          motions[i] += shape[i] * mobilities[i] * impulse;
      }

      /// Gives the nodes the velocities.
      void store()
      {
        if (is_pushed)
          for (unsigned int i = 0; i < n_nodes; ++i)
            nodes.motion(numbers[i]) = motions[i];
      }

    private:
      ContactDofs<dim> &nodes;
      const unsigned int *numbers;
      bool is_pushed = false;
      NodeRow motions[n_nodes];
      NodeRow mobilities[n_nodes]; // once it is pushed
    };

    constexpr double smallest = 1e-9; // of the free point's mobility: below, walls hold it
  }                                   // namespace


  template <int dim>
  template <int n>
  void PointContact<dim>::set_shapes(const Cell &cell, Contact &contact, double *shape) const
  {
    using Basis                 = CellBasis<dim, n>;
    const unsigned int *numbers = &nodes_of_cells[cell.nodes];
    const OpenKnots open        = grid.open_knots(cell.number);
    const auto set_mobility     = [&] {
      NodeRow sums[n]{}; // Several, as each addition would wait for the one before.
      for (unsigned int i = 0; i < Basis::n_nodes; i += n)
        for (unsigned int j = 0; j < n; ++j)
          sums[j] += shape[i + j] * shape[i + j] * nodes.mobility(numbers[i + j]);
      contact.mobility = sums[0];
      for (unsigned int j = 1; j < n; ++j)
        contact.mobility += sums[j];
    };
    const auto set_row = [&](const unsigned int r, const NodeRow &row) {
      for (unsigned int i = 0; i < n; ++i)
        shape[r * n + i] = row[i];
    };
    constexpr unsigned int n_rows = RowFactors<dim, n>::n_rows;
    const Basis at_foot(contact.place + contact.to_foot, open);
    const RowFactors<dim, n> of_foot(at_foot);
    for (unsigned int r = 0; r < n_rows; ++r)
      set_row(r, of_foot.value[r] * make_row(at_foot.value[0]));
    set_mobility();
    if (contact.mobility[ContactDofs<dim>::beside] > cell.most_mobility)
      {
        const Basis at_point(contact.place, open);
        const RowFactors<dim, n> of_point(at_point);
        const NodeRow row       = make_row(at_point.value[0]);
        const NodeRow first_row = row + contact.to_foot[0] * make_row(at_point.derivative[0]);
        for (unsigned int r = 0; r < n_rows; ++r)
          {
            double slope = 0.;
            for (unsigned int a = 1; a < dim; ++a)
              slope += contact.to_foot[a] * of_point.derivative[a - 1][r];
            set_row(r, of_point.value[r] * first_row + slope * row);
          }
        set_mobility();
      }
    const double mobility = contact.mobility[ContactDofs<dim>::beside];
    contact.inertia       = mobility > 0. ? 1. / mobility : 0.;
    if (cell.is_held)
      {
        const double across    = sum(contact.normal * contact.normal * contact.mobility);
        contact.normal_inertia = across * contact.inertia >= smallest ? 1. / across : 0.;
      }
    else
      contact.normal_inertia = contact.inertia;
  }


  template <int dim>
  template <int n>
  void PointContact<dim>::start()
  {
    constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes;
    if (shapes.size() < contacts.size() * n_nodes)
      shapes.resize(contacts.size() * n_nodes);
    for (const Cell &cell : cells)
      {
        CellMotion<dim, n> motion(nodes, &nodes_of_cells[cell.nodes]);
        for (unsigned int k = cell.first; k < cell.first + cell.n; ++k)
          {
            Contact &contact = contacts[k];
            double *shape    = &shapes[std::size_t(k) * n_nodes];
            set_shapes<n>(cell, contact, shape);
            if (contact.normal_impulse > 0.)
              motion.push(shape, contact.normal_impulse * contact.normal + contact.tangent_impulse);
          }
        motion.store();
      }
  }


  template <int dim>
  template <int n>
  void PointContact<dim>::sweep(const Cell &cell, const bool is_forward)
  {
    using Motion = CellMotion<dim, n>;
    Motion motion(nodes, &nodes_of_cells[cell.nodes]);
    for (unsigned int k = 0; k < cell.n; ++k)
      {
        const unsigned int number = cell.first + (is_forward ? k : cell.n - 1 - k);
        Contact &contact          = contacts[number];
        const double *shape       = &shapes[std::size_t(number) * Motion::n_nodes];
        NodeRow slip              = motion.velocity_at(shape) - contact.surface_velocity;
        const double across       = sum(slip * contact.normal);
        const double before       = contact.normal_impulse;
        const double normal       = std::max(before - (across - contact.approach) * contact.normal_inertia, 0.);
        if (contact.normal_inertia == 0. || (normal == 0. && before == 0.))
          continue; // Walls hold it, or it does not touch.
        const double more = normal - before;
        slip -= across * contact.normal;
        slip[ContactDofs<dim>::beside] = 0.;
        // An impulse across the surface does nothing along it, but where walls hold nodes.
        double inertia = contact.inertia;
        if (cell.is_held)
          {
            const NodeRow gained = more * contact.mobility * contact.normal;
            slip += gained - sum(gained * contact.normal) * contact.normal;
            const double along  = sum(slip * slip * contact.mobility);
            const double square = sum(slip * slip);
            inertia             = square > 0. && along * contact.inertia >= smallest * square ? square / along : 0.;
          }
        NodeRow tangent = contact.tangent_impulse - inertia * slip;
        limit(available_friction(contact.friction, normal), tangent);
        motion.push(shape, more * contact.normal + (tangent - contact.tangent_impulse));
        contact.normal_impulse  = normal;
        contact.tangent_impulse = tangent;
      }
    motion.store();
  }


  template <int dim>
  template <int n>
  void PointContact<dim>::sweep(const unsigned int s)
  {
    const bool is_forward = s % 2 == 0;
    for (unsigned int k = 0; k < n_colours; ++k)
      {
        const unsigned int shared = 2 * (is_forward ? k : n_colours - 1 - k), position = s * n_colours + k;
        const bool inner_first = !exchange.has_come(position);
        if (inner_first)
          sweep_part<n>(shared + 1, is_forward);
        exchange.before(position);
        sweep_part<n>(shared, is_forward);
        exchange.after(position);
        if (!inner_first)
          sweep_part<n>(shared + 1, is_forward);
      }
  }


  template <int dim>
  template <int n>
  void PointContact<dim>::sweep_part(const unsigned int part, const bool is_forward)
  {
    const unsigned int first = first_of_part[part], last = first_of_part[part + 1];
    for (unsigned int i = first; i < last; ++i)
      sweep<n>(cells[sequence[is_forward ? i : first + last - 1 - i]], is_forward);
  }


  template <int dim>
  template <int n>
  void PointContact<dim>::add_reactions(const Cell &cell, Budget<dim> &balance)
  {
    constexpr unsigned int n_nodes = CellBasis<dim, n>::n_nodes;
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        const unsigned int number = nodes_of_cells[cell.nodes + i];
        const NodeRow &mobility   = nodes.mobility(number);
        if (!nodes.is_held(number) || mobility[ContactDofs<dim>::beside] == 0.)
          continue;
        Tensor<1, dim> reaction;
        for (unsigned int k = cell.first; k < cell.first + cell.n; ++k)
          for (unsigned int a = 0; a < dim; ++a)
            if (mobility[a] == 0.)
              reaction[a] -= shapes[std::size_t(k) * n_nodes + i] *
                             (contacts[k].normal_impulse * contacts[k].normal[a] + contacts[k].tangent_impulse[a]);
        balance.wall_impulse += reaction;
        balance.soil_walls.add(constraints.at(nodes.node(number))->soil_faces, reaction);
      }
  }


  template <int dim>
  template <int n>
  void PointContact<dim>::finish(const double time_step, Budget<dim> &balance)
  {
    using Motion = CellMotion<dim, n>;
    for (const Cell &cell : cells)
      {
        const Motion working(nodes, &nodes_of_cells[cell.nodes]);
        for (unsigned int k = cell.first; k < cell.first + cell.n; ++k)
          {
            const Contact &contact       = contacts[k];
            const NodeRow velocity       = working.velocity_at(&shapes[std::size_t(k) * Motion::n_nodes]);
            const NodeRow at_point       = contact.normal_impulse * contact.normal + contact.tangent_impulse;
            const double work_at_nodes   = sum(at_point * velocity);
            const Tensor<1, dim> impulse = to_vector<dim>(velocity[ContactDofs<dim>::beside] * at_point);
            for (unsigned int a = 0; a < dim; ++a)
              contact.force[a] = at_point[a] / time_step;
            const RigidSurface<dim> &surface = surfaces[contact.surface];
            if (surface.obstacle == nullptr)
              {
                balance.bed_impulse += impulse;
                balance.bed_dissipation -= work_at_nodes;
                continue;
              }
            ObstacleBalance<dim> &obstacle = balance.obstacles[contact.surface - (surfaces.size() - n_obstacles)];
            const double work              = impulse * surface.velocity;
            obstacle.impulse += impulse;
            obstacle.add_moment(contact.foot - surface.obstacle->pivot, impulse);
            obstacle.work += work;
            obstacle.dissipation += work - work_at_nodes;
          }
        if (cell.is_held)
          add_reactions<n>(cell, balance);
      }
  }

  template void PointContact<2>::start<2>();
  template void PointContact<2>::start<3>();
  template void PointContact<3>::start<2>();
  template void PointContact<3>::start<3>();
  template void PointContact<2>::sweep<2>(const unsigned int);
  template void PointContact<2>::sweep<3>(const unsigned int);
  template void PointContact<3>::sweep<2>(const unsigned int);
  template void PointContact<3>::sweep<3>(const unsigned int);
  template void PointContact<2>::finish<2>(const double, Budget<2> &);
  template void PointContact<2>::finish<3>(const double, Budget<2> &);
  template void PointContact<3>::finish<2>(const double, Budget<3> &);
  template void PointContact<3>::finish<3>(const double, Budget<3> &);
} // namespace scree
