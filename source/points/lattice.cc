// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/points/lattice.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Scatters the bits of `state` (SplitMix64: Steele, Lea & Flood 2014).
    std::uint64_t scatter(std::uint64_t state)
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
          std::uint64_t hash = scatter(lattice.sequence);
          for (const unsigned int part : seed->cell->id().template to_binary<dim>())
            hash = scatter(hash ^ part);
          hash = scatter(hash ^ (seed - begin));
          for (unsigned int a = 0; a < dim; ++a)
            {
              hash                = scatter(hash);
              const double number = std::ldexp(double(hash >> 11), -52) - 1.; // evenly from -1 to 1
              // Points at the edge of a region may stand anywhere in their cell, and must stay there.
              const double lower = seed->location[a] - seed->cell->vertex(0)[a];
              const double room  = std::min(lower, cell_size - lower);
              seed->location[a] += number * std::min(lattice.jitter * cell_size / lattice.n, 0.98 * room);
            }
        }
    }


    /// Seeds that fill less of a cube are slivers.
    constexpr double least_filled = 0.25;


    /// Gives the seed the volume and moves it to the common centroid.
    template <int dim>
    void take_in(Seed<dim> &seed, const Point<dim> &location, const double volume)
    {
      seed.volume += volume;
      seed.location += volume / seed.volume * (location - seed.location);
    }


    /// A sliver and the seed of another cell that it joins.
    template <int dim>
    struct Joining
    {
      Point<dim> target;   ///< where that seed stands, m
      Point<dim> location; ///< of the sliver, m
      double volume;       ///< m^3

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &target &location &volume;
      }
    };


    template <int dim, typename Visit>
    void for_face_neighbours(const typename Triangulation<dim>::active_cell_iterator &cell, const Visit &visit)
    {
      for (const unsigned int face : cell->face_indices())
        if (!cell->at_boundary(face) && cell->neighbor(face)->is_active())
          visit(cell->neighbor(face));
    }


    template <int dim>
    using CellOf = typename Triangulation<dim>::active_cell_iterator;


    /// The first seed of a cell, among seeds in the order of the cells.
    template <typename Seeds>
    auto first_of(Seeds &seeds, const unsigned int cell)
    {
      return std::partition_point(
          seeds.begin(), seeds.end(), [&](const auto &seed) { return seed.cell->active_cell_index() < cell; });
    }


    /// Where seeds stand that are no slivers, in this rank's cells and the ghosts. Collective.
    template <int dim>
    class FullPlaces
    {
    public:
      FullPlaces(const Triangulation<dim> &triangulation, const std::vector<Seed<dim>> &seeds)
          : seeds(seeds)
      {
        GridTools::exchange_cell_data_to_ghosts<Places, Triangulation<dim>>(
            triangulation,
            [&](const CellOf<dim> &cell) { return std_cxx17::optional<Places>(own_places(cell)); },
            [&](const CellOf<dim> &cell, const Places &places) { of_ghosts[cell->active_cell_index()] = places; });
      }

      /// The one that is nearest to a seed in the cells that share a face with its own, if there is any.
      std::optional<Point<dim>> nearest(const Seed<dim> &seed) const
      {
        std::optional<Point<dim>> result;
        const auto look = [&](const Places &places) {
          for (const Point<dim> &place : places)
            if (!result || place.distance_square(seed.location) < result->distance_square(seed.location))
              result = place;
        };
        for_face_neighbours<dim>(seed.cell, [&](const CellOf<dim> &neighbour) {
          if (neighbour->is_locally_owned())
            look(own_places(neighbour));
          else if (const auto found = of_ghosts.find(neighbour->active_cell_index()); found != of_ghosts.end())
            look(found->second);
        });
        return result;
      }

    private:
      using Places = std::vector<Point<dim>>;

      Places own_places(const CellOf<dim> &cell) const
      {
        Places places;
        const auto end = first_of(seeds, cell->active_cell_index() + 1);
        for (auto seed = first_of(seeds, cell->active_cell_index()); seed != end; ++seed)
          if (seed->filled >= least_filled)
            places.push_back(seed->location);
        return places;
      }

      const std::vector<Seed<dim>> &seeds;
      std::map<unsigned int, Places> of_ghosts; // by active cell
    };


    /// Gives slivers to the seeds that they join, in an order that is the same on any number of ranks.
    template <int dim>
    void take_in(const std::map<CellOf<dim>, Joining<dim>> &joinings, std::vector<Seed<dim>> &seeds)
    {
      std::vector<std::pair<Joining<dim>, Seed<dim> *>> due;
      for (const auto &[cell, joining] : joinings)
        for_face_neighbours<dim>(cell, [&, &joining = joining](const CellOf<dim> &neighbour) {
          const auto end = first_of(seeds, neighbour->active_cell_index() + 1);
          for (auto seed = first_of(seeds, neighbour->active_cell_index()); seed != end; ++seed)
            if (seed->location == joining.target)
              due.emplace_back(joining, &*seed);
        });
      std::sort(due.begin(), due.end(), [](const auto &a, const auto &b) {
        return std::lexicographical_compare(a.first.location.begin_raw(),
                                            a.first.location.end_raw(),
                                            b.first.location.begin_raw(),
                                            b.first.location.end_raw());
      });
      for (const auto &[joining, seed] : due)
        {
          const Point<dim> before = seed->location, lower = seed->cell->vertex(0);
          const Point<dim> upper = seed->cell->vertex(GeometryInfo<dim>::vertices_per_cell - 1);
          take_in(*seed, joining.location, joining.volume);
          for (unsigned int a = 0; a < dim; ++a)
            seed->location[a] = std::clamp(seed->location[a], (before[a] + lower[a]) / 2, (before[a] + upper[a]) / 2);
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
            (part.filled < least_filled * cube ? slivers : seeds)
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
          nearest->filled += sliver.filled;
          nearest->stays |= sliver.stays;
          take_in(*nearest, sliver.location, sliver.volume);
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
  void join_slivers(const Triangulation<dim> &triangulation, const LevelSet<dim> *ground, std::vector<Seed<dim>> &seeds)
  {
    const auto is_beside_ground = [&](const Seed<dim> &seed) {
      const double reach = seed.cell->diameter();
      return ground != nullptr && ground->view(seed.location, reach).distance < reach;
    };
    const FullPlaces<dim> full_places(triangulation, seeds);
    std::map<CellOf<dim>, Joining<dim>> joinings; // by the sliver's cell
    for (Seed<dim> &seed : seeds)
      if (seed.filled < least_filled && !seed.stays && !is_beside_ground(seed))
        if (const auto target = full_places.nearest(seed))
          {
            joinings[seed.cell] = { *target, seed.location, seed.volume };
            seed.volume         = 0;
          }
    GridTools::exchange_cell_data_to_ghosts<Joining<dim>, Triangulation<dim>>(
        triangulation,
        [&](const CellOf<dim> &cell) {
          const auto joining = joinings.find(cell);
          return joining == joinings.end() ? std_cxx17::optional<Joining<dim>>() : joining->second;
        },
        [&](const CellOf<dim> &cell, const Joining<dim> &joining) { joinings[cell] = joining; });
    take_in(joinings, seeds);
    seeds.erase(std::remove_if(seeds.begin(), seeds.end(), [](const Seed<dim> &seed) { return seed.volume == 0; }),
                seeds.end());
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
  template void join_slivers(const Triangulation<2> &, const LevelSet<2> *, std::vector<Seed<2>> &);
  template void join_slivers(const Triangulation<3> &, const LevelSet<3> *, std::vector<Seed<3>> &);
  template void
  insert_points(PointSet<2> &, const std::vector<Seed<2>> &, const double, const MPI_Comm, const FillProperties<2> &);
  template void
  insert_points(PointSet<3> &, const std::vector<Seed<3>> &, const double, const MPI_Comm, const FillProperties<3> &);
} // namespace scree
