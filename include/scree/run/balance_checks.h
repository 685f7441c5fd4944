// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_balance_checks_h
#define scree_run_balance_checks_h

#include <scree/boundary/body_forces.h>
#include <scree/io/check_result.h>
#include <scree/postprocess/run_totals.h>
#include <scree/bodies/soil_body.h>
#include <scree/bodies/water_phase.h>
#include <scree/mesh/background_grid.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <list>
#include <string>
#include <vector>

namespace scree
{
  /// Watches mass, momentum and energy of a run from its start. The energy gain is the largest fall of the numerical
  /// dissipation or of that of a channel (walls, bed, an obstacle, ...), over the released energy: that of the start
  /// which the run has turned into motion or stored, and work done on it. With mass scaling, momentum and energy are
  /// those of the scaled masses, and the kinetic energy over the work W shows whether the motion was slow: its integral
  /// over time, over that of W(end) - W. So it depends neither on the rows nor on the time after the motion.
  template <int dim>
  class BalanceChecks
  {
  public:
    /// @param forces besides gravity alone, they do work that is not in the energy balance
    BalanceChecks(const BackgroundGrid<dim> &grid, const BodyForces<dim> &forces);

    /// Compares the points with the start, which is the first look. Collective.
    /// @param totals of this rank
    /// @param time s
    void look(const std::list<SoilBody<dim>> &bodies,
              const std::list<WaterPhase<dim>> &water,
              const RunTotals<dim> &totals,
              const double time);

    /// The worst of all looks. What does not apply is left out.
    std::vector<CheckResult> results() const;

    /// Saves or loads start and worst values (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &has_start &soil_mass &water_mass &mass_error;
      archive &start_momentum &momentum_residual &momentum_scale;
      archive &start_energy &start_kinetic &start_potential &least_potential &largest_work;
      archive &dissipation &largest_dissipations &gain &gain_channel &start_time &last_time &work &work_in_time &motion;
    }

  private:
    /// Energy below which nothing has moved, J.
    double least_energy() const;

    /// Whether the motion was slow, for mass scaling.
    CheckResult check_of_motion() const;

    /// Energy that the run had to spend, J; 0 if too little of it for percentages.
    double released_energy() const;

    const BackgroundGrid<dim> &grid;
    const dealii::Tensor<1, dim> gravity;
    const bool energy_is_closed;
    const double mass_scaling;

    bool has_start    = false;
    double soil_mass  = 0; // at the start, kg
    double water_mass = 0;
    double mass_error = 0; // largest, relative
    dealii::Tensor<1, dim> start_momentum;
    double momentum_residual = 0; // largest, N s
    double momentum_scale    = 0; // N s
    double start_energy      = 0; // kinetic, potential and elastic, J
    double start_kinetic     = 0;
    double start_potential   = 0;
    double least_potential   = 0;             // with that of what has left, without that of what has entered
    double largest_work      = 0;             // of loads, obstacles and volume correction, J
    double dissipation       = 0;             // numerical, now, J
    std::vector<double> largest_dissipations; // so far, of each channel, J
    double gain = 0;                          // largest fall from one of them, J
    std::string gain_channel;                 // that fell most; empty: numerical
    double start_time = 0, last_time = 0;     // s
    double work         = 0;                  // of loads, obstacles and gravity since the start, J
    double work_in_time = 0;                  // its integral, J s
    double motion       = 0;                  // that of the kinetic energy, J s
  };
} // namespace scree

#endif
