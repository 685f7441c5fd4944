// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/run/mesh_adaptation.h>
#include <scree/step/timer_section.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  MeshAdaptation<dim>::MeshAdaptation(Scene<dim> &scene,
                                      Scheme<dim> &scheme,
                                      TimerOutput &timer,
                                      const MPI_Comm communicator)
      : scene(scene)
      , scheme(scheme)
      , timer(timer)
      , communicator(communicator)
  {
  }


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


  template <int dim>
  bool MeshAdaptation<dim>::are_points_at_edge() const
  {
    const auto sets = scheme.point_sets();
    const bool own  = std::any_of(sets.begin(), sets.end(), [](const auto *points) { return points->is_at_edge(); });
    return Utilities::MPI::max(int(own), communicator) == 1;
  }


  template <int dim>
  void MeshAdaptation<dim>::look_at_points()
  {
    points_at_edge = are_points_at_edge() || points_at_edge;
  }


  template <int dim>
  void MeshAdaptation<dim>::summarise(RunFolder &folder) const
  {
    if (scene.grid.follows_points())
      folder.record("fine cells at the end: " +
                    number_text(Utilities::MPI::sum(double(scene.grid.fine_cells().n_owned()), communicator)) +
                    "; they followed the points " + std::to_string(n_refinements) + " times, which took " +
                    number_text(seconds_of(timer, TimerSection::repartition)) + " s");
  }

  template class MeshAdaptation<2>;
  template class MeshAdaptation<3>;
} // namespace scree
