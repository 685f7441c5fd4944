// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/seeding/seeding.h>

#include <deal.II/grid/grid_tools.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    GrainsAndPores solve(const UnitWeights &given, const double gravity, const double water_density)
    {
      const double dry = given.dry / gravity, saturated = given.saturated / gravity; // kg/m^3
      double porosity = given.porosity.value_or(0.);
      if (given.dry > 0 && given.saturated > 0)
        porosity = (saturated - dry) / water_density;
      else if (!given.porosity)
        porosity = given.dry > 0 ? 1. - dry / given.grain_density
                                 : (given.grain_density - saturated) / (given.grain_density - water_density);
      const double bulk_density = given.dry > 0 ? dry : saturated - porosity * water_density;
      return { bulk_density / (1. - porosity), porosity };
    }
  } // namespace


  GrainsAndPores
  grains_and_pores(const std::string &body, const UnitWeights &given, const double gravity, const double water_density)
  {
    const std::string entry = given.dry > 0 ? "Dry unit weight" : "Saturated unit weight";
    const double value      = given.dry > 0 ? given.dry : given.saturated;
    const auto require      = [&](const bool possible, const std::string &remedy) {
      require_entry(possible, { body, entry, value }, remedy);
    };
    require(gravity > 0,
            "without gravity nothing has a weight. Change entry \"Gravity\", or write a \"Grain density\".");
    const GrainsAndPores result = solve(given, gravity, water_density);
    const std::string with      = given.dry > 0 && given.saturated > 0
                                      ? "with \"Saturated unit weight\" = " + number_text(given.saturated)
                                  : given.porosity ? "with a porosity of " + number_text(*given.porosity)
                                                   : "with \"Grain density\" = " + number_text(given.grain_density);
    const std::string unit      = " Look at the units: N/m^3 (1 kN/m^3 = 1e3 N/m^3).";
    require(result.porosity >= 0 && result.porosity <= 0.999 && result.grain_density > 0 &&
                std::isfinite(result.grain_density),
            with + " it gives a porosity of " + number_text(result.porosity) + " and grains of " +
                number_text(result.grain_density) + " kg/m^3." + unit);
    constexpr double tolerance = 1e-3;
    require(!given.has_grain_density ||
                std::abs(result.grain_density - given.grain_density) <= tolerance * given.grain_density,
            with + " it gives grains of " + number_text(result.grain_density) + " kg/m^3, and \"Grain density\" = " +
                number_text(given.grain_density) + " contradicts that. Remove one of the entries.");
    require(!given.porosity || std::abs(result.porosity - *given.porosity) <= tolerance,
            with + " it gives a porosity of " + number_text(result.porosity) +
                ", and the porosity of \"Initial porosity\" or of the law, " + number_text(*given.porosity) +
                ", contradicts that. Remove one of the entries.");
    return result;
  }


  namespace
  {
    template <int dim>
    using CellOf = typename Triangulation<dim>::active_cell_iterator;


    /// The order of two places, whatever the rank.
    template <int dim>
    bool is_before(const Point<dim> &a, const Point<dim> &b)
    {
      return std::lexicographical_compare(&a[0], &a[0] + dim, &b[0], &b[0] + dim);
    }


    /// What a seed may be to a sliver beside it, the best last.
    enum class Role : int
    {
      none,     ///< it may not be joined
      largest,  ///< a sliver that fills most of its surroundings
      anchored, ///< a sliver beside a full seed
      full
    };


    /// A seed as other ranks see it.
    template <int dim>
    struct SeedView
    {
      Point<dim> location; ///< m
      double filled;       ///< see Seed
      Role role;

      bool fills_more_than(const SeedView &other) const
      {
        return filled != other.filled ? filled > other.filled : is_before(location, other.location);
      }

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &location &filled &role;
      }
    };


    /// A sliver and the seed of another cell that it joins.
    template <int dim>
    struct Joining
    {
      Point<dim> target;   ///< where that seed stands, m
      Point<dim> location; ///< of the sliver, m
      double volume;       ///< m^3
      double filled;       ///< see Seed

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &target &location &volume &filled;
      }
    };


    /// Visits the cells around one that hold nodes.
    template <int dim, typename Visit>
    void for_cells_around(const CellOf<dim> &cell, const Visit &visit)
    {
      std::vector<CellOf<dim>> around{ cell };
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int i = 0, n = around.size(); i < n; ++i)
          for (const unsigned int face : { 2 * a, 2 * a + 1 })
            if (const CellOf<dim> near = around[i]; !near->at_boundary(face) && near->neighbor(face)->is_active())
              if (const CellOf<dim> next = near->neighbor(face); !next->is_artificial() && holds_nodes(next))
                around.push_back(next);
      for (unsigned int i = 1; i < around.size(); ++i)
        visit(around[i]);
    }


    /// Seeds that fill less than a quarter of a cube, alone in their cells, join others of the cells around theirs
    /// (those that share a face, an edge or a corner), but for those that stay. Beside a fuller seed they join the
    /// nearest one, and take those with them that have no fuller seed but them beside theirs. Elsewhere, as in a sheet
    /// that is thin everywhere, they gather in the one that fills most of its surroundings. A seed that others join
    /// moves towards the common centroid, as far as its cell goes, and no nearer to the ground than both were. So
    /// volume is kept, and a sliver is left only where all that is within a cell of it is one. The same on any number
    /// of ranks.
    template <int dim>
    class Slivers
    {
    public:
      /// @param ground null: none
      Slivers(const Triangulation<dim> &triangulation, const LevelSet<dim> *ground, std::vector<Seed<dim>> &seeds)
          : triangulation(triangulation)
          , ground(ground)
          , seeds(seeds)
      {
      }

      /// Joins all. Collective.
      void join()
      {
        const auto without_full_one = [](const Role own, const Role other) {
          return own < Role::anchored && other > own;
        };
        const auto beside_full_one = [](const Role own, const Role other) {
          return own == Role::anchored && other == Role::full;
        };
        while (join(without_full_one))
          ;
        join(beside_full_one);
      }

    private:
      using Views = std::vector<SeedView<dim>>;

      static bool may_join(const Seed<dim> &seed)
      {
        return seed.is_sliver() && !seed.stays;
      }

      /// The first seed of a cell: they are in the order of the cells.
      auto first_of(const unsigned int cell) const
      {
        return std::partition_point(
            seeds.begin(), seeds.end(), [&](const auto &seed) { return seed.cell->active_cell_index() < cell; });
      }

      /// Takes the views of this rank's cells and the ghosts. Collective.
      void exchange(std::map<unsigned int, Views> own)
      {
        of_cells = std::move(own);
        GridTools::exchange_cell_data_to_ghosts<Views, Triangulation<dim>>(
            triangulation,
            [&](const CellOf<dim> &cell) {
              const auto found = of_cells.find(cell->active_cell_index());
              return found == of_cells.end() ? std::optional<Views>() : found->second;
            },
            [&](const CellOf<dim> &cell, const Views &views) { of_cells[cell->active_cell_index()] = views; });
      }

      template <typename Visit>
      void for_views_around(const CellOf<dim> &cell, const Visit &visit) const
      {
        for_cells_around<dim>(cell, [&](const CellOf<dim> &near) {
          if (const auto found = of_cells.find(near->active_cell_index()); found != of_cells.end())
            for (const SeedView<dim> &view : found->second)
              visit(view);
        });
      }

      void find_roles()
      {
        std::map<unsigned int, Views> own;
        for (const Seed<dim> &seed : seeds)
          if (!seed.is_sliver() || may_join(seed))
            own[seed.cell->active_cell_index()].push_back(
                { seed.location, seed.filled, seed.is_sliver() ? Role::none : Role::full });
        exchange(own);
        for (const Seed<dim> &seed : seeds)
          if (may_join(seed))
            {
              SeedView<dim> &sliver = own[seed.cell->active_cell_index()].front(); // alone in its cell
              sliver.role           = Role::largest;
              for_views_around(seed.cell, [&](const SeedView<dim> &other) {
                if (other.role == Role::full)
                  sliver.role = Role::anchored;
                else if (sliver.role == Role::largest && other.fills_more_than(sliver))
                  sliver.role = Role::none;
              });
            }
        exchange(std::move(own));
      }

      /// Lets slivers join seeds around them if `may(own role, role of the other)`; returns whether any did, on any
      /// rank.
      template <typename May>
      bool join(const May &may)
      {
        find_roles();
        joinings.clear();
        for (Seed<dim> &seed : seeds)
          if (may_join(seed))
            {
              const SeedView<dim> own = of_cells.at(seed.cell->active_cell_index()).front();
              std::optional<SeedView<dim>> best;
              for_views_around(seed.cell, [&](const SeedView<dim> &other) {
                const auto rank = [&](const SeedView<dim> &view) {
                  return std::make_pair(-static_cast<int>(view.role), view.location.distance_square(seed.location));
                };
                if (may(own.role, other.role) && (!best || rank(other) < rank(*best)))
                  best = other;
              });
              if (best)
                joinings[seed.cell] = { best->location, seed.location, seed.volume, seed.filled };
            }
        const bool any = Utilities::MPI::max(joinings.empty() ? 0u : 1u, communicator_of(triangulation)) > 0;
        if (any)
          take_in();
        return any;
      }

      /// Gives slivers to the seeds that they join, in an order that is the same on any number of ranks.
      void take_in()
      {
        seeds.erase(std::remove_if(seeds.begin(),
                                   seeds.end(),
                                   [&](const Seed<dim> &seed) { return joinings.find(seed.cell) != joinings.end(); }),
                    seeds.end());
        GridTools::exchange_cell_data_to_ghosts<Joining<dim>, Triangulation<dim>>(
            triangulation,
            [&](const CellOf<dim> &cell) {
              const auto joining = joinings.find(cell);
              return joining == joinings.end() ? std::optional<Joining<dim>>() : joining->second;
            },
            [&](const CellOf<dim> &cell, const Joining<dim> &joining) { joinings[cell] = joining; });
        std::vector<std::pair<Joining<dim>, Seed<dim> *>> due;
        for (const auto &[cell, joining] : joinings)
          for_cells_around<dim>(cell, [&, &joining = joining](const CellOf<dim> &near) {
            const auto end = first_of(near->active_cell_index() + 1);
            for (auto seed = first_of(near->active_cell_index()); seed != end; ++seed)
              if (seed->location == joining.target)
                due.emplace_back(joining, &*seed);
          });
        std::sort(due.begin(), due.end(), [](const auto &a, const auto &b) {
          return is_before(a.first.location, b.first.location);
        });
        for (const auto &[joining, seed] : due)
          take_in(joining, *seed);
      }

      void take_in(const Joining<dim> &joining, Seed<dim> &seed) const
      {
        constexpr double margin = 0.01; // of a cell
        const double width = seed.cell->extent_in_direction(0), reach = 2. * seed.cell->diameter();
        const auto distance = [&](const Point<dim> &x) { return ground->view(x, reach).distance; };
        const double least  = ground ? std::min(distance(seed.location), distance(joining.location)) : 0.;
        seed.take_in(joining.location, joining.volume, joining.filled);
        if (ground)
          if (const auto view = ground->view(seed.location, reach); view.distance < least)
            seed.location += (least - view.distance) * view.normal;
        for (unsigned int a = 0; a < dim; ++a)
          {
            const double lower = seed.cell->vertex(0)[a];
            seed.location[a]   = std::clamp(seed.location[a], lower + margin * width, lower + (1. - margin) * width);
          }
      }

      const Triangulation<dim> &triangulation;
      const LevelSet<dim> *ground;
      std::vector<Seed<dim>> &seeds;
      std::map<unsigned int, Views> of_cells;       // by active cell, with the ghosts
      std::map<CellOf<dim>, Joining<dim>> joinings; // by the sliver's cell
    };
  } // namespace


  void SeedingParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Region",
                      region,
                      "The body occupies the region where this expression of x, y (z), in m, is true, such as if(x < "
                      "2, y < 2, y < 4 - x). 0: nowhere.");
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
                      "m/s; velocity at the start, one expression per axis, separated by semicolons. Empty: at rest.");
  }


  void SeedingParameters::check(const std::string &body, const unsigned int dim) const
  {
    require_entry(has_expression() || source.is_set() || is_fed,
                  { body, "Region", region },
                  "the body has no region. Write one, for instance x < 1 && y < 1, or the \"Layer\" of a drawing.");
    require_entry(initial_porosity == -1 || initial_porosity >= 0,
                  { body, "Initial porosity", initial_porosity },
                  "write a number from 0 to 0.999, or -1 for what the material law implies.");
    require_entry(source.layer.empty() || !has_expression(),
                  { body, "Layer", source.layer },
                  "\"Region\" says where the body is, too. Keep one of the two.");
    check_expression(dim, entry_name(body, "Region"), region, 1);
    if (!initial_velocity.empty())
      check_expression(dim, entry_name(body, "Initial velocity"), initial_velocity, dim);
  }


  template <int dim>
  void
  require_apart(const std::vector<SoilRegion> &soil, const unsigned int points_per_cell, const Lattice<dim> &lattice)
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
    for (const auto &cell : lattice.triangulation.active_cell_iterators())
      for (unsigned int i = 0;
           cell->is_locally_owned() && holds_nodes(cell) && fault.empty() && i < Utilities::fixed_power<dim>(n);
           ++i)
        {
          Point<dim> x = cell->vertex(0);
          for (unsigned int a = 0, rest = i; a < dim; ++a, rest /= n)
            x[a] += lattice.cell_size / n * (rest % n + places[a]);
          const unsigned int first  = body_at(x, 0);
          const unsigned int second = body_at(x, first + 1);
          if (second < regions.size())
            fault = entry_message({ soil[second].name, soil[second].entry().first, soil[second].entry().second },
                                  "it overlaps that of " + quoted(soil[first].name) + ", " +
                                      soil[first].entry().second + ": both are true at " + number_text(x) +
                                      " m, and would be filled twice. Leave the place to one of them.");
        }
    throw_on_all_ranks(fault, communicator_of(lattice.triangulation));
  }


  namespace
  {
    std::string remedy_for_nothing(const bool has_ground)
    {
      return has_ground ? "the region is empty in the box of subsection Mesh and above the ground of subsection Bed. "
                          "Move the region, the box or the bed."
                        : "the region is empty inside the box of subsection Mesh. Move the region or the box.";
    }


    /// Fills a phase with points that have mass, volume and velocity. Collective; throws EntryError if the velocity is
    /// no number at one of the places.
    /// @param subsection of the entries
    /// @param require gets the seeds before they become points
    template <int dim, typename Phase, typename Entries, typename Require>
    void fill(const Phase &phase,
              PointSet<dim> &points,
              const std::string &subsection,
              const Entries &entries,
              const Lattice<dim> &lattice,
              const PartOfCube<dim> &part_of_cube,
              const Require &require)
    {
      const auto velocity =
          entries.initial_velocity.empty()
              ? nullptr
              : parse_expression<dim>(entry_name(subsection, "Initial velocity"), entries.initial_velocity, dim);
      const MPI_Comm communicator = communicator_of(lattice.triangulation);
      std::vector<Seed<dim>> seeds;
      on_all_ranks(communicator, [&] {
        seeds = lattice_seeds<dim>(lattice.triangulation, lattice.cell_size, entries.points_per_cell, part_of_cube);
        for (const Seed<dim> &one : seeds)
          for (unsigned int a = 0; velocity && a < dim; ++a)
            velocity->value(one.location, a);
      });
      constexpr double least_in_wedge = 0.02; // of a cube: FLIP gives lighter points velocities that no node has
      if (lattice.in_water && lattice.ground)
        for (Seed<dim> &one : seeds)
          if (const double reach = one.cell->diameter(); one.is_sliver() && one.filled >= least_in_wedge)
            one.stays = one.stays || lattice.ground->view(one.location, reach).distance < reach;
      Slivers<dim>(lattice.triangulation, lattice.ground, seeds).join();
      require(seeds);
      insert_points<dim>(
          points, seeds, lattice.cell_size, communicator, [&](const Seed<dim> &one, std::vector<double> &properties) {
            for (unsigned int a = 0; velocity && a < dim; ++a)
              properties[phase.layout.velocity + a] = velocity->value(one.location, a);
            properties[phase.layout.mass]   = phase.density * one.volume;
            properties[phase.layout.volume] = one.volume;
          });
    }
  } // namespace


  template <int dim>
  void seed(SoilBody<dim> &body, const SeedingParameters &parameters, const Lattice<dim> &lattice)
  {
    const Region<dim> region(entry_name(body.name, "Region"), parameters.expression(), parameters.map);
    const auto part_of_cube = [&](const Point<dim> &lower, const double width) -> Seed<dim> {
      const auto [volume, centroid] = region.part_of_cube(lower, width, lattice.ground);
      return { {}, centroid, volume, volume };
    };
    fill<dim>(body, body.points, body.name, parameters, lattice, part_of_cube, [&](const auto &seeds) {
      double volume = 0;
      for (const Seed<dim> &one : seeds)
        volume += one.volume;
      require_entry(Utilities::MPI::sum(volume, communicator_of(lattice.triangulation)) > 0 || parameters.is_fed,
                    { body.name, parameters.place().first, parameters.place().second },
                    remedy_for_nothing(lattice.ground != nullptr));
    });
    for_each_point(body.points, [&](const auto &point) {
      std::fill_n(point.properties + body.layout.left_cauchy_green, 3, 1.);
      std::copy_n(&point.location[0], dim, point.properties + body.layout.start);
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

  template decltype(require_apart<2>) require_apart<2>;
  template decltype(require_apart<3>) require_apart<3>;
  template decltype(seed<2>) seed<2>;
  template decltype(seed<3>) seed<3>;
  template decltype(set_velocity_gradient<2>) set_velocity_gradient<2>;
  template decltype(set_velocity_gradient<3>) set_velocity_gradient<3>;


  template <int dim>
  std::vector<WaterPart<dim>> water_parts(const WaterParameters &parameters, const std::vector<SoilRegion> &soil)
  {
    const std::string where = entry_name("Water", parameters.place().first);
    const bool as_soil      = parameters.is_where_soil_is();
    std::vector<WaterPart<dim>> parts;
    std::string outside = "(" + parameters.region_outside(dim) + ")";
    std::vector<std::shared_ptr<const SourceMap>> layers; // of bodies; maps in space exclude free water
    for (const SoilRegion &body : soil)
      {
        const std::string inside =
            as_soil ? body.region : "(" + parameters.region_in_soil(dim) + ") && (" + body.region + ")";
        parts.push_back({ Region<dim>(where, inside, body.map, parameters.table<dim>()), body.porosity, &body });
        if (body.map)
          layers.push_back(body.map);
        else
          outside += " && (" + body.region + ") == 0";
      }
    if (!parameters.region_outside(dim).empty())
      parts.push_back({ Region<dim>(where, outside, nullptr, nullptr, layers), 1., nullptr });
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
                    remedy_for_nothing(has_ground));
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
                  const Lattice<dim> &lattice)
  {
    if (water.carrier() != nullptr)
      return fill_pores(water);
    const auto parts = water_parts<dim>(parameters, soil);
    std::vector<double> filled(parts.size(), 0.); // of each part, m^3
    const auto part_of_cube = [&](const Point<dim> &lower, const double width) -> Seed<dim> {
      Seed<dim> sum{ {}, lower, 0., 0. };
      Tensor<1, dim> moment; // of the water about the lower corner, m^4
      for (unsigned int i = 0; i < parts.size(); ++i)
        {
          const auto [volume, centroid] = parts[i].region.part_of_cube(lower, width, lattice.ground);
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
    fill<dim>(water, water.points(), "Water", parameters, lattice, part_of_cube, [&](const auto &) {
      Utilities::MPI::sum(filled, communicator_of(lattice.triangulation), filled);
      require_water(parameters, filled, soil.size(), lattice.ground != nullptr);
      for (unsigned int i = 0; i < parts.size(); ++i)
        if (parts[i].soil && filled[i] > 0)
          require_pores(*parts[i].soil);
    });
  }

  template decltype(water_parts<2>) water_parts<2>;
  template decltype(water_parts<3>) water_parts<3>;
  template decltype(seed_water<2>) seed_water<2>;
  template decltype(seed_water<3>) seed_water<3>;
} // namespace scree
