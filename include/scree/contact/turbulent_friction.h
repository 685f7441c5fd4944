// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_contact_turbulent_friction_h
#define scree_contact_turbulent_friction_h

#include <scree/bodies/phases.h>
#include <scree/mesh/discrete_level_set.h>
#include <scree/mesh/node_values.h>
#include <scree/step/step_report.h>

#include <list>

namespace scree
{
  /// Friction rho g v^2/xi of soil that slides over a bed at the speed v (@source{voellmy1955}), beside that of
  /// Coulomb.
  ///
  /// It acts on the points within a cell of the bed, with a weight w(d) = 2/h (1 - d/h) of the distance d, whose
  /// integral is 1 where the soil is a cell deep or more: so it does not depend on how points lie along the bed.
  template <int dim>
  class TurbulentFriction
  {
  public:
    /// @param bed at rest; kept by reference, as the grid
    /// @param coefficient xi, m/s^2, above 0
    /// @param gravity m/s^2
    TurbulentFriction(const BackgroundGrid<dim> &grid,
                      const DiscreteLevelSet<dim> &bed,
                      const double coefficient,
                      const double gravity);

    /// Adds the force at the start of a step of `time_step` s to the nodes, before ranks add theirs.
    /// @param group of the bodies whose nodes these are
    void add_to(NodalField<dim> &field,
                std::list<SoilBody<dim>> &bodies,
                const unsigned int group,
                const double time_step,
                Budget<dim> &balance) const;

  private:
    template <int n>
    void add_to(NodalField<dim> &field,
                std::list<SoilBody<dim>> &bodies,
                const unsigned int group,
                const double time_step,
                Budget<dim> &balance) const;

    const BackgroundGrid<dim> &grid;
    const DiscreteLevelSet<dim> &bed;
    const double factor; // g/xi, -
    const double reach;  // m
  };
} // namespace scree

#endif
