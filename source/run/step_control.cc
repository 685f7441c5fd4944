// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/step_control.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    const std::string remedy_for_instability =
        "Remedies: a smaller 'Courant number' in subsection Time step, 'F-bar = modified' in subsection Stabilisation.";

    /// What and where the fastest point of this rank is, its speed beside, m/s; "" and 0 without points.
    template <int dim>
    std::pair<double, std::string> fastest_point(const Scene<dim> &scene)
    {
      std::pair<double, std::string> fastest{ 0., "" };
      Point<dim> place;
      const auto look = [&](const std::string &name, const PointSet<dim> &points, const unsigned int velocity) {
        for_each_point(points, [&](const auto &point) {
          const double speed = vector_of<dim>(point.properties + velocity).norm();
          if (std::isfinite(speed) && speed <= fastest.first)
            return;
          place   = point.location;
          fastest = { std::isfinite(speed) ? speed : std::numeric_limits<double>::infinity(),
                      "a point of " + name + " at (" + number_text(place) + ") m" };
        });
      };
      for (const auto &body : scene.bodies)
        look(body.name, body.points, PropertyLayout<dim>::velocity);
      for (const auto &part : scene.water)
        if (part.carrier() == nullptr)
          look("the water", part.points(), part.layout.velocity);
      if (fastest.second.empty())
        return fastest;
      const unsigned int face = nearest_face(scene.grid, place);
      const double to_wall    = face % 2 == 0 ? place[face / 2] - scene.grid.lower_corner()[face / 2]
                                              : scene.grid.upper_corner()[face / 2] - place[face / 2];
      if (to_wall < 2. * scene.grid.cell_size())
        {
          const auto of_soil = scene.walls.face_crossed(place);
          fastest.second += " beside the wall '" + of_soil.first + "'";
          if (scene.water_walls && of_soil.second != scene.water_walls->face_crossed(place).second)
            fastest.second += of_soil.second ? ", which is open to soil and closed to water: open it to both"
                                             : ", which is closed to soil and open to water: close it to both";
        }
      return fastest;
    }
  } // namespace


  template <int dim>
  void StepControl<dim>::agree_on(std::vector<double> &largest)
  {
    const TimedPart part(timer, TimerSection::waiting);
    for (double &value : largest)
      if (std::isnan(value))
        value = std::numeric_limits<double>::infinity();
    largest.push_back(static_cast<double>(stop.reason()));
    Utilities::MPI::max(largest, communicator, largest);
    speeds = { largest[0], largest[1] };
    scene.include_inflows(speeds);
    reason = static_cast<StopReason>(largest.back());
    largest.pop_back();
  }


  template <int dim>
  void StepControl<dim>::require_stable_step(const double largest_step, const double first_step) const
  {
    // A run that gains energy would creep on with ever smaller steps.
    AssertThrow(largest_step > 1e-3 * first_step,
                ExcMessage("The motion is unstable: at t = " + Utilities::to_string(clock.time()) +
                           " s the stable step has fallen to " + Utilities::to_string(largest_step) + " s, from " +
                           Utilities::to_string(first_step) + " s at the start. " + remedy_for_instability));
  }


  template <int dim>
  void StepControl<dim>::require_stable_speed(const double time_step) const
  {
    if (std::isfinite(speeds.points) && speeds.points * time_step < 2 * scene.grid.cell_size())
      return;
    const auto of_ranks = Utilities::MPI::all_gather(communicator, fastest_point(scene));
    const auto fastest  = *std::max_element(of_ranks.begin(), of_ranks.end());
    AssertThrow(false,
                ExcMessage("The motion is unstable at t = " + number_text(clock.time()) + " s: " +
                           number_text(speeds.points) + " m/s, " + fastest.second + ". " + remedy_for_instability));
  }

  template class StepControl<2>;
  template class StepControl<3>;


  template <int dim>
  void MeshAdaptation<dim>::follow_points(const double time_step, const std::function<void()> &reinit)
  {
    if (!points_at_edge)
      return;
    const TimedPart part(timer, TimerSection::repartition);
    const Blocks blocks = blocks_ahead(time_step);
    const auto sets     = scheme.point_sets();
    for (PointSet<dim> *points : sets)
      points->lift();
    scene.grid.refine(blocks, Shares::kept);
    for (PointSet<dim> *points : sets)
      {
        points->put_down();
        points->costs().reinit(scene.grid.triangulation().n_active_cells());
      }
    reinit();
    points_at_edge = are_points_at_edge();
    ++n_refinements;
    AssertThrow(!points_at_edge, ExcInternalError("A point is outside the fine cells."));
  }


  template <int dim>
  Blocks MeshAdaptation<dim>::blocks_ahead(const double time_step) const
  {
    constexpr double steps_ahead = 2000; // A new mesh costs about 100 steps, a cell without points memory alone.
    constexpr double few_blocks  = GridParameters::least_ahead / (1 << dim);
    const auto blocks            = [this](const double time) {
      return scene.grid.with_surroundings(scene.blocks_of_points(time));
    };
    const Blocks around = blocks(0.);
    for (double steps = steps_ahead; steps > 1; steps /= 2)
      if (Blocks ahead = blocks(steps * time_step);
          ahead.size() <= std::max(few_blocks, GridParameters::most_ahead * around.size()))
        return ahead;
    return around;
  }


  template class MeshAdaptation<2>;
  template class MeshAdaptation<3>;


  template <int dim>
  void account_for_lost_points(Scene<dim> &scene, RunBalance<dim> &totals, const double time)
  {
    const auto lose = [&](const std::string &name,
                          const std::vector<LostPoint<dim>> &points,
                          const auto &layout,
                          const BoundaryConditions<dim> &walls,
                          double &lost_mass) {
      for (const LostPoint<dim> &point : points)
        {
          const auto [face, is_open] = walls.face_crossed(point.location);
          AssertThrow(is_open,
                      ExcMessage("A point of " + name + " left the box through the closed wall '" + face + "' at (" +
                                 number_text(point.location) + ") m, t = " + number_text(time) +
                                 " s. Remedies: a smaller 'Courant number', or 'open' (water: 'drained') in subsection "
                                 "Boundaries."));
          const double mass             = point.properties[layout.mass];
          const double inertia          = scene.forcing.mass_scaling() * mass;
          const Tensor<1, dim> velocity = vector_of<dim>(point.properties.data() + layout.velocity);
          lost_mass += mass;
          totals.lost_momentum += inertia * velocity;
          totals.lost_energy += 0.5 * inertia * velocity.norm_square() -
                                mass * (scene.forcing.gravity() * (point.location - Point<dim>()));
        }
    };
    for (auto &part : scene.water)
      lose("the water",
           part.points().lost(),
           part.layout,
           part.own_points() != nullptr ? *scene.water_walls : scene.walls,
           totals.lost_water_mass);
    for (auto &body : scene.bodies)
      {
        lose(body.name, body.points.lost(), body.layout, scene.walls, totals.lost_mass);
        for (const LostPoint<dim> &point : body.points.lost())
          totals.lost_volume += point.properties[body.layout.mass] / body.density;
        totals.n_lost += body.points.lost().size();
        body.points.lost().clear();
      }
    for (auto &part : scene.water)
      part.points().lost().clear();
    for (auto &load : scene.loads)
      load.points().lost().clear();
  }

  template void account_for_lost_points(Scene<2> &, RunBalance<2> &, const double);
  template void account_for_lost_points(Scene<3> &, RunBalance<3> &, const double);
} // namespace scree
