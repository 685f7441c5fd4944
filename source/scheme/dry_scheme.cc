// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/scheme/dry_scheme.h>

namespace scree
{
  using namespace dealii;

  template <int dim>
  DryScheme<dim>::DryScheme(const BackgroundGrid<dim> &grid,
                            const Constraints<dim> &constraints,
                            const Forcing<dim> &forcing,
                            const TransferParameters &transfer,
                            const StabilisationParameters &stabilisation,
                            std::list<SoilBody<dim>> &bodies,
                            std::list<SurfaceLoad<dim>> &loads,
                            std::unique_ptr<BedContact<dim>> bed,
                            TimerOutput &timer)
      : grid(grid)
      , soil(grid, transfer, stabilisation, bodies, loads)
      , step(constraints, forcing)
      , bed(std::move(bed))
      , timer(timer)
  {
  }


  template <int dim>
  void DryScheme<dim>::reinit()
  {
    soil.reinit();
    if (bed)
      bed->reinit();
  }


  template <int dim>
  void DryScheme<dim>::read_points()
  {
    soil.field.clear();
  }


  template <int dim>
  void DryScheme<dim>::to_grid(const double time)
  {
    const TimedPart part(timer, StepPart::points_to_grid);
    soil.to_grid(time);
  }


  template <int dim>
  void DryScheme<dim>::solve(const double time_step, StepReport<dim> &report)
  {
    {
      const TimedPart part(timer, StepPart::points_to_grid);
      soil.add_loads(0.); // Velocity and place leap over each other: the acceleration is that of the start.
      soil.field.add_contributions();
    }
    {
      const TimedPart part(timer, StepPart::nodes);
      report.balance += step.solve(soil.field, time_step);
      report.balance.load_impulse += soil.load_impulse(time_step);
      soil.field.update_ghosts();
    }
    if (!bed)
      return;
    const TimedPart part(timer, StepPart::bed);
    bed->solve(soil.field, time_step, report.balance);
  }


  template <int dim>
  void DryScheme<dim>::to_points(const double time_step, StepReport<dim> &report)
  {
    const TimedPart part(timer, StepPart::stress);
    soil.to_points(time_step, report);
  }


  template <int dim>
  double DryScheme<dim>::stable_step(const Clock &clock, const Speeds &speeds) const
  {
    const double fastest = bed ? bed->fastest(clock.time()) : 0.;
    // Not std::max: it might lose a NaN.
    return clock.stable_step(grid.cell_size(), speeds.wave, speeds.points < fastest ? fastest : speeds.points);
  }


  template <int dim>
  std::vector<PointSet<dim> *> DryScheme<dim>::point_sets()
  {
    std::vector<PointSet<dim> *> sets;
    soil.append_point_sets(sets);
    return sets;
  }


  template <int dim>
  const NodalField<dim> &DryScheme<dim>::soil_field() const
  {
    return soil.field;
  }


  template <int dim>
  std::unique_ptr<WaterView<dim>> DryScheme<dim>::water_view() const
  {
    return nullptr;
  }

  template class DryScheme<2>;
  template class DryScheme<3>;
} // namespace scree
