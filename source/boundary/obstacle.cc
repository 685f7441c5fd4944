// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/boundary/obstacle.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The entry's place, or the middle of the box's floor.
    template <int dim>
    Point<dim> pivot_of(const ObstacleParameters &parameters, const BackgroundGrid<dim> &grid)
    {
      Point<dim> pivot = grid.lower_corner();
      if (parameters.pivot.empty())
        for (unsigned int a = 0; a + 1 < dim; ++a)
          pivot[a] += 0.5 * (grid.upper_corner()[a] - grid.lower_corner()[a]);
      else
        for (unsigned int a = 0; a < dim; ++a)
          pivot[a] = number_of(Utilities::split_string_list(parameters.pivot)[a]);
      return pivot;
    }
  } // namespace


  template <int dim>
  Obstacle<dim>::Obstacle(const ObstacleParameters &parameters,
                          const GridParameters &box,
                          const BackgroundGrid<dim> &grid)
      : name(parameters.name())
      , friction_coefficient(parameters.surface.friction_coefficient())
      , no_slip(parameters.surface.no_slip())
      , is_moving(parameters.is_moving())
      , pivot(pivot_of<dim>(parameters, grid))
      , grid(grid)
      , level_set(make_bed<dim>(parameters.surface, box.lower_corner, box.upper_corner, box.cell_size))
      , motion(
            is_moving
                ? parse_expression<1>(entry_name(parameters.surface.subsection, "Velocity"), parameters.velocity, dim)
                : nullptr)
      , surface(grid, *level_set, is_moving ? SurfaceMotion::rigid : SurfaceMotion::none)
  {
  }


  template <int dim>
  bool Obstacle<dim>::covers(const unsigned int face, const Point<dim> &node) const
  {
    constexpr double reach = 1.5; // of a node's shape function, cells
    for (unsigned int corner = 0; corner < 1u << dim; ++corner)
      {
        Point<dim> x = node;
        for (unsigned int a = 0; a < dim; ++a)
          if (a != face / 2)
            x[a] = std::clamp(node[a] + (corner >> a & 1 ? reach : -reach) * grid.cell_size(),
                              grid.lower_corner()[a],
                              grid.upper_corner()[a]);
        if (!contains(Point<dim>(x - moved)))
          return false;
      }
    return contains(Point<dim>(node - moved));
  }


  template <int dim>
  void Obstacle<dim>::add_covered_nodes(std::vector<std::pair<unsigned int, std::uint8_t>> &nodes) const
  {
    std::vector<unsigned int> on_walls;
    for (const auto &cell : grid.fine_cells().cells())
      if (surface.least_distance(cell.index) < 0. && grid.open_knots(cell.index) != 0)
        for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
          if (const unsigned int node = grid.nodes(cell.index)[i]; grid.node_faces(node) != 0)
            on_walls.push_back(node);
    std::sort(on_walls.begin(), on_walls.end());
    on_walls.erase(std::unique(on_walls.begin(), on_walls.end()), on_walls.end());
    for (const unsigned int node : on_walls)
      {
        std::uint8_t covered = 0;
        for (unsigned int f = 0; f < 2 * dim; ++f)
          if (grid.node_faces(node) >> f & 1 && covers(f, grid.node_position(node)))
            covered |= 1u << f;
        if (covered != 0)
          nodes.emplace_back(node, covered);
      }
  }


  template <int dim>
  Tensor<1, dim> Obstacle<dim>::velocity_at(const double time) const
  {
    Tensor<1, dim> velocity;
    for (unsigned int a = 0; motion && a < dim; ++a)
      velocity[a] = motion->value(Point<1>(time), a);
    return velocity;
  }


  template <int dim>
  void Obstacle<dim>::begin_step(const double time, const double time_step)
  {
    if (!is_moving)
      return;
    // Gauss' rule of two places.
    const double middle = time + 0.5 * time_step, away = 0.5 * time_step / std::sqrt(3.);
    mean_velocity = 0.5 * (velocity_at(middle - away) + velocity_at(middle + away));
  }


  template <int dim>
  void Obstacle<dim>::end_step(const double time_step)
  {
    if (!is_moving)
      return;
    AssertThrow(
        mean_velocity.norm() * time_step < surface.reach() / 3.,
        ExcMessage("Obstacle " + name + " crosses more than a cell in a step, at " + number_text(mean_velocity.norm()) +
                   " m/s. Remedies: a smaller 'Maximum time step' in subsection Time step, a lower 'Velocity'."));
    moved += time_step * mean_velocity;
    surface.move_to(moved);
  }

  template class Obstacle<2>;
  template class Obstacle<3>;
} // namespace scree
