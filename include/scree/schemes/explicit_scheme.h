// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_schemes_explicit_scheme_h
#define scree_schemes_explicit_scheme_h

#include <scree/contact/points/point_contact.h>
#include <scree/contact/points/turbulent_friction.h>
#include <scree/contact/bodies/body_contact.h>
#include <scree/momentum/explicit_update.h>
#include <scree/schemes/model.h>
#include <scree/schemes/scheme.h>
#include <scree/momentum/solid_phase.h>

namespace scree
{
  /// Soil without water: one phase, explicit. Each group of bodies that stick to each other has a velocity field of its
  /// own; nearly always there is one.
  template <int dim>
  class ExplicitScheme : public Scheme<dim>
  {
  public:
    /// Makes a field for each group of bodies.
    /// @param model its members are kept by reference
    ExplicitScheme(const Model<dim> &model, dealii::TimerOutput &timer);

    void reinit() override;
    void read_points() override;
    void to_grid(const double time) override;
    void solve(const double time_step, StepReport<dim> &report) override;
    void to_points(const double time_step, StepReport<dim> &report) override;
    NodalForces nodal_forces(const double time_step) const override;
    std::vector<PointSet<dim> *> point_sets() override;
    const NodalField<dim> &soil_field() override;
    std::unique_ptr<WaterView<dim>> water_view() const override;

  private:
    /// Bodies that stick to each other.
    struct Group
    {
      Group(const Model<dim> &model, const unsigned int number, WallGaps<dim> &wall_gaps, dealii::TimerOutput &timer);

      SolidPhase<dim> soil;
      WallGaps<dim> &wall_gaps;
      ExplicitUpdate<dim> momentum;
      PointContact<dim> contact; ///< with rigid surfaces
    };

    /// Those at nodes with these constraints, which groups may share; made where there are none yet.
    WallGaps<dim> &gaps_of(const BackgroundGrid<dim> &grid, Constraints<dim> &constraints);

    /// Sums of all ranks, with the loads, and walls that act. Collective.
    void sum_at_nodes(const double time_step, Budget<dim> &budget);

    /// Impulses where groups meet.
    void solve_contacts(const double time_step, Budget<dim> &budget);

    std::list<SoilBody<dim>> &bodies;
    const BodyForces<dim> &forces;
    const bool meets_surfaces; // rigid ones
    std::list<WallGaps<dim>> wall_gaps;
    std::list<Group> groups;
    std::list<BodyContact<dim>> contacts;
    std::vector<TurbulentFriction<dim>> turbulent_frictions; // of the bed
    std::unique_ptr<NodalField<dim>> mean_field;             // of all groups; null if there is one
    dealii::TimerOutput &timer;
  };
} // namespace scree

#endif
