// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_scheme_dry_scheme_h
#define scree_scheme_dry_scheme_h

#include <scree/scheme/bed_contact.h>
#include <scree/scheme/explicit_step.h>
#include <scree/scheme/scheme.h>
#include <scree/scheme/soil_motion.h>

namespace scree
{
  /// Soil without water: one phase, explicit.
  template <int dim>
  class DryScheme : public Scheme<dim>
  {
  public:
    /// @param bed contact with rigid surfaces; null without any
    DryScheme(const BackgroundGrid<dim> &grid,
              const Constraints<dim> &constraints,
              const Forcing<dim> &forcing,
              const TransferParameters &transfer,
              const StabilisationParameters &stabilisation,
              std::list<SoilBody<dim>> &bodies,
              std::list<SurfaceLoad<dim>> &loads,
              std::unique_ptr<BedContact<dim>> bed,
              dealii::TimerOutput &timer);

    void reinit() override;
    void read_points() override;
    void to_grid(const double time) override;
    void solve(const double time_step, StepReport<dim> &report) override;
    void to_points(const double time_step, StepReport<dim> &report) override;
    double stable_step(const Clock &clock, const Speeds &speeds) const override;
    std::vector<PointSet<dim> *> point_sets() override;
    const NodalField<dim> &soil_field() const override;
    std::unique_ptr<WaterView<dim>> water_view() const override;

  private:
    const BackgroundGrid<dim> &grid;
    SoilMotion<dim> soil;
    ExplicitStep<dim> step;
    std::unique_ptr<BedContact<dim>> bed;
    dealii::TimerOutput &timer;
  };
} // namespace scree

#endif
