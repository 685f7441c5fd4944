// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_run_totals_h
#define scree_postprocess_run_totals_h

#include <scree/materials/material.h>
#include <scree/step/budget.h>

namespace scree
{
  /// Sums over the steps of a run, of this rank (2D: per m); what balances and the statistics need.
  template <int dim>
  struct RunTotals
  {
    Budget<dim> balance;                     ///< momentum and energy at the nodes
    dealii::Tensor<1, dim> lost_momentum;    ///< of soil and water points that left through an open wall, N s
    double lost_mass       = 0;              ///< of soil, kg
    double lost_volume     = 0;              ///< of soil as dense as at the start, m^3 (2D: per m)
    double lost_water_mass = 0;              ///< kg
    double lost_energy     = 0;              ///< kinetic and potential, J
    dealii::Tensor<1, dim> entered_momentum; ///< of soil and water points of inflows, N s
    double n_entered           = 0;          ///< points of soil
    double entered_mass        = 0;          ///< of soil, kg
    double entered_water_mass  = 0;          ///< kg
    double entered_energy      = 0;          ///< kinetic, potential and elastic, J
    double plastic_dissipation = 0;          ///< J

    // Counts; doubles hold them exactly and travel like the rest.
    double n_lost    = 0, ///< points that left the box
        n_updates    = 0, ///< updates of stress, points times steps
        n_substeps   = 0, ///< return maps
        n_fallbacks  = 0, ///< see UpdateReport::n_fallbacks
        n_vertices   = 0, ///< see UpdateReport::n_vertices
        n_unresolved = 0; ///< see UpdateReport::n_unresolved

    RunTotals() = default;

    /// @param n_obstacles of the scene
    explicit RunTotals(const unsigned int n_obstacles)
    {
      balance.obstacles.resize(n_obstacles);
    }

    /// Adds dissipation and counts of a step's stress updates.
    void add(const UpdateReport &report);

    /// The sums over ranks, on all of them. Collective.
    RunTotals sum_over_ranks(const MPI_Comm communicator) const;

    /// What soil and water have been given, N s.
    dealii::Tensor<1, dim> impulse() const;

    /// Energy that known losses have taken, less work and energy that has come in, J.
    double energy_taken() const;

    /// Saves or loads all members (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &balance;
      archive &plastic_dissipation &lost_mass &lost_volume &lost_water_mass &lost_energy &lost_momentum &n_lost;
      archive &entered_momentum &n_entered &entered_mass &entered_water_mass &entered_energy;
      archive &n_updates &n_substeps &n_fallbacks &n_vertices &n_unresolved;
    }
  };
} // namespace scree

#endif
