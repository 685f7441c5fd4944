// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/lattice.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Mixes the bits of `state` (SplitMix64: Steele, Lea & Flood 2014).
    std::uint64_t mix_bits(std::uint64_t state)
    {
      state += 0x9e3779b97f4a7c15;
      state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9;
      state = (state ^ (state >> 27)) * 0x94d049bb133111eb;
      return state ^ (state >> 31);
    }


    /// Moves the seeds of one cell. The numbers follow from the cell's place in the mesh and the seed's in the cell: a
    /// generator's sequence would depend on which rank owns which cells.
    template <int dim>
    void jitter_seeds(const typename std::vector<Seed<dim>>::iterator begin,
                      const typename std::vector<Seed<dim>>::iterator end,
                      const double cell_size,
                      const Lattice &lattice)
    {
      for (auto seed = begin; seed != end; ++seed)
        {
          std::uint64_t hash = mix_bits(lattice.sequence);
          for (const unsigned int part : seed->cell->id().template to_binary<dim>())
            hash = mix_bits(hash ^ part);
          hash = mix_bits(hash ^ (seed - begin));
          for (unsigned int a = 0; a < dim; ++a)
            {
              hash                = mix_bits(hash);
              const double number = std::ldexp(double(hash >> 11), -52) - 1.; // evenly from -1 to 1
              // Points at the edge of a region may stand anywhere in their cell, and must stay there.
              const double lower = seed->location[a] - seed->cell->vertex(0)[a];
              const double room  = std::min(lower, cell_size - lower);
              seed->location[a] += number * std::min(lattice.jitter * cell_size / lattice.n, 0.98 * room);
            }
        }
    }


    /// Appends the seeds of one cell.
    template <int dim>
    void add_seeds_of_cell(const typename Triangulation<dim>::active_cell_iterator &cell,
                           const double cell_size,
                           const Lattice &lattice,
                           const PartOfCube<dim> &part_of_cube,
                           std::vector<Seed<dim>> &seeds)
    {
      const unsigned int n    = lattice.n;
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
      if (lattice.jitter > 0)
        jitter_seeds<dim>(seeds.begin() + first, seeds.end(), cell_size, lattice);
    }
  } // namespace


  template <int dim>
  std::vector<Seed<dim>> lattice_seeds(const Triangulation<dim> &triangulation,
                                       const double cell_size,
                                       const Lattice &lattice,
                                       const PartOfCube<dim> &part_of_cube)
  {
    std::vector<Seed<dim>> seeds;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && holds_nodes(cell))
        add_seeds_of_cell(cell, cell_size, lattice, part_of_cube, seeds);
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
  lattice_seeds(const Triangulation<2> &, const double, const Lattice &, const PartOfCube<2> &);
  template std::vector<Seed<3>>
  lattice_seeds(const Triangulation<3> &, const double, const Lattice &, const PartOfCube<3> &);
  template void
  insert_points(PointSet<2> &, const std::vector<Seed<2>> &, const double, const MPI_Comm, const FillProperties<2> &);
  template void
  insert_points(PointSet<3> &, const std::vector<Seed<3>> &, const double, const MPI_Comm, const FillProperties<3> &);
} // namespace scree
