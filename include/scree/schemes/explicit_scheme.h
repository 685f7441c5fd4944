// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_schemes_explicit_scheme_h
#define scree_schemes_explicit_scheme_h

#include <scree/contact/points/point_contact.h>
#include <scree/contact/bodies/body_contact.h>
#include <scree/contact/contact_parameters.h>
#include <scree/momentum/explicit_update.h>
#include <scree/schemes/scheme.h>
#include <scree/momentum/solid_phase.h>

namespace scree
{
  /// What bodies that stick to each other meet besides the others. What it refers to must live on.
  template <int dim>
  struct GroupSurroundings
  {
    Constraints<dim> *constraints;
    std::unique_ptr<PointContact<dim>> bed; ///< contact with rigid surfaces; null without any
  };

  /// Soil without water: one phase, explicit. Each group of bodies that stick to each other has a velocity field of its
  /// own; nearly always there is one.
  template <int dim>
  class ExplicitScheme : public Scheme<dim>
  {
  public:
    /// @param groups by number
    /// @param pairs of groups in contact
    ExplicitScheme(const BackgroundGrid<dim> &grid,
                   const BodyForces<dim> &forcing,
                   const TransferParameters &transfer,
                   const StabilisationParameters &stabilisation,
                   std::list<SoilBody<dim>> &bodies,
                   std::list<SurfaceLoad<dim>> &loads,
                   std::vector<GroupSurroundings<dim>> groups,
                   const std::vector<ContactPair> &pairs,
                   dealii::TimerOutput &timer);

    void reinit() override;
    void read_points() override;
    void to_grid(const double time) override;
    void solve(const double time_step, StepReport<dim> &report) override;
    void to_points(const double time_step, StepReport<dim> &report) override;
    std::vector<PointSet<dim> *> point_sets() override;
    const NodalField<dim> &soil_field() override;
    std::unique_ptr<WaterView<dim>> water_view() const override;

  private:
    /// Bodies that stick to each other.
    struct Group
    {
      SolidPhase<dim> soil;
      WallGaps<dim> *wall_gaps;
      ExplicitUpdate<dim> step;
      std::unique_ptr<PointContact<dim>> bed;
    };

    /// Those at nodes with these constraints, which groups may share; made where there are none yet.
    WallGaps<dim> &gaps_of(const BackgroundGrid<dim> &grid, Constraints<dim> &constraints);

    /// Impulses where groups meet.
    void solve_contacts(const double time_step, StepReport<dim> &report);

    std::list<SoilBody<dim>> &bodies;
    const BodyForces<dim> &forcing;
    std::list<WallGaps<dim>> wall_gaps;
    std::list<Group> groups;
    std::list<BodyContact<dim>> contacts;
    std::unique_ptr<NodalField<dim>> mean_field; // of all groups; null if there is one
    dealii::TimerOutput &timer;
  };
} // namespace scree

#endif
