// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_volume_correction_h
#define scree_scheme_volume_correction_h

#include <scree/grid/constraints.h>
#include <scree/scheme/pore_pressure.h>

namespace scree
{
  /// Moves points of free water from where they crowd to where they are few: positions only, by a tenth of a cell at
  /// most.
  template <int dim>
  class VolumeCorrection
  {
  public:
    /// @param part of the surplus that a step takes out of each corner, above 0
    VolumeCorrection(const BackgroundGrid<dim> &grid,
                     const Constraints<dim> &constraints,
                     PorePressure<dim> &pressure,
                     const double part);

    /// Fits what lives on nodes and corners to the grid's current partition. Collective.
    void reinit();

    /// Moves points of water's own, after the step's solve and before they are sorted. Collective.
    void apply(WaterPhase<dim> &water,
               const Mixture<dim> &mixture,
               const NodalField<dim> &water_field,
               const PoreField<dim> &pores,
               const double time_step,
               StepBalance<dim> &balance);

  private:
    /// A flow that takes `part` of the surplus out of each corner: L chi = part (F - 1) integral psi / dt.
    void find_potential(const Mixture<dim> &mixture, const double time_step, StepBalance<dim> &balance);

    /// The way of the nodes, m, that this flow makes of water.
    void find_shifts(const Mixture<dim> &mixture,
                     const NodalField<dim> &water_field,
                     const PoreField<dim> &pores,
                     const double time_step);

    const BackgroundGrid<dim> &grid;
    const Constraints<dim> &constraints;
    PorePressure<dim> &pressure;
    const double part;
    CornerVector source, potential;
    NodeValues<dim, 2 * dim> shifts; // of soil, not used, and of water, m
  };
} // namespace scree

#endif
