// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/momentum/solid_phase.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    bool is_averaged(const SoilBody<dim> &body)
    {
      return body.material->nonlocal_variable.length > 0;
    }
  } // namespace


  template <int dim>
  SolidPhase<dim>::SolidPhase(const BackgroundGrid<dim> &grid,
                              const TransferParameters &transfer,
                              const StabilisationParameters &stabilisation,
                              std::list<SoilBody<dim>> &bodies,
                              std::list<SurfaceLoad<dim>> &loads,
                              const unsigned int group)
      : field(grid)
      , transfer(grid, transfer, stabilisation)
      , bodies(bodies)
      , loads(loads)
  {
    for (auto &body : bodies)
      if (body.group == group && !body.is_rigid)
        {
          moving.push_back(&body);
          if (is_averaged(body) && !nonlocal)
            nonlocal = std::make_unique<NonlocalAverage<dim>>(grid);
        }
  }


  template <int dim>
  void SolidPhase<dim>::reinit()
  {
    field.reinit();
    transfer.reinit();
    for (auto &one : loads)
      one.reinit();
    if (nonlocal)
      nonlocal->reinit();
  }


  template <int dim>
  void SolidPhase<dim>::average(TimerOutput &timer)
  {
    if (!nonlocal)
      return;
    const TimedPart part(timer, TimerSection::nonlocal);
    for (auto *body : moving)
      if (is_averaged(*body))
        nonlocal->update(*body);
  }


  template <int dim>
  void SolidPhase<dim>::to_grid(const double time)
  {
    load_time = time;
    field.clear();
    for (const auto *body : moving)
      transfer.to_grid(*body, field);
    for (auto &one : loads)
      one.find_areas(bodies);
  }


  template <int dim>
  void SolidPhase<dim>::add_loads(const double delay)
  {
    load_time += delay;
    load = 0.;
    for (const auto &one : loads)
      load += one.add_to(field, load_time);
  }


  template <int dim>
  void SolidPhase<dim>::to_points(const double time_step, const double damping_time, StepReport<dim> &report)
  {
    transfer.to_points(
        moving, field, time_step, damping_time, [&](const SoilBody<dim> &body, const MotionReport<dim> &motion) {
          report.speeds.include_wave(
              body.wave_speed(motion.material.largest_bulk_modulus, motion.material.largest_compression));
          report.speeds.include_point(motion.largest_speed);
          report.material.add(motion.material);
          report.soil += motion.sums;
          report.n_updates += motion.material.n_updates;
        });
    for (auto &one : loads)
      report.balance.load_work += one.move(field, load_time, time_step);
  }


  template <int dim>
  void SolidPhase<dim>::append_point_sets(std::vector<PointSet<dim> *> &sets)
  {
    for (auto &body : bodies)
      sets.push_back(&body.points);
    for (auto &one : loads)
      sets.push_back(&one.points());
  }

  template class SolidPhase<2>;
  template class SolidPhase<3>;
} // namespace scree
