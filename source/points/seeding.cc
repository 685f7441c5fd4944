// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/points/seeding.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    struct Seed
    {
      Point<dim> location;
      double volume;
    };

    /// The seeds of one cell. Cubes filled by less than a quarter join the nearest fuller one of the cell.
    template <int dim>
    std::vector<Seed<dim>>
    seeds_of_cell(const Region<dim> &region, const Point<dim> &lower, const double cell_size, const unsigned int n)
    {
      const double width = cell_size / n;
      std::vector<Seed<dim>> full, slivers;
      for (unsigned int i = 0; i < Utilities::fixed_power<dim>(n); ++i)
        {
          Point<dim> corner = lower;
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
            corner[a] += width * (rest % n);
          const auto [volume, centroid] = region.part_of_cube(corner, width);
          if (volume > 0)
            (volume < 0.25 * Utilities::fixed_power<dim>(width) ? slivers : full).push_back({ centroid, volume });
        }
      for (const Seed<dim> &sliver : slivers)
        {
          const auto nearest = std::min_element(full.begin(), full.end(), [&](const auto &a, const auto &b) {
            return a.location.distance_square(sliver.location) < b.location.distance_square(sliver.location);
          });
          if (nearest == full.end())
            {
              full.push_back(sliver);
              continue;
            }
          const double sum = nearest->volume + sliver.volume;
          nearest->location += sliver.volume / sum * (sliver.location - nearest->location);
          nearest->volume = sum;
        }
      return full;
    }
  } // namespace


  void SeedingParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Region",
                      region,
                      "Where the body is: inside where this expression of x, y (and z), in m, is true, e.g. "
                      "if(x < 2, y < 2, y < 4 - x).",
                      Patterns::Anything());
    prm.add_parameter(
        "Points per cell", points_per_cell, "Points along each axis of a cell.", Patterns::Integer(1, 32));
    prm.add_parameter("Grain density", grain_density, "Density of the grains, kg/m^3.", Patterns::Double(1e-12));
    prm.add_parameter(
        "Initial porosity",
        initial_porosity,
        "Volume of pores over total volume; -1: as the material law implies (Nor-Sand: 1 - 1/v_0; else 0). "
        "The bulk density is grain density times (1 - porosity).",
        Patterns::Double(-1, 0.999));
    prm.add_parameter("Initial velocity",
                      initial_velocity,
                      "Velocity at the start, m/s: an expression an axis, separated by semicolons; empty: at rest.",
                      Patterns::Anything());
  }


  void SeedingParameters::check(const std::string &body, const unsigned int dim) const
  {
    const std::string where_region = entry_name(body, "Region");
    const std::string where_speed  = entry_name(body, "Initial velocity");
    require_entry(region != SeedingParameters().region,
                  body,
                  "Region",
                  region,
                  "the body is nowhere. Write where it is, for instance x < 1 && y < 1");
    require_entry(initial_porosity == -1 || initial_porosity >= 0,
                  body,
                  "Initial porosity",
                  initial_porosity,
                  "write a number from 0 to 0.999, or -1 for what the material law implies.");
    if (dim == 2)
      {
        Region<2>(where_region, region);
        if (!initial_velocity.empty())
          parse_expression<2>(where_speed, initial_velocity, 2);
      }
    else
      {
        Region<3>(where_region, region);
        if (!initial_velocity.empty())
          parse_expression<3>(where_speed, initial_velocity, 3);
      }
  }


  template <int dim>
  void seed(Phase<dim> &phase,
            const SeedingParameters &parameters,
            const Triangulation<dim> &triangulation,
            const double cell_size)
  {
    const Region<dim> region(entry_name(phase.name, "Region"), parameters.region);
    const auto velocity =
        parameters.initial_velocity.empty()
            ? nullptr
            : parse_expression<dim>(entry_name(phase.name, "Initial velocity"), parameters.initial_velocity, dim);

    using Cell = typename Triangulation<dim>::active_cell_iterator;
    std::vector<std::pair<Cell, Seed<dim>>> seeds;
    double volume = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &one : seeds_of_cell(region, cell->vertex(0), cell_size, parameters.points_per_cell))
          {
            seeds.emplace_back(cell, one);
            volume += one.volume;
          }

    const MPI_Comm communicator = triangulation.get_communicator();
    require_entry(Utilities::MPI::sum(volume, communicator) > 0,
                  phase.name,
                  "Region",
                  parameters.region,
                  "it is nowhere true inside the box of subsection Mesh. Move the region or the box.");

    const auto ids = Utilities::MPI::create_ascending_partitioning(
        communicator, seeds.size())[Utilities::MPI::this_mpi_process(communicator)];
    auto id = ids.begin();

    auto &handler = phase.points.handler();
    handler.reserve(seeds.size());
    std::vector<double> properties(phase.layout.n_properties);
    for (const auto &[cell, one] : seeds)
      {
        std::fill(properties.begin(), properties.end(), 0.);
        if (velocity)
          for (unsigned int a = 0; a < dim; ++a)
            properties[phase.layout.velocity + a] = velocity->value(one.location, a);
        properties[phase.layout.mass]   = phase.density * one.volume;
        properties[phase.layout.volume] = one.volume;
        for (unsigned int a = 0; a < 3; ++a)
          properties[phase.layout.left_cauchy_green + a] = 1.;
        const Point<dim> reference((one.location - cell->vertex(0)) / cell_size);
        handler.insert_particle(one.location, reference, *id++, cell, properties);
      }
    handler.update_cached_numbers();
    phase.points.sort(); // brings the points of a cell together in memory
  }

  template void seed(Phase<2> &, const SeedingParameters &, const Triangulation<2> &, const double);
  template void seed(Phase<3> &, const SeedingParameters &, const Triangulation<3> &, const double);
} // namespace scree
