// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/motion_before_release.h>
#include <scree/run/strength_trial.h>
#include <scree/tensor/vector.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double part_that_moves = 0.01; // of the mass; single points at the surface do not count
    constexpr double speed_at_rest   = 2e-4; // over sqrt(g H): terminal speed with a thousandth of strength missing


    template <int dim, typename Visit>
    void visit_moving(const std::list<SoilBody<dim>> &bodies, const Visit &visit)
    {
      for (const auto &body : bodies)
        if (!body.is_rigid)
          for_each_point(body.points, [&](const auto &point) { visit(body, point); });
    }


    /// Extent of the soil along gravity, m. Collective.
    template <int dim>
    double height_of_soil(const Scene<dim> &scene, const MPI_Comm communicator)
    {
      const Tensor<1, dim> down = scene.forcing.gravity() / scene.forcing.gravity().norm();
      double lowest = -std::numeric_limits<double>::max(), highest = lowest;
      visit_moving(scene.bodies, [&](const auto &, const auto &point) {
        const double depth = Tensor<1, dim>(point.location) * down;
        lowest             = std::max(lowest, depth);
        highest            = std::max(highest, -depth);
      });
      return Utilities::MPI::max(lowest, communicator) + Utilities::MPI::max(highest, communicator);
    }


    /// What this part of the mass exceeds, within 1 %. Collective.
    /// @param value of a body and a point, not negative
    template <int dim, typename Value>
    double exceeded_by(const double part,
                       const std::list<SoilBody<dim>> &bodies,
                       const Value &value,
                       const MPI_Comm communicator)
    {
      constexpr unsigned int n_bins = 1500;
      constexpr double bins_per_e   = 100.;
      double largest                = 0.;
      visit_moving(bodies,
                   [&](const auto &body, const auto &point) { largest = std::max(largest, value(body, point)); });
      largest = Utilities::MPI::max(largest, communicator);
      if (largest == 0.)
        return 0.;

      std::vector<double> masses(n_bins, 0.); // from the largest value down
      visit_moving(bodies, [&](const auto &body, const auto &point) {
        const double bin = -bins_per_e * std::log(std::max(value(body, point), 1e-100) / largest);
        masses[std::min(bin, n_bins - 1.)] += point.properties[body.layout.mass];
      });
      Utilities::MPI::sum(masses, communicator, masses);
      double all = 0.;
      for (const double mass : masses)
        all += mass;
      unsigned int bin = 0;
      for (double above = masses[0]; bin + 1 < n_bins && above <= part * all;)
        above += masses[++bin];
      return largest * std::exp(-(bin + 0.5) / bins_per_e);
    }
  } // namespace


  TrialJudge::TrialJudge(const TrialBounds &bounds)
      : bounds(bounds)
  {
  }


  TrialEnd TrialJudge::look(const double time, const double displacement, const double speed)
  {
    if (displacement > bounds.displacement)
      return TrialEnd::fails;
    last.push_back({ time, speed });
    while (last.size() > 1 && last[1].time <= time - bounds.time_scale)
      last.pop_front();
    if (last.front().time <= time - bounds.time_scale &&
        std::all_of(last.begin(), last.end(), [&](const Look &look) { return look.speed < bounds.speed; }))
      return TrialEnd::rests;
    return time >= bounds.maximum_time ? TrialEnd::fails : TrialEnd::undecided;
  }


  template <int dim>
  TrialBounds bounds_of_trial(const Scene<dim> &scene, const SafetyParameters &safety, const double displacement)
  {
    const double gravity = scene.forcing.gravity().norm();
    const double height  = height_of_soil(scene, scene.grid.triangulation().get_communicator());
    const double time    = std::sqrt(height / gravity);
    return { time, speed_at_rest * gravity * time, displacement * height, safety.maximum_time * time };
  }


  template <int dim>
  Trial try_strength(const Parameters &parameters,
                     const double displacement,
                     Scene<dim> &scene,
                     Scheme<dim> &scheme,
                     StepControl<dim> &control,
                     RunFolder &folder,
                     const std::function<void(double)> &advance)
  {
    constexpr unsigned int steps_between_looks = 20;
    const MPI_Comm communicator                = scene.grid.triangulation().get_communicator();
    for ([[maybe_unused]] const auto &body : scene.bodies)
      Assert(body.layout.has_start, ExcMessage("A trial needs the displacement of the points."));
    const TrialBounds bounds = bounds_of_trial(scene, parameters.safety, displacement);
    TrialJudge judge(bounds);
    TimeStepper clock(parameters.time_step.with_held_pressure(scene.forcing.gravity().norm(), scene.grid.cell_size()));
    Trial trial{ TrialEnd::undecided, 0., 0., 0 };
    scene.forcing.set_damping(parameters.safety.damping_rate(bounds.time_scale));
    scheme.set_drainage(Drainage::drained); // the pore pressure is held
    move_before_release(control, clock, bounds.maximum_time, steps_between_looks, advance, [&](const double) {
      trial.displacement = exceeded_by(
          part_that_moves,
          scene.bodies,
          [](const auto &body, const auto &point) {
            return (Tensor<1, dim>(point.location) - vector_of<dim>(point.properties + body.layout.start)).norm();
          },
          communicator);
      const double speed = exceeded_by(
          part_that_moves,
          scene.bodies,
          [](const auto &body, const auto &point) {
            return vector_of<dim>(point.properties + body.layout.velocity).norm();
          },
          communicator);
      trial.end = judge.look(clock.time(), trial.displacement, speed);
      folder.record("t " + number_text(clock.time()) + " s, displacement " + number_text(trial.displacement) +
                    " m, speed " + number_text(speed) + " m/s");
      return trial.end != TrialEnd::undecided;
    });
    scene.forcing.set_damping(0.);
    scheme.set_drainage(Drainage::undrained);
    scene.stop();
    control.measure_speeds();
    trial.time  = clock.time();
    trial.steps = clock.step();
    return trial;
  }

  template TrialBounds bounds_of_trial(const Scene<2> &, const SafetyParameters &, const double);
  template TrialBounds bounds_of_trial(const Scene<3> &, const SafetyParameters &, const double);
  template Trial try_strength(const Parameters &,
                              const double,
                              Scene<2> &,
                              Scheme<2> &,
                              StepControl<2> &,
                              RunFolder &,
                              const std::function<void(double)> &);
  template Trial try_strength(const Parameters &,
                              const double,
                              Scene<3> &,
                              Scheme<3> &,
                              StepControl<3> &,
                              RunFolder &,
                              const std::function<void(double)> &);
} // namespace scree
