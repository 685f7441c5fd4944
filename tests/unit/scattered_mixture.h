// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tests_unit_scattered_mixture_h
#define scree_tests_unit_scattered_mixture_h

#include "test.h"

#include <scree/geometry/bed_parameters.h>
#include <scree/momentum/two_phase_momentum.h>


/// Any number from 0 to 1 that follows from a place and a seed: the same on all ranks.
template <int dim>
double number_at(const dealii::Point<dim> &x, const unsigned int seed)
{
  double sum = 0.7 * seed;
  for (unsigned int a = 0; a < dim; ++a)
    sum += (31. + 7. * a) * x[a];
  const double scattered = 1e3 * std::sin(sum);
  return scattered - std::floor(scattered);
}

/// Three numbers from -1/2 to 1/2 in the same way.
template <int dim>
dealii::Tensor<1, dim> vector_at(const dealii::Point<dim> &x, const unsigned int seed)
{
  dealii::Tensor<1, dim> vector;
  for (unsigned int c = 0; c < dim; ++c)
    vector[c] = number_at(x, seed + c) - 0.5;
  return vector;
}


/// Soil, water or both, tied by little to much drag, at the nodes of a unit box of 4 cells an axis with rigid ground.
template <int dim>
struct ScatteredMixture
{
  explicit ScatteredMixture(const std::string &ground_expression)
      : grid(grid_box<dim>(0., 1., 0.25), MPI_COMM_WORLD)
      , surface("", ground_expression, grid.cell_size())
      , samples(grid, surface)
      , ground({ { &samples } })
      , cut_cells(grid, ground)
      , walls(grid, scree::BoundaryParameters())
      , water_walls(grid, scree::WaterBoundaryParameters())
      , constraints(grid, walls, &water_walls)
      , forcing(grid, std::vector<double>(dim, 0.), scree::BodyForceParameters())
      , wall_gaps(grid, constraints)
      , timer(std::cout, dealii::TimerOutput::never, dealii::TimerOutput::wall_times)
      , step(grid, constraints, wall_gaps, forcing, 1000., timer)
      , soil(grid)
      , water(grid)
      , pores(grid)
      , nodes{ soil, water, pores }
  {
    constexpr unsigned int mass = scree::NodalField<dim>::mass;
    for (unsigned int i = 0; i < grid.n_owned_nodes(); ++i)
      {
        const dealii::Point<dim> x = grid.node_position(i);
        soil[i][mass]              = number_at(x, 1) < 0.2 ? 0. : 0.1 + number_at(x, 2);
        water[i][mass]             = number_at(x, 3) < 0.2 ? 0. : 0.1 + number_at(x, 4);
        if (soil[i][mass] > 0. && water[i][mass] > 0.)
          pores[i][scree::PoreField<dim>::drag] = std::pow(10., 8. * number_at(x, 5) - 4.);
      }
    soil.update_ghosts();
    water.update_ghosts();
    pores.update_ghosts();
  }

  /// A place that tells a segment from others.
  dealii::Point<dim> place_of(const scree::CutFacet<dim> &segment) const
  {
    return grid.node_position(grid.nodes(segment.cell)[0]);
  }

  const scree::BackgroundGrid<dim> grid;
  const scree::ExpressionSurface<dim> surface;
  const scree::DiscreteLevelSet<dim> samples;
  const scree::RigidBoundary<dim> ground;
  const scree::CutCells<dim> cut_cells;
  const scree::BoundaryConditions<dim> walls;
  const scree::BoundaryConditions<dim> water_walls;
  scree::Constraints<dim> constraints;
  const scree::BodyForces<dim> forcing;
  const scree::WallGaps<dim> wall_gaps;
  dealii::TimerOutput timer;
  const scree::TwoPhaseMomentum<dim> step;
  scree::NodalField<dim> soil, water;
  scree::PoreField<dim> pores;
  const scree::MixtureNodes<dim> nodes;
};

#endif
