// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_points_lattice_h
#define scree_points_lattice_h

#include <scree/geometry/level_set.h>
#include <scree/points/point_set.h>

#include <deal.II/base/function.h>

#include <deal.II/grid/tria.h>

#include <functional>
#include <vector>

namespace scree
{
  /// What a material fills of one cube of a lattice.
  template <int dim>
  struct CubePart
  {
    double filled;               ///< part of the cube that its region covers, m^3 (2D: m^2)
    double volume;               ///< of the material itself there: less than `filled` in pores
    dealii::Point<dim> location; ///< centroid of the volume, m
    bool stays = false;          ///< in its cell, however little it is: free water bears pressure there
  };

  /// A point to be.
  template <int dim>
  struct Seed
  {
    typename dealii::Triangulation<dim>::active_cell_iterator cell;
    dealii::Point<dim> location; ///< m
    double volume;               ///< m^3 (2D: per m)
    double filled = 1.;          ///< part of a cube of the lattice that its region covers, of several the sum
    bool stays    = false;       ///< see CubePart
  };

  /// The lattice of a set of points.
  struct Lattice
  {
    unsigned int n;    ///< points along each axis of a cell
    double jitter = 0; ///< largest move of a point along an axis, over the lattice's spacing; below 1/2
    /// Sets with other numbers are moved independently of each other.
    unsigned int sequence = 0;
  };

  /// What lies in the cube with this lower corner, m, and width, m.
  template <int dim>
  using PartOfCube = std::function<CubePart<dim>(const dealii::Point<dim> &lower, const double width)>;

  /// The seeds of this rank's cells on a lattice of cubes. Cubes covered by less than a quarter join the nearest fuller
  /// one of their cell. Jitter moves a seed within its cell by a random amount, the same on any number of ranks, and
  /// leaves it its volume.
  template <int dim>
  std::vector<Seed<dim>> lattice_seeds(const dealii::Triangulation<dim> &triangulation,
                                       const double cell_size,
                                       const Lattice &lattice,
                                       const PartOfCube<dim> &part_of_cube);

  /// Seeds that fill less than a quarter of a cube, alone in their cells, join the nearest fuller one of the cells that
  /// share a face with theirs, if there is one; that moves towards the common centroid, at most half of its way to a
  /// face of its cell. Those that need not stay and are not beside the ground, which has to feel them. The same on any
  /// number of ranks. Collective.
  /// @param ground null: none
  template <int dim>
  void join_slivers(const dealii::Triangulation<dim> &triangulation,
                    const LevelSet<dim> *ground,
                    std::vector<Seed<dim>> &seeds);

  /// Throws ValueError if the velocity of a seed is no number.
  /// @param velocity null: at rest
  template <int dim>
  void require_velocities(const dealii::Function<dim> *velocity, const std::vector<Seed<dim>> &seeds)
  {
    for (const Seed<dim> &seed : seeds)
      for (unsigned int a = 0; velocity && a < dim; ++a)
        velocity->value(seed.location, a);
  }

  /// Writes a new point's properties, which are 0 before.
  template <int dim>
  using FillProperties = std::function<void(const Seed<dim> &seed, std::vector<double> &properties)>;

  /// Makes points of the seeds. Collective.
  template <int dim>
  void insert_points(PointSet<dim> &points,
                     const std::vector<Seed<dim>> &seeds,
                     const double cell_size,
                     const MPI_Comm communicator,
                     const FillProperties<dim> &fill);
} // namespace scree

#endif
