// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/lattice.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Appends the seeds of one cell.
    template <int dim>
    void add_seeds_of_cell(const typename Triangulation<dim>::active_cell_iterator &cell,
                           const double cell_size,
                           const unsigned int n,
                           const PartOfCube<dim> &part_of_cube,
                           std::vector<Seed<dim>> &seeds)
    {
      const double width      = cell_size / n;
      const std::size_t first = seeds.size();
      const double cube       = Utilities::fixed_power<dim>(width);
      std::vector<Seed<dim>> slivers;
      for (unsigned int i = 0; i < Utilities::fixed_power<dim>(n); ++i)
        {
          Point<dim> corner = cell->vertex(0);
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
            corner[a] += width * (rest % n);
          const CubePart<dim> part = part_of_cube(corner, width);
          if (part.volume > 0)
            (part.filled < Seed<dim>::least_filled * cube ? slivers : seeds)
                .push_back({ cell, part.location, part.volume, part.filled / cube, part.stays });
        }
      for (const Seed<dim> &sliver : slivers)
        {
          const auto nearest = std::min_element(seeds.begin() + first, seeds.end(), [&](const auto &a, const auto &b) {
            return a.location.distance_square(sliver.location) < b.location.distance_square(sliver.location);
          });
          if (nearest == seeds.end())
            {
              seeds.push_back(sliver);
              continue;
            }
          nearest->stays |= sliver.stays;
          nearest->take_in(sliver.location, sliver.volume, sliver.filled);
        }
    }
  } // namespace


  template <int dim>
  std::vector<Seed<dim>> lattice_seeds(const Triangulation<dim> &triangulation,
                                       const double cell_size,
                                       const unsigned int n,
                                       const PartOfCube<dim> &part_of_cube)
  {
    std::vector<Seed<dim>> seeds;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && holds_nodes(cell))
        add_seeds_of_cell(cell, cell_size, n, part_of_cube, seeds);
    return seeds;
  }


  template <int dim>
  void insert_points(PointSet<dim> &points,
                     const std::vector<Seed<dim>> &seeds,
                     const double cell_size,
                     const MPI_Comm communicator,
                     const FillProperties<dim> &fill)
  {
    auto &handler  = points.handler();
    const auto ids = Utilities::MPI::create_ascending_partitioning(
        communicator, seeds.size())[Utilities::MPI::this_mpi_process(communicator)];
    auto id = ids.begin();

    handler.reserve(seeds.size());
    std::vector<double> properties(points.stride());
    for (const Seed<dim> &seed : seeds)
      {
        std::fill(properties.begin(), properties.end(), 0.);
        fill(seed, properties);
        const Point<dim> reference((seed.location - seed.cell->vertex(0)) / cell_size);
        handler.insert_particle(seed.location, reference, *id++, seed.cell, properties);
      }
    handler.update_cached_numbers();
    points.sort(); // brings the points of a cell together in memory
    points.next_id += Utilities::MPI::sum(static_cast<types::particle_index>(seeds.size()), communicator);
  }

  template std::vector<Seed<2>>
  lattice_seeds(const Triangulation<2> &, const double, const unsigned int, const PartOfCube<2> &);
  template std::vector<Seed<3>>
  lattice_seeds(const Triangulation<3> &, const double, const unsigned int, const PartOfCube<3> &);
  template void
  insert_points(PointSet<2> &, const std::vector<Seed<2>> &, const double, const MPI_Comm, const FillProperties<2> &);
  template void
  insert_points(PointSet<3> &, const std::vector<Seed<3>> &, const double, const MPI_Comm, const FillProperties<3> &);
} // namespace scree
