// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_wall_forces_h
#define scree_postprocess_wall_forces_h

#include <scree/boundary/boundary_conditions.h>
#include <scree/boundary/water_walls.h>
#include <scree/step/budget.h>
#include <scree/transfer/water_view.h>

#include <string>
#include <vector>

namespace scree
{
  /// The mean force of soil and water on each wall of the box between two calls, N (2D: N/m). Walls are the faces that
  /// are closed to soil or water.
  template <int dim>
  class WallForces
  {
  public:
    /// @param water_walls null in a dry scene
    WallForces(const BackgroundGrid<dim> &grid,
               const BoundaryConditions<dim> &walls,
               const WaterBoundaryConditions<dim> *water_walls);

    /// Names of the columns of collect(), with their unit.
    std::vector<std::string> names() const;

    /// The forces since the last call, nan at the first one: of the soil and of the water (what walls take of their
    /// motion; the soil's is the effective one), and the pore pressure's across the wall at this instant, of its
    /// positive part over the cells that hold water. Collective.
    /// @param totals sums of this rank since the start
    /// @param time s
    /// @param view null in a dry scene
    std::vector<double> collect(const Budget<dim> &totals, const double time, const WaterView<dim> *view);

    /// Saves or loads time and impulses of the last call (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &has_start &last_time &last_impulses;
    }

  private:
    /// Force of the pore pressure on each face, N, of all ranks.
    std::vector<double> pressure_forces(const WaterView<dim> &view) const;

    const BackgroundGrid<dim> &grid;
    const bool is_wet;
    std::vector<unsigned int> faces; // the walls
    bool has_start   = false;
    double last_time = 0;
    std::vector<double> last_impulses; // of all ranks, in the order of impulses()
  };
} // namespace scree

#endif
