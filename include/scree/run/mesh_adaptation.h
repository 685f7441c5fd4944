// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_run_mesh_adaptation_h
#define scree_run_mesh_adaptation_h

#include <scree/io/run_folder.h>
#include <scree/model/scene.h>
#include <scree/schemes/scheme.h>

#include <deal.II/base/timer.h>

#include <functional>

namespace scree
{
  /// Keeps the points in fine cells. Depends on the state of the run only, so that a resumed run does it in the same
  /// step.
  template <int dim>
  class MeshAdaptation
  {
  public:
    /// Scene, scheme and timer are kept by reference.
    MeshAdaptation(Scene<dim> &scene, Scheme<dim> &scheme, dealii::TimerOutput &timer, const MPI_Comm communicator);

    /// Makes cells fine around the points as they are, and where they go to, once a point has come to the edge of the
    /// fine cells. Collective.
    /// @param reinit fits scene and scheme to the new mesh
    void follow_points(const double time_step, const std::function<void()> &reinit);

    /// A point of some rank has come to the edge of the fine cells. To be called on all ranks.
    void set_points_at_edge()
    {
      points_at_edge = true;
    }

    /// Looks whether that is so. Collective.
    void look_at_points();

    /// Logs how often cells were made fine, and how many there are. Collective.
    void summarise(RunFolder &folder) const;

  private:
    /// The blocks that are to be fine, of all ranks: around the points and on their way. Collective.
    Blocks blocks_ahead(const double time_step) const;

    /// Whether a point of any rank has come to the edge of the fine cells. Collective.
    bool are_points_at_edge() const;

    Scene<dim> &scene;
    Scheme<dim> &scheme;
    dealii::TimerOutput &timer;
    const MPI_Comm communicator;
    bool points_at_edge        = false; // of any rank
    unsigned int n_refinements = 0;     // that followed the points
  };
} // namespace scree

#endif
