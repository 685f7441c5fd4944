// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/points/point_contact.h>
#include <scree/contact/cut_cells/contact_solver.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <utility>

namespace scree
{
  using namespace dealii;

  template <int dim>
  void GroundContact<dim>::obey_law(const Tensor<1, dim> &left, const double mobility)
  {
    held = holds();
    impulse += part(held, left) / mobility;
    if (is_unilateral)
      obey_unilateral_law();
  }


  template <int dim>
  void GroundContact<dim>::obey_unilateral_law()
  {
    const Tensor<1, dim> whole = impulse + base;
    const double pressing      = whole * normal;
    if (pressing <= 0.)
      {
        held    = HeldMotion::none;
        impulse = -base;
        return;
      }
    if (friction == 0.)
      return;
    const Tensor<1, dim> along = whole - pressing * normal;
    const double size = along.norm(), available = available_friction(friction, pressing);
    if (size <= available)
      return;
    held    = HeldMotion::across;
    impulse = pressing * normal + available / size * along - base;
  }


  template <int dim>
  ContactSolver<dim>::ContactSolver(const BackgroundGrid<dim> &grid, const CutCells<dim> &cut_cells)
      : grid(grid)
      , response(grid, cut_cells)
  {
  }


  template <int dim>
  void ContactSolver<dim>::reinit()
  {
    response.reinit();
  }


  template <int dim>
  void ContactSolver<dim>::begin_step()
  {
    response.begin_step();
    list.clear();
  }


  template <int dim>
  void ContactSolver<dim>::clear()
  {
    response.clear();
    list.clear();
  }


  template <int dim>
  void ContactSolver<dim>::add(const GroundContact<dim> &contact)
  {
    list.push_back(contact);
    response.add(contact.segment, contact.phase);
  }


  template <int dim>
  double ContactSolver<dim>::sum(const double value) const
  {
    return Utilities::MPI::sum(value, grid.communicator());
  }


  template <int dim>
  double ContactSolver<dim>::flow() const
  {
    double own_square = 0.;
    for (const GroundContact<dim> &contact : list)
      own_square += contact.area * contact.part(contact.holds(), contact.speed).norm_square();
    return std::sqrt(sum(own_square));
  }


  template <int dim>
  const std::vector<Tensor<1, dim>> &ContactSolver<dim>::impulses()
  {
    of_contacts.resize(list.size());
    for (unsigned int k = 0; k < list.size(); ++k)
      of_contacts[k] = list[k].impulse;
    return of_contacts;
  }


  template <int dim>
  void ContactSolver<dim>::sweep(const bool is_to)
  {
    for (unsigned int i = 0; i < list.size(); ++i)
      {
        const unsigned int k        = is_to ? i : list.size() - 1 - i;
        GroundContact<dim> &contact = list[k];
        if (!(mobilities[k] > 0.))
          continue;
        const Vector before = contact.impulse;
        contact.obey_law(contact.speed - response.velocity_at(k), mobilities[k]);
        if (contact.impulse != before)
          response.change(k, contact.impulse - before);
      }
  }


  template <int dim>
  bool ContactSolver<dim>::iterate(const double bearable, const double tolerance)
  {
    constexpr unsigned int most_iterations = 100;
    const unsigned int n                   = list.size();
    residual.resize(n);
    scaled.resize(n);
    for (unsigned int k = 0; k < n; ++k)
      residual[k] = list[k].speed - velocities[k];
    // Scales the residual; product of both, and its square over the ground, of all ranks.
    const auto judge = [&] {
      double own[2] = {}, all[2] = {};
      for (unsigned int k = 0; k < n; ++k)
        {
          const GroundContact<dim> &contact = list[k];
          scaled[k] = mobilities[k] > 0. ? contact.part(contact.held, residual[k]) / mobilities[k] : Vector();
          const double of_contact = residual[k] * scaled[k];
          own[0] += of_contact;
          own[1] += contact.area * mobilities[k] * of_contact;
        }
      const int error = MPI_Allreduce(own, all, 2, MPI_DOUBLE, MPI_SUM, grid.communicator());
      AssertThrowMPI(error);
      return std::make_pair(all[0], all[1]);
    };
    auto [product, square] = judge();
    if (square <= bearable * bearable)
      return false;
    direction      = scaled;
    unsigned int i = 0;
    for (; i < most_iterations; ++i)
      {
        response.apply(direction, velocities);
        double curvature = 0.;
        for (unsigned int k = 0; k < n; ++k)
          curvature += direction[k] * velocities[k];
        curvature = sum(curvature);
        if (!(curvature > 0.))
          break; // Walls hold what is left.
        const double length = product / curvature;
        for (unsigned int k = 0; k < n; ++k)
          {
            list[k].impulse += length * direction[k];
            residual[k] -= length * velocities[k];
          }
        const auto [next, left] = judge();
        if (left <= tolerance * tolerance)
          return true;
        for (unsigned int k = 0; k < n; ++k)
          direction[k] = scaled[k] + next / product * direction[k];
        product = next;
      }
    return i > 0;
  }


  template <int dim>
  bool ContactSolver<dim>::obeys_laws(const double bearable) const
  {
    double own_square = 0.;
    for (unsigned int k = 0; k < list.size(); ++k)
      if (mobilities[k] > 0.)
        {
          GroundContact<dim> contact = list[k];
          contact.obey_law(residual[k], mobilities[k]);
          own_square += contact.area * (mobilities[k] * (contact.impulse - list[k].impulse)).norm_square();
        }
    return sum(own_square) <= bearable * bearable;
  }


  template <int dim>
  void
  ContactSolver<dim>::find(const MixtureNodes<dim> &nodes, const TwoPhaseMomentum<dim> &step, const double tolerance)
  {
    constexpr unsigned int most_passes = 30;
    response.start(nodes, step);
    mobilities.resize(list.size());
    for (unsigned int k = 0; k < list.size(); ++k)
      mobilities[k] = response.mobility_at(k);
    for (unsigned int pass = 0; pass < most_passes; ++pass)
      {
        response.move_nodes(impulses());
        sweep(true);
        sweep(false);
        response.finish_changes(impulses(), velocities);
        if (!iterate(pass == 0 ? tolerance : 2. * tolerance, tolerance) || obeys_laws(2. * tolerance))
          break;
      }
  }


  template <int dim>
  void ContactSolver<dim>::take(const MixtureNodes<dim> &nodes, const TwoPhaseMomentum<dim> &step, Budget<dim> &balance)
  {
    response.take(impulses(), nodes, step, balance);
  }

  template struct GroundContact<2>;
  template struct GroundContact<3>;
  template class ContactSolver<2>;
  template class ContactSolver<3>;
} // namespace scree
