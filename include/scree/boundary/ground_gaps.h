// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_ground_gaps_h
#define scree_boundary_ground_gaps_h

#include <scree/mesh/cut_cells.h>
#include <scree/particles/point_set.h>

#include <vector>

namespace scree
{
  /// Rigid ground inside the cells constrains the velocity at its facets only once a particle
  /// has reached them: the rule of WallGaps, for which a facet is what a node is on a wall of the box.
  ///
  /// The gap of a facet is that of the nearest particle of its cell, less .6 of the particle spacing. Until it closes,
  /// neither contact nor the pressure act on what approaches the facet faster than after a fall through an eighth of a
  /// cell. A cell may be full by the volume of its particles before they are there, so that its fill does not count.
  template <int dim>
  class GroundGaps
  {
  public:
    /// @param cut_cells of the ground; null: there is none, and all calls return at once
    /// @param gravity m/s^2
    GroundGaps(const BackgroundGrid<dim> &grid, const CutCells<dim> *cut_cells, const double gravity);

    /// Forgets the gaps, before a new step.
    void clear();

    /// Looks at points.
    /// @param velocity its place among their properties
    /// @param spacing of the points at the start, m
    void add(const PointSet<dim> &points, const unsigned int velocity, const double spacing);

    /// Whether the pressure acts on a facet in a step of `time_step` s: a point has reached it, or will, or is slow.
    bool acts(const unsigned int facet, const double time_step) const
    {
      return closing_times[facet] < time_step;
    }

    /// Velocity, m/s, relative to the facet, with which the mixture may approach one on which the pressure acts.
    double approach_of_mixture(const unsigned int facet, const double time_step) const
    {
      return closing_times[facet] > 0. ? closing_gaps[facet] / time_step : 0.;
    }

    /// Velocity, m/s, with which material at a facet may approach it in a step of `time_step` s: what closes the gap
    /// within it; 0 where there is none.
    /// @param speed m/s, of the material into the ground, relative to that
    double approach_of_material(const unsigned int facet, const double speed, const double time_step) const
    {
      return gaps[facet] > 0. && speed > slow ? gaps[facet] / time_step : 0.;
    }

  private:
    const BackgroundGrid<dim> &grid;
    const CutCells<dim> *cut_cells; // may be null
    const double slow;              // m/s, up to which the ground acts at once
    std::vector<double> gaps;       // by facet, m

    // Of the point that reaches the facet first, s and m; 0 where one has, or is slow.
    std::vector<double> closing_times, closing_gaps;
  };
} // namespace scree

#endif
