// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_obstacle_h
#define scree_boundary_obstacle_h

#include <scree/geometry/bed_parameters.h>
#include <scree/mesh/discrete_level_set.h>
#include <scree/input/expression.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
  /// A rigid body that soil and water meet, at rest or moved without turning: a wall, a pile, a gate, a piston.
  template <int dim>
  class Obstacle
  {
  public:
    /// At its place of the start. Collective.
    /// @param box lower and upper corners are asked for
    Obstacle(const ObstacleParameters &parameters, const GridParameters &box, const BackgroundGrid<dim> &grid);

    /// Fits the surface to the grid's current cells. Collective.
    void reinit()
    {
      surface.reinit(moved);
    }

    /// Whether a place was inside at the start.
    bool contains(const dealii::Point<dim> &x) const
    {
      return !level_set->is_open(x);
    }

    /// Adds the nodes of walls that it covers now all about, with these walls (bit f: face f): a wall does nothing to
    /// what the obstacle keeps from it, and would hold the nodes that are to move with the obstacle.
    /// @param nodes of this rank's cells, ghosts included
    void add_covered_nodes(std::vector<std::pair<unsigned int, std::uint8_t>> &nodes) const;

    /// Its surface at the start.
    const LevelSet<dim> &shape() const
    {
      return *level_set;
    }

    /// Velocity at a time, m/s.
    dealii::Tensor<1, dim> velocity_at(const double time) const;

    /// Sets velocity() to the mean of the step, s, that comes.
    void begin_step(const double time, const double time_step);

    /// Moves on by the step of begin_step(). Collective; throws if it crosses more than a cell.
    void end_step(const double time_step);

    /// In the current step, m/s.
    const dealii::Tensor<1, dim> &velocity() const
    {
      return mean_velocity;
    }

    /// Since the start, m: the integral of the velocity over the steps.
    const dealii::Tensor<1, dim> &displacement() const
    {
      return moved;
    }

    const std::string name;            ///< name of its subsection without the prefix
    const double friction_coefficient; ///< infinite: soil that presses does not slip
    const bool no_slip;                ///< whether free water does not slip
    const bool is_moving;              ///< whether it has an entry `Velocity`
    const dealii::Point<dim> pivot;    ///< of the moment, m; it stays where it is

    /// What a run that goes on needs; reinit() moves the surface then.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &moved;
    }

  private:
    /// Whether it covers a face of the box as far as a node there reaches.
    bool covers(const unsigned int face, const dealii::Point<dim> &node) const;

    const BackgroundGrid<dim> &grid;
    const std::unique_ptr<LevelSet<dim>> level_set; // of the start
    const std::unique_ptr<Expression<1>> motion;    // m/s; null at rest
    dealii::Tensor<1, dim> mean_velocity, moved;

  public:
    DiscreteLevelSet<dim> surface; ///< its surface where it is now, sampled on the mesh
  };
} // namespace scree

#endif
