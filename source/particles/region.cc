// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/open_part.h>
#include <scree/particles/region.h>

#include <deal.II/base/geometry_info.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// The place `index` of a lattice of n^dim places in a cube, the outer ones `inset` widths inside it.
    template <int dim>
    Point<dim> sample(const Point<dim> &lower,
                      const double width,
                      const unsigned int index,
                      const unsigned int n,
                      const double inset)
    {
      Point<dim> x;
      for (unsigned int a = 0, rest = index; a < dim; ++a, rest /= n)
        x[a] = lower[a] + width * (inset + (1. - 2. * inset) * (rest % n) / (n - 1.));
      return x;
    }
  } // namespace


  namespace
  {
    /// The part of simplices in which a condition holds; where it begins on an edge is found by halving it.
    template <int dim, typename Condition>
    std::vector<Simplex<dim>> part_where(std::vector<Simplex<dim>> simplices, const Condition &holds)
    {
      for (Simplex<dim> &simplex : simplices)
        for (SimplexCorner<dim> &corner : simplex)
          corner.side = holds(corner.place) ? 1. : -1.;
      return open_part<dim>(std::move(simplices),
                            [&](const SimplexCorner<dim> &inside, const SimplexCorner<dim> &outside) {
                              constexpr unsigned int n_halvings = 40;
                              Point<dim> in = inside.place, out = outside.place;
                              for (unsigned int i = 0; i < n_halvings; ++i)
                                {
                                  const Point<dim> middle    = in + 0.5 * (out - in);
                                  (holds(middle) ? in : out) = middle;
                                }
                              return in;
                            });
    }
  } // namespace


  template <int dim>
  Point<dim> Region<dim>::corner(const Point<dim> &lower, const double width, const unsigned int vertex)
  {
    return sample(lower, width, vertex, 2, 1e-6);
  }


  template <int dim>
  bool Region<dim>::touches_cube(const Point<dim> &lower, const double width) const
  {
    for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_cell; ++v)
      if (contains(corner(lower, width, v)))
        return true;
    return contains(middle(lower, width)) || (map && map->is_layer() && part_by_lines(lower, width).first > 0.);
  }


  template <int dim>
  std::pair<double, Point<dim>> Region<dim>::part_by_lines(const Point<dim> &lower, const double width) const
  {
    constexpr unsigned int n = 6, n_parts = 4; // lines along an axis; parts of each, where the expression is asked
    constexpr double least = 1e-9;             // of the width: what rounding leaves
    double length          = 0.;
    Tensor<1, dim> moment;
    if constexpr (dim == 3)
      for (unsigned int i = 0; i < n * n; ++i)
        {
          const double x = lower[0] + width * (i % n + 0.5) / n, y = lower[1] + width * (i / n + 0.5) / n;
          const auto [bottom, top] = map->part_of_line(x, y, lower[2], lower[2] + width);
          const double part        = (top - bottom) / n_parts;
          for (unsigned int k = 0; k < n_parts && part > least * width; ++k)
            if (const Point<dim> place(x, y, bottom + part * (k + 0.5)); holds(place))
              {
                length += part;
                moment += part * (place - lower);
              }
        }
    return { length * width * width / (n * n),
             length > 0. ? Point<dim>(lower + moment / length) : middle(lower, width) };
  }


  template <int dim>
  std::pair<double, Point<dim>>
  Region<dim>::part_of_cube(const Point<dim> &lower, const double width, const LevelSet<dim> *ground) const
  {
    const auto is_open  = [&](const Point<dim> &x) { return ground == nullptr || ground->is_open(x); };
    const auto contains = [&](const Point<dim> &x) { return Region::contains(x) && is_open(x); };
    // Most cubes lie inside or outside with all corners.
    constexpr unsigned int n_vertices = 1 << dim;
    unsigned int in_region = 0, in_open = 0, in_both = 0;
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        const Point<dim> x = corner(lower, width, v);
        const bool region = Region::contains(x), open = is_open(x);
        in_region += region;
        in_open += open;
        in_both += region && open;
      }
    const Point<dim> middle = Region::middle(lower, width);
    const double volume     = Utilities::fixed_power<dim>(width);
    if (in_both == n_vertices && contains(middle))
      return { volume, middle };
    if (map && map->is_layer())
      return part_by_lines(lower, width);
    if (ground != nullptr && in_region + in_open < 2 * n_vertices && in_region > 0 && in_open > 0)
      {
        auto simplices =
            part_where(simplices_of_cube(lower, width), [&](const Point<dim> &x) { return Region::contains(x); });
        const auto part        = volume_and_centroid(part_where(std::move(simplices), is_open));
        constexpr double least = 1e-9; // of the cube: what rounding leaves
        return part.first > least * volume ? part : std::make_pair(0., middle);
      }
    if (in_both == 0 && !contains(middle))
      return { 0., middle };

    constexpr unsigned int n         = dim == 2 ? 32 : 12;
    constexpr unsigned int n_samples = Utilities::pow(n, dim);
    unsigned int n_inside            = 0;
    Tensor<1, dim> sum;
    for (unsigned int i = 0; i < n_samples; ++i)
      if (const auto x = sample(lower, width, i, n, 0.5 / n); contains(x))
        {
          ++n_inside;
          sum += x - lower;
        }
    if (n_inside == 0)
      return { 0., middle };
    return { volume * n_inside / n_samples, lower + sum / n_inside };
  }

  template class Region<2>;
  template class Region<3>;


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
          Seed<dim> seed = part_of_cube(corner, width);
          seed.cell      = cell;
          if (seed.volume > 0)
            {
              auto &list = seed.filled < Seed<dim>::least_filled * cube ? slivers : seeds;
              seed.filled /= cube;
              list.push_back(seed);
            }
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

  template decltype(lattice_seeds<2>) lattice_seeds<2>;
  template decltype(lattice_seeds<3>) lattice_seeds<3>;
  template decltype(insert_points<2>) insert_points<2>;
  template decltype(insert_points<3>) insert_points<3>;
} // namespace scree
