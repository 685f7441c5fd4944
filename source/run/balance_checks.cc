// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/balance_checks.h>
#include <scree/postprocess/point_sums.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  using namespace dealii;

  namespace
  {
    // Rounding stays far below the first two; doc/studies has the last.
    constexpr double bound_of_mass = 1e-6, bound_of_momentum = 1e-6, bound_of_gain = 0.005;

    constexpr double bound_of_motion = 1e-3; // doc/theory/single_phase.md

    /// Of the bodies that can move, of all ranks, kg. Collective.
    template <int dim>
    double mass_of_soil(const std::list<SoilBody<dim>> &bodies, const MPI_Comm communicator)
    {
      double mass = 0.;
      for (const auto &body : bodies)
        if (!body.is_rigid)
          for_each_point(body.points, [&](const auto &point) { mass += point.properties[body.layout.mass]; });
      return Utilities::MPI::sum(mass, communicator);
    }


    /// Of all ranks, kg. Collective.
    template <int dim>
    double mass_of_water(const std::list<WaterPhase<dim>> &water, const MPI_Comm communicator)
    {
      double mass = 0.;
      for (const auto &part : water)
        for_each_point(part.points(), [&](const auto &point) { mass += point.properties[part.layout.mass]; });
      return Utilities::MPI::sum(mass, communicator);
    }

    /// The larger one; what is no number is largest.
    double worse(const double so_far, const double value)
    {
      return value <= so_far ? so_far : std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
    }
  } // namespace


  template <int dim>
  BalanceChecks<dim>::BalanceChecks(const BackgroundGrid<dim> &grid, const BodyForces<dim> &forces)
      : grid(grid)
      , gravity(forces.gravity())
      , energy_is_closed(forces.is_gravity_alone())
      , mass_scaling(forces.mass_scaling())
  {
  }


  template <int dim>
  void BalanceChecks<dim>::look(const std::list<SoilBody<dim>> &bodies,
                                const std::list<WaterPhase<dim>> &water,
                                const RunTotals<dim> &local,
                                const double time)
  {
    const MPI_Comm communicator = grid.communicator();
    const RunTotals<dim> totals = local.sum_over_ranks(communicator);
    PointSums<dim> sums(bodies, water, gravity, communicator);
    sums.kinetic *= mass_scaling;
    sums.momentum *= mass_scaling;
    const double soil_now      = mass_of_soil(bodies, communicator);
    const double mass_now      = mass_of_water(water, communicator);
    const double energy        = sums.kinetic + sums.potential + sums.elastic;
    const double own_potential = sums.potential + totals.lost_energy - totals.entered_energy;
    if (!has_start)
      {
        has_start       = true;
        soil_mass       = soil_now + totals.lost_mass - totals.entered_mass;
        water_mass      = mass_now + totals.lost_water_mass - totals.entered_water_mass;
        start_momentum  = sums.momentum - totals.impulse();
        start_energy    = energy + totals.energy_taken();
        start_kinetic   = sums.kinetic;
        start_potential = least_potential = own_potential;
        start_time = last_time = time;
      }
    const auto look_at_mass = [&](const double start, const double now, const double lost, const double entered) {
      if (const double all = start + entered; all > 0.)
        mass_error = worse(mass_error, std::abs(now + lost - entered - start) / all);
    };
    look_at_mass(soil_mass, soil_now, totals.lost_mass, totals.entered_mass);
    look_at_mass(water_mass, mass_now, totals.lost_water_mass, totals.entered_water_mass);

    momentum_residual = worse(momentum_residual, (sums.momentum - start_momentum - totals.impulse()).norm());
    momentum_scale    = std::max({ momentum_scale,
                                   totals.balance.body_impulse.norm(),
                                   std::sqrt(2. * mass_scaling * (soil_now + mass_now) * sums.kinetic) });

    const Budget<dim> &balance = totals.balance;
    least_potential            = std::min(least_potential, own_potential);
    largest_work =
        std::max(largest_work, std::abs(balance.load_work + balance.correction_work + balance.obstacle_energy()));
    dissipation = start_energy - energy - totals.energy_taken();
    // What a channel gives back is a gain, too: the numerical dissipation does not show it. Plastic dissipation is
    // left out: with hardening it can fall. So are walls with an inflow: they push what enters.
    const bool has_entered = totals.entered_mass + totals.entered_water_mass > 0.;
    std::vector<std::pair<std::string, double>> channels{ { "", dissipation },
                                                          { ", of the walls",
                                                            has_entered ? 0. : balance.wall_dissipation },
                                                          { ", of the bed", balance.bed_dissipation },
                                                          { ", of contact", balance.contact_dissipation },
                                                          { ", of drag", balance.drag_dissipation },
                                                          { ", of viscosity", balance.viscous_dissipation } };
    for (unsigned int o = 0; o < balance.obstacles.size(); ++o)
      channels.emplace_back(", of obstacle " + std::to_string(o + 1), balance.obstacles[o].dissipation);
    largest_dissipations.resize(channels.size(), -std::numeric_limits<double>::infinity());
    for (unsigned int c = 0; c < channels.size(); ++c)
      {
        const auto &[channel, value] = channels[c];
        largest_dissipations[c]      = std::max(largest_dissipations[c], value);
        if (const double with_channel = worse(gain, largest_dissipations[c] - value); with_channel > gain)
          {
            gain         = with_channel;
            gain_channel = channel;
          }
      }

    const double work_now = start_potential - own_potential + balance.load_work + balance.obstacle_energy();
    work_in_time += 0.5 * (work + work_now) * (time - last_time);
    work      = work_now;
    last_time = time;
    motion    = balance.motion;
  }


  template <int dim>
  double BalanceChecks<dim>::least_energy() const
  {
    constexpr double of_a_cell = 1e-3; // a fall of this part of the cell size
    return of_a_cell * (soil_mass + water_mass) * gravity.norm() * grid.cell_size();
  }


  template <int dim>
  double BalanceChecks<dim>::released_energy() const
  {
    // Motion and elasticity of the start, fall, work. Scenes at rest release next to nothing.
    const double stored   = start_energy - start_kinetic - start_potential; // elastic
    const double set_free = start_kinetic + start_potential - least_potential + largest_work;
    return set_free > least_energy() || gravity.norm() == 0. ? set_free + stored : 0.;
  }


  template <int dim>
  CheckResult BalanceChecks<dim>::check_of_motion() const
  {
    const double waited = std::abs(work * (last_time - start_time) - work_in_time); // J s
    if (!(std::abs(work) > least_energy()) || waited == 0.)
      return { "kinetic energy with \"Mass scaling\" not judged: hardly any work", "", false, "" };
    const double share = motion / waited;
    return { "mean kinetic energy " + short_text(100. * share) + " % of the work, with masses times " +
                 short_text(mass_scaling) + "; " + short_text(100. * share / mass_scaling) + " % with true ones",
             short_text(100. * bound_of_motion) + " %, else \"Mass scaling\" is too large",
             !(share <= bound_of_motion),
             "" };
  }


  template <int dim>
  std::vector<CheckResult> BalanceChecks<dim>::results() const
  {
    std::vector<CheckResult> list;
    if (!has_start)
      return list;
    list.push_back(
        { "mass balance " + short_text(mass_error), short_text(bound_of_mass), mass_error > bound_of_mass, "" });
    if (momentum_scale > 0.)
      {
        const double error = momentum_residual / momentum_scale;
        list.push_back(
            { "momentum balance " + short_text(error), short_text(bound_of_momentum), error > bound_of_momentum, "" });
      }
    if (const double released = released_energy(); energy_is_closed && released > 0.)
      {
        list.push_back({ "largest energy gain " + short_text(100. * gain / released) + " %" + gain_channel,
                         short_text(100. * bound_of_gain) + " %",
                         gain > bound_of_gain * released,
                         "" });
        list.push_back(
            { "numerical dissipation " + short_text(100. * dissipation / released) + " % of the released energy",
              "",
              false,
              "" });
      }
    if (mass_scaling > 1.)
      list.push_back(check_of_motion());
    return list;
  }

  template class BalanceChecks<2>;
  template class BalanceChecks<3>;
} // namespace scree
