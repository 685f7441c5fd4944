// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/deal_ii_versions.h>
#include <scree/input/expression.h>
#include <scree/input/input_error.h>
#include <scree/seeding/seeding.h>
#include <scree/seeding/slivers.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  void SeedingParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Region",
                      region,
                      "The body occupies the region where this expression of x, y (z), in m, is true, such as if(x < "
                      "2, y < 2, y < 4 - x). 0: nowhere.",
                      Patterns::Anything());
    source.add_parameters(prm);
    prm.add_parameter(
        "Points per cell", points_per_cell, "Points along each axis of a cell.", Patterns::Integer(1, 32));
    prm.add_parameter("Grain density",
                      grain_density,
                      "kg/m^3; density of the grains. The bulk density is this value times (1 - porosity).",
                      Patterns::Double(1e-12));
    prm.add_parameter(
        "Initial porosity",
        initial_porosity,
        "Pore volume over total volume; -1: the value of the material law (Nor-Sand: 1 - 1/v_0; others: 0).",
        Patterns::Double(-1, 0.999));
    prm.add_parameter(
        "Dry unit weight",
        dry_unit_weight,
        "N/m^3; unit weight of the dry soil. With \"Saturated unit weight\" it gives grain density and "
        "porosity; alone it gives the porosity, or the grain density if the porosity is given. 0: not given.",
        Patterns::Double(0));
    prm.add_parameter(
        "Saturated unit weight",
        saturated_unit_weight,
        "N/m^3; unit weight of the soil with pores full of water; used as \"Dry unit weight\". 0: not given.",
        Patterns::Double(0));
    prm.add_parameter("Initial velocity",
                      initial_velocity,
                      "m/s; velocity at the start, one expression per axis, separated by semicolons. Empty: at rest.",
                      Patterns::Anything());
  }


  void SeedingParameters::check(const std::string &body, const unsigned int dim) const
  {
    const std::string where_region = entry_name(body, "Region");
    const std::string where_speed  = entry_name(body, "Initial velocity");
    require_entry(region != SeedingParameters().region || source.is_region() || is_fed,
                  body,
                  "Region",
                  region,
                  "the body has no region. Write one, for instance x < 1 && y < 1");
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


  std::string SeedingParameters::expression() const
  {
    return region == SeedingParameters().region && source.is_region() ? "1" : region;
  }


  std::pair<std::string, std::string> SeedingParameters::place() const
  {
    return source.is_region() ? source.first() : std::make_pair(std::string("Region"), region);
  }


  template <int dim>
  void require_apart(const std::vector<SoilRegion> &soil,
                     const unsigned int points_per_cell,
                     const Triangulation<dim> &triangulation,
                     const double cell_size)
  {
    std::vector<Region<dim>> regions;
    for (const SoilRegion &body : soil)
      regions.push_back(body.places<dim>());
    const auto body_at = [&](const Point<dim> &x, const unsigned int first) {
      unsigned int body = first;
      while (body < regions.size() && !regions[body].contains(x))
        ++body;
      return body;
    };
    // Not in the middle: regions that meet share a face, and faces go through the middles of cubes or along diagonals.
    constexpr double places[3] = { 0.37, 0.41, 0.34 };
    const unsigned int n       = 2 * points_per_cell;
    std::string fault;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (unsigned int i = 0;
           cell->is_locally_owned() && holds_nodes(cell) && fault.empty() && i < Utilities::fixed_power<dim>(n);
           ++i)
        {
          Point<dim> x = cell->vertex(0);
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
            x[a] += cell_size / n * (rest % n + places[a]);
          const unsigned int first  = body_at(x, 0);
          const unsigned int second = body_at(x, first + 1);
          if (second < regions.size())
            fault = entry_message(soil[second].name,
                                  soil[second].entry().first,
                                  soil[second].entry().second,
                                  "it overlaps that of " + quoted(soil[first].name) + ", " +
                                      soil[first].entry().second + ": both are true at " + number_text(x) +
                                      " m, and would be filled twice. Leave the place to one of them.");
        }
    throw_on_all_ranks(fault, communicator_of(triangulation));
  }


  template <int dim>
  void seed(SoilBody<dim> &body,
            const SeedingParameters &parameters,
            const Triangulation<dim> &triangulation,
            const double cell_size,
            const LevelSet<dim> *ground,
            const bool in_water)
  {
    const Region<dim> region(entry_name(body.name, "Region"), parameters.expression(), parameters.map);
    const auto velocity =
        parameters.initial_velocity.empty()
            ? nullptr
            : parse_expression<dim>(entry_name(body.name, "Initial velocity"), parameters.initial_velocity, dim);

    const MPI_Comm communicator = communicator_of(triangulation);
    std::vector<Seed<dim>> seeds;
    on_all_ranks(communicator, [&] {
      seeds = lattice_seeds<dim>(triangulation,
                                 cell_size,
                                 parameters.points_per_cell,
                                 [&](const Point<dim> &lower, const double width) -> CubePart<dim> {
                                   const auto [volume, centroid] = region.part_of_cube(lower, width, ground);
                                   return { volume, volume, centroid };
                                 });
      require_velocities(velocity.get(), seeds);
    });
    if (in_water)
      keep_slivers_at(ground, seeds);
    join_slivers(triangulation, ground, seeds);
    double volume = 0;
    for (const Seed<dim> &one : seeds)
      volume += one.volume;
    require_entry(Utilities::MPI::sum(volume, communicator) > 0 || parameters.is_fed,
                  body.name,
                  parameters.place().first,
                  parameters.place().second,
                  ground ? "the region is empty in the box of subsection Mesh and above the ground of subsection Bed. "
                           "Move the region, the box or the bed."
                         : "the region is empty inside the box of subsection Mesh. Move the region or the box.");

    const auto &layout = body.layout;
    insert_points<dim>(
        body.points, seeds, cell_size, communicator, [&](const Seed<dim> &one, std::vector<double> &properties) {
          if (velocity)
            for (unsigned int a = 0; a < dim; ++a)
              properties[layout.velocity + a] = velocity->value(one.location, a);
          properties[layout.mass]   = body.density * one.volume;
          properties[layout.volume] = one.volume;
          for (unsigned int a = 0; a < 3; ++a)
            properties[layout.left_cauchy_green + a] = 1.;
        });
  }

  template <int dim>
  void set_velocity_gradient(PointSet<dim> &points,
                             const std::string &expressions,
                             const unsigned int slot,
                             const double width)
  {
    const auto expression = parse_expression<dim>("", expressions, dim);
    // Beside the body it need not be a number.
    const auto velocity = [&](const Point<dim> &x, const unsigned int c) {
      return expression->FunctionParser<dim>::value(x, c);
    };
    for_each_point(points, [&](const auto &point) {
      for (unsigned int a = 0; a < dim; ++a)
        {
          Point<dim> ahead = point.location, behind = point.location;
          ahead[a] += 0.5 * width;
          behind[a] -= 0.5 * width;
          for (unsigned int c = 0; c < dim; ++c)
            {
              const double slope                   = (velocity(ahead, c) - velocity(behind, c)) / width;
              point.properties[slot + c * dim + a] = std::isfinite(slope) ? slope : 0.;
            }
        }
    });
  }

  template void
  require_apart(const std::vector<SoilRegion> &, const unsigned int, const Triangulation<2> &, const double);
  template void
  require_apart(const std::vector<SoilRegion> &, const unsigned int, const Triangulation<3> &, const double);
  template void seed(SoilBody<2> &,
                     const SeedingParameters &,
                     const Triangulation<2> &,
                     const double,
                     const LevelSet<2> *,
                     const bool);
  template void seed(SoilBody<3> &,
                     const SeedingParameters &,
                     const Triangulation<3> &,
                     const double,
                     const LevelSet<3> *,
                     const bool);
  template void set_velocity_gradient(PointSet<2> &, const std::string &, const unsigned int, const double);
  template void set_velocity_gradient(PointSet<3> &, const std::string &, const unsigned int, const double);
} // namespace scree
