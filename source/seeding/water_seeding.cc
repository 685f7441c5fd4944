// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/deal_ii_versions.h>
#include <scree/input/expression.h>
#include <scree/input/input_error.h>
#include <scree/seeding/seeding.h>
#include <scree/seeding/water_seeding.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  std::vector<WaterPart<dim>> water_parts(const WaterParameters &parameters, const std::vector<SoilRegion> &soil)
  {
    const std::string where = entry_name("Water", parameters.place().first);
    const bool as_soil      = parameters.is_where_soil_is();
    std::vector<WaterPart<dim>> parts;
    std::string outside = "(" + parameters.region_outside(dim) + ")";
    for (const SoilRegion &body : soil)
      {
        const std::string inside =
            as_soil ? body.region : "(" + parameters.region_in_soil(dim) + ") && (" + body.region + ")";
        parts.push_back({ Region<dim>(where, inside, body.map, parameters.table<dim>()), body.porosity, &body });
        outside += " && (" + body.region + ") == 0";
      }
    if (!parameters.region_outside(dim).empty())
      parts.push_back({ Region<dim>(where, outside), 1., nullptr });
    return parts;
  }


  void require_pores(const SoilRegion &soil)
  {
    require_entry(soil.porosity > 0,
                  { soil.name, "Initial porosity", soil.porosity },
                  "the body lies in the water and needs pores. Write a number above 0, or move the region of "
                  "subsection Water.");
  }


  namespace
  {
    /// Throws EntryError if the water's region holds no volume, or a phreatic surface none in soil.
    /// @param filled volumes of the parts, m^3; those in the `n_bodies` bodies come first
    void require_water(const WaterParameters &parameters,
                       const std::vector<double> &filled,
                       const std::size_t n_bodies,
                       const bool has_ground)
    {
      const auto [entry, value] = parameters.place();
      require_entry(entry.rfind("Phreatic", 0) != 0 ||
                        std::any_of(filled.begin(), filled.begin() + n_bodies, [](const double v) { return v > 0; }),
                    { "Water", entry, value },
                    "there is no soil below it. Write a higher elevation, or a \"Reservoir level\" alone.");
      require_entry(parameters.is_fed ||
                        std::any_of(filled.begin(), filled.end(), [](const double volume) { return volume > 0; }),
                    { "Water", entry, value },
                    has_ground ? "the region is empty in the box of subsection Mesh and above the ground of subsection "
                                 "Bed. Move the region, the box or the bed."
                               : "the region is empty inside the box of subsection Mesh. Move the region or the box.");
    }


    template <int dim>
    void seed_own_points(WaterPhase<dim> &water,
                         const WaterParameters &parameters,
                         const std::vector<SoilRegion> &soil,
                         const Triangulation<dim> &triangulation,
                         const double cell_size,
                         const LevelSet<dim> *ground)
    {
      const auto parts = water_parts<dim>(parameters, soil);
      const auto velocity =
          parameters.initial_velocity.empty()
              ? nullptr
              : parse_expression<dim>(entry_name("Water", "Initial velocity"), parameters.initial_velocity, dim);

      std::vector<double> filled(parts.size(), 0.); // of each part, m^3
      const auto part_of_cube = [&](const Point<dim> &lower, const double width) -> CubePart<dim> {
        CubePart<dim> sum{ 0., 0., lower };
        Tensor<1, dim> moment; // of the water about the lower corner, m^4
        for (unsigned int i = 0; i < parts.size(); ++i)
          {
            const auto [volume, centroid] = parts[i].region.part_of_cube(lower, width, ground);
            filled[i] += volume;
            sum.filled += volume;
            sum.stays |= volume > 0 && parts[i].soil == nullptr;
            sum.volume += parts[i].porosity * volume;
            moment += parts[i].porosity * volume * (centroid - lower);
          }
        if (sum.volume > 0)
          sum.location = lower + moment / sum.volume;
        return sum;
      };
      const MPI_Comm communicator = communicator_of(triangulation);
      std::vector<Seed<dim>> seeds;
      on_all_ranks(communicator, [&] {
        seeds = lattice_seeds<dim>(triangulation, cell_size, parameters.points_per_cell, part_of_cube);
        require_velocities(velocity.get(), seeds);
      });
      keep_slivers_at(ground, seeds);
      join_slivers(triangulation, ground, seeds);

      Utilities::MPI::sum(filled, communicator, filled);
      require_water(parameters, filled, soil.size(), ground != nullptr);
      for (unsigned int i = 0; i < parts.size(); ++i)
        if (parts[i].soil && filled[i] > 0)
          require_pores(*parts[i].soil);

      const auto &layout = water.layout;
      insert_points<dim>(
          water.points(), seeds, cell_size, communicator, [&](const Seed<dim> &one, std::vector<double> &properties) {
            if (velocity)
              for (unsigned int a = 0; a < dim; ++a)
                properties[layout.velocity + a] = velocity->value(one.location, a);
            properties[layout.mass]   = water.density * one.volume;
            properties[layout.volume] = one.volume;
          });
    }


    template <int dim>
    void fill_pores(WaterPhase<dim> &water)
    {
      const SoilBody<dim> &soil = *water.carrier();
      for_each_point(water.points(), [&](const auto &point) {
        double *properties              = point.properties;
        const double volume             = soil.pore_volume(properties);
        properties[water.layout.volume] = volume;
        properties[water.layout.mass]   = water.density * volume;
        std::copy_n(properties + soil.layout.velocity, dim, properties + water.layout.velocity);
      });
    }
  } // namespace


  template <int dim>
  void seed_water(WaterPhase<dim> &water,
                  const WaterParameters &parameters,
                  const std::vector<SoilRegion> &soil,
                  const Triangulation<dim> &triangulation,
                  const double cell_size,
                  const LevelSet<dim> *ground)
  {
    if (water.carrier() != nullptr)
      fill_pores(water);
    else
      seed_own_points(water, parameters, soil, triangulation, cell_size, ground);
  }

  template decltype(water_parts<2>) water_parts<2>;
  template decltype(water_parts<3>) water_parts<3>;
  template decltype(seed_water<2>) seed_water<2>;
  template decltype(seed_water<3>) seed_water<3>;
} // namespace scree
