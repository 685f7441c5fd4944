// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/viscosity/viscous_step.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Tensor<1, dim> part(const NodalField<dim> &field, const unsigned int node, const unsigned int first)
    {
      return Tensor<1, dim>(make_array_view(field[node] + first, field[node] + first + dim));
    }

    template <int dim>
    SoilAndWater<dim> velocities(const MixtureNodes<dim> &nodes, const unsigned int node)
    {
      return { part(nodes.soil, node, NodalField<dim>::velocity), part(nodes.water, node, NodalField<dim>::velocity) };
    }

    template <int dim>
    void add(SoilAndWater<dim> &to, const double factor, const SoilAndWater<dim> &other)
    {
      to.soil += factor * other.soil;
      to.water += factor * other.water;
    }
  } // namespace


  template <int dim>
  ViscousStep<dim>::ViscousStep(const BackgroundGrid<dim> &grid,
                                const WaterParameters &parameters,
                                const std::list<WaterPhase<dim>> &water,
                                TimerOutput &timer)
      : grid(grid)
      , water(water)
      , water_viscosity(parameters.viscosity)
      , timer(timer)
      , force(grid, parameters.viscosity)
  {
    if (water_viscosity > 0.)
      for (std::optional<NodalField<dim>> *field : { &motion, &impulses })
        field->emplace(grid);
  }


  template <int dim>
  void ViscousStep<dim>::reinit()
  {
    for (std::optional<NodalField<dim>> *field : { &motion, &impulses })
      if (*field)
        (*field)->reinit();
  }


  template <int dim>
  double ViscousStep<dim>::largest_rate() const
  {
    double largest = 0;
    for (const auto &part : water)
      largest = std::max(largest, force.largest_rate(part));
    return Utilities::MPI::max(largest, grid.communicator());
  }


  template <int dim>
  void ViscousStep<dim>::find_impulses(const NodalField<dim> &velocity,
                                       const CutCellContact<dim> *bed,
                                       const double ground_share,
                                       const double time_step)
  {
    impulses->clear();
    for (const auto &part : water)
      force.add(part, velocity, *impulses);
    if (bed)
      bed->add_viscous_force(velocity, ground_share, water_viscosity, *impulses);
    impulses->add_contributions();
    for (const unsigned int node : active)
      for (unsigned int c = 0; c < dim; ++c)
        (*impulses)[node][NodalField<dim>::force + c] *= time_step;
  }


  template <int dim>
  void ViscousStep<dim>::set_motion(const Vector &velocity)
  {
    for (unsigned int i = 0; i < active.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        (*motion)[active[i]][NodalField<dim>::velocity + c] = velocity[i].water[c];
    motion->update_ghosts();
  }


  template <int dim>
  SoilAndWater<dim> ViscousStep<dim>::impulses_at(const unsigned int node) const
  {
    return { Tensor<1, dim>(), part(*impulses, node, NodalField<dim>::force) };
  }


  template <int dim>
  double ViscousStep<dim>::product(const Vector &a, const Vector &b) const
  {
    double sum = 0;
    for (unsigned int i = 0; i < a.size(); ++i)
      sum += a[i].soil * b[i].soil + a[i].water * b[i].water;
    return Utilities::MPI::sum(sum, grid.communicator());
  }


  template <int dim>
  unsigned int ViscousStep<dim>::solve(Vector &velocity, const CutCellContact<dim> *bed, const double time_step)
  {
    constexpr double tolerance             = 1e-9; // of the residual, in the norm of its kinetic energy
    constexpr unsigned int most_iterations = 5000;

    Vector residual(active.size()), scaled(active.size());
    for (unsigned int i = 0; i < active.size(); ++i)
      {
        residual[i] = impulses_at(active[i]);
        scaled[i]   = pairs[i].solve(residual[i]);
      }
    Vector direction       = scaled;
    double energy          = product(residual, scaled);
    const double target    = tolerance * tolerance * energy;
    unsigned int iteration = 0;
    for (; energy > target; ++iteration)
      {
        AssertThrow(iteration < most_iterations,
                    ExcMessage("The viscous stress of a step was not found in 5000 iterations. Remedies: a smaller "
                               "'Viscosity' in subsection Water, or a smaller 'Maximum time step'."));
        set_motion(direction);
        find_impulses(*motion, bed, 0., time_step);
        Vector image(active.size()); // (A + dt K) direction
        for (unsigned int i = 0; i < active.size(); ++i)
          {
            image[i] = pairs[i].impulses(direction[i]);
            add(image[i], -1., pairs[i].free_part(impulses_at(active[i])));
          }
        const double length = energy / product(direction, image);
        for (unsigned int i = 0; i < active.size(); ++i)
          {
            add(velocity[i], length, direction[i]);
            add(residual[i], -length, image[i]);
            scaled[i] = pairs[i].solve(residual[i]);
          }
        const double before = energy;
        energy              = product(residual, scaled);
        for (unsigned int i = 0; i < active.size(); ++i)
          {
            SoilAndWater<dim> next = scaled[i];
            add(next, energy / before, direction[i]);
            direction[i] = next;
          }
      }
    return iteration;
  }


  template <int dim>
  void ViscousStep<dim>::apply(const MixtureNodes<dim> &nodes,
                               const TwoPhaseMomentum<dim> &step,
                               CutCellContact<dim> &bed,
                               const double time_step,
                               Budget<dim> &balance)
  {
    if (water_viscosity == 0.)
      return;
    const TimedPart part(timer, TimerSection::nodes);
    active = nodes.pores.active_nodes();
    pairs.clear();
    for (const unsigned int node : active)
      pairs.push_back(step.drag_block_at(nodes, node));
    constexpr double stable = 2.; // beyond, an explicit step turns the fastest motion round and makes it grow
    const bool is_long      = time_step * largest_rate() > stable;
    find_impulses(nodes.water, is_long ? &bed : nullptr, 1., time_step);
    if (is_long)
      {
        Vector velocity;
        for (const unsigned int node : active)
          velocity.push_back(velocities(nodes, node));
        const unsigned int n_iterations = solve(velocity, &bed, time_step);
        if (Utilities::MPI::this_mpi_process(grid.communicator()) == 0)
          balance.n_viscous_iterations += n_iterations;
        // What the solve leaves would not add up to nothing.
        set_motion(velocity);
        find_impulses(*motion, &bed, 1., time_step);
        bed.take_viscous_force(*motion, water_viscosity, time_step);
      }
    for (const unsigned int node : active)
      step.push(nodes, node, impulses_at(node), balance);
    nodes.update_velocity_ghosts();
    if (is_long && bed.no_slip()) // which counts its own impulses
      find_impulses(*motion, nullptr, 1., time_step);
  }


  template <int dim>
  void ViscousStep<dim>::count_dissipation(const MixtureNodes<dim> &nodes, Budget<dim> &balance) const
  {
    for (const unsigned int node : active)
      {
        const Tensor<1, dim> impulse      = part(*impulses, node, NodalField<dim>::force);
        const Tensor<1, dim> after        = part(nodes.water, node, NodalField<dim>::velocity);
        const Tensor<1, dim> water_change = part(nodes.water, node, NodalField<dim>::velocity_change);
        // The work of an impulse is its product with the mean velocity.
        balance.viscous_dissipation -= impulse * (after - 0.5 * water_change);
      }
  }

  template class ViscousStep<2>;
  template class ViscousStep<3>;
} // namespace scree
