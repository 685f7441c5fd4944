// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/case/case_checks.h>
#include <scree/seeding/seeding.h>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Values of an entry that soil, water and loads have, in the unit of the entry.
    struct UsualRange
    {
      double lowest, highest;
      std::string unit; ///< and what others are in it
    };


    /// By the names of entries, which mean the same in all subsections.
    /// @param stress smallest that matters in the scene, Pa
    std::map<std::string, UsualRange> usual_ranges(const double stress)
    {
      const std::string degrees = "degrees (1 rad = 57.3 degrees)", pascal = "Pa (1 kPa = 1e3 Pa, 1 MPa = 1e6 Pa)",
                        density = "kg/m^3 (1 g/cm^3 = 1e3 kg/m^3, 1 kN/m^3 = 102 kg/m^3)",
                        weight = "N/m^3 (1 kN/m^3 = 1e3 N/m^3)", metre = "m (1 mm = 1e-3 m)",
                        speed = "m/s (1 m/d = 1.16e-5 m/s, 1 mm/h = 2.78e-7 m/s)";
      const UsualRange angle{ 1.6, 70., degrees }, dilation{ 0.7, 45., degrees }, strength{ stress, 1e9, pascal },
          modulus{ 5e3, 1e12, pascal }, unit_weight{ 5e3, 5e4, weight }, grain{ 1e-7, 3., metre };
      return { { "Friction angle", angle },
               { "Residual friction angle", angle },
               { "Dilation angle", dilation },
               { "Residual dilation angle", dilation },
               { "Cohesion", strength },
               { "Residual cohesion", strength },
               { "Tension cut-off", strength },
               { "Undrained strength", strength },
               { "Yield stress", { 0.05 * stress, 1e9, pascal } }, // mud of the laboratory
               { "Traction", { 0.05 * stress, 1e9, pascal } },
               { "Pressure", { 0.05 * stress, 1e9, pascal } },
               { "Air entry pressure", { 50., 1e7, pascal } },
               { "Young's modulus", modulus },
               { "Shear modulus", modulus },
               { "Bulk modulus", { 1e4, 1e11, pascal } },
               { "Consistency", { 1e-3, 1e6, "Pa s^n" } },
               { "Viscosity", { 1e-4, 1e5, "Pa s (1 mPa s = 1e-3 Pa s)" } },
               { "Grain density", { 900., 8e3, density } },
               { "Density", { 500., 2e3, density } },
               { "Dry unit weight", unit_weight },
               { "Saturated unit weight", unit_weight },
               { "Grain diameter", grain },
               { "Nonlocal length", { 1e-4, 50., metre } },
               { "Reference rate", { 1e-10, 10., "1/s (1 %/h = 2.8e-6 1/s)" } },
               { "Turbulent friction", { 50., 1e5, "m/s^2" } },
               { "Hydraulic conductivity", { 1e-13, 1., speed } },
               { "Rate", { 1e-10, 0.1, speed } },
               { "Gravity", { 0.05, 5e3, "m/s^2 (1 g = 9.81 m/s^2)" } } };
    }


    /// The value of an entry: of a vector its size, of expressions the largest one at the middle of the
    /// box, over the time or over the depths that it has; NaN of
    /// other texts.
    template <int dim>
    double largest_value(const Parameters &parameters, const CaseEntry &entry)
    {
      constexpr unsigned int n_times = 1000;
      const std::string friction     = "friction "; // of a wall
      std::string text               = entry.value;
      if (text.rfind(friction, 0) == 0)
        text.erase(0, friction.size());
      if (entry.name == "Gravity")
        std::replace(text.begin(), text.end(), ',', ';');
      Point<dim> middle;
      for (unsigned int a = 0; a < dim; ++a)
        middle[a] = 0.5 * (parameters.grid.lower_corner[a] + parameters.grid.upper_corner[a]);
      const bool has_depth            = uses_depth(text);
      const unsigned int n_components = 1 + std::count(text.begin(), text.end(), ';');
      try
        {
          const auto values = parse_expression<dim>("", text, n_components, has_depth ? "depth" : "t");
          double largest    = 0.;
          for (unsigned int i = 0; i <= n_times; ++i)
            {
              values->set_time(i * (has_depth ? parameters.grid.lengths().back() : parameters.end_time) / n_times);
              double square = 0.;
              for (unsigned int c = 0; c < n_components; ++c)
                square += Utilities::fixed_power<2>(values->value(middle, c));
              largest = std::max(largest, std::sqrt(square));
            }
          return largest;
        }
      catch (const std::exception &) // It is a word such as auto, or no number there.
        {
          return std::nan("");
        }
    }


    /// Values of soil, water and loads in units other than SI.
    template <int dim>
    void add_unusual_units(const Parameters &parameters, std::vector<std::string> &remarks)
    {
      // In scenes of the laboratory soil of little strength stands.
      constexpr double least_strength = 200., least_part_of_weight = 0.01;
      const CaseEntries entries = parameters.entries();
      const double gravity      = largest_value<dim>(parameters, *entries.find("", "Gravity"));
      double weight             = 0.; // of the heaviest soil over the height of the box, Pa
      for (const BodyParameters &body : parameters.bodies)
        weight = std::max(weight, body.bulk_density() * gravity * parameters.grid.lengths().back());
      const double stress = weight > 0. ? std::min(least_strength, least_part_of_weight * weight) : least_strength;
      const auto ranges   = usual_ranges(stress);
      const auto is_read  = [&](const std::string &subsection) { // Laws that are not chosen are not.
        for (const BodyParameters &body : parameters.bodies)
          if (subsection.rfind(body.name + '/', 0) == 0)
            return subsection == body.name + "/Initial state" || subsection == body.material.path(body.name);
        return true;
      };
      for (const CaseEntry &entry : entries.all())
        {
          const auto found = ranges.find(entry.subsection == "Boundaries" ? "Friction angle" : entry.name);
          if (found == ranges.end() || !is_read(entry.subsection) || number_of(entry.value) <= 0.)
            continue;
          const UsualRange &usual = found->second;
          const double value      = largest_value<dim>(parameters, entry);
          if (value > 0. && !(value >= usual.lowest && value <= usual.highest))
            remarks.push_back("Unusual value: " +
                              entry_message({ entry.subsection, entry.name, entry.value },
                                            "usual are " + number_text(usual.lowest) + " to " +
                                                number_text(usual.highest) + ' ' + usual.unit + ". Look at the unit."));
        }
    }


    /// The volume of a region, m^3 (2D: m^2), that lies beyond a face of the box and ends there. 0 of one that goes on
    /// without end behind the face, such as a half space, and behind a wall also in an oblique direction, such as a
    /// layer. Beyond the corners of the box nothing counts.
    template <int dim>
    double volume_beyond(const Region<dim> &region,
                         const GridParameters &grid,
                         const unsigned int face,
                         const bool is_open,
                         const LevelSet<dim> *ground)
    {
      constexpr unsigned int n_lines = dim == 2 ? 32 : 16, n_places = dim == 2 ? 1024 : 128; // an axis; a line
      constexpr unsigned int n_oblique = dim == 2 ? 1024 : 96;                               // along an axis
      constexpr double lengths = 4., oblique = 16.; // of the box: of a line; of the plane that oblique layers reach
      const std::vector<double> box = grid.lengths();
      const unsigned int axis       = face / 2;
      const auto is_inside          = [&](const Point<dim> &x) {
        try
          {
            return region.contains(x);
          }
        catch (const ValueError &) // Outside the box an expression need not be a number.
          {
            return false;
          }
      };
      // A place of a lattice of n^(dim - 1) over `part` times the box, `beyond` the face.
      const auto place = [&](unsigned int number, const unsigned int n, const double part, const double beyond) {
        Point<dim> x;
        for (unsigned int a = 0; a < dim; ++a)
          if (a == axis)
            x[a] = face % 2 == 0 ? grid.lower_corner[a] - beyond * box[a] : grid.upper_corner[a] + beyond * box[a];
          else
            {
              x[a] = grid.lower_corner[a] + box[a] * (0.5 + part * ((number % n + 0.5) / n - 0.5));
              number /= n;
            }
        return x;
      };
      for (unsigned int i = 0; i < Utilities::pow(n_oblique, dim - 1) && !is_open; ++i)
        if (is_inside(place(i, n_oblique, oblique, lengths)))
          return 0.;
      unsigned int n_inside = 0;
      for (unsigned int line = 0; line < Utilities::pow(n_lines, dim - 1); ++line)
        {
          bool is_endless = false;
          for (double beyond = lengths; beyond < 1e6 && !is_endless; beyond *= 3.7)
            is_endless = is_inside(place(line, n_lines, 1., beyond));
          for (unsigned int i = 0; i < n_places && !is_endless; ++i)
            if (const Point<dim> x = place(line, n_lines, 1., lengths * (i + 0.5) / n_places); is_inside(x))
              n_inside += ground == nullptr || ground->is_open(x);
        }
      double volume = lengths * n_inside / n_places;
      for (unsigned int a = 0; a < dim; ++a)
        volume *= a == axis ? box[a] : box[a] / n_lines;
      return volume;
    }


    /// Regions that end beyond the box, so that less is filled than was asked for. Collective.
    /// @param walls of what fills the region
    /// @param filled volume of the points, m^3 (2D: m^2)
    /// @param entry entry and value, for the message
    template <int dim>
    void add_cut_region(const Parameters &parameters,
                        const Region<dim> &region,
                        const std::vector<Wall> &walls,
                        const LevelSet<dim> *ground,
                        const double filled,
                        const EntryValue &entry,
                        std::vector<std::string> &remarks)
    {
      constexpr double least_part = 0.005; // of what is filled
      const std::string unit      = dim == 2 ? " m^3/m" : " m^3";
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (const double beyond =
                volume_beyond<dim>(region, parameters.grid, face, walls[face].holds == Wall::Holds::nothing, ground);
            beyond > least_part * filled)
          remarks.push_back("Unusual value: " +
                            entry_message(entry,
                                          "the box cuts it off. " + number_text(beyond) + unit +
                                              " lie beyond the face " + FaceEntries::names(dim)[face] +
                                              " of the box, and " + number_text(filled) + unit +
                                              " in it are filled. Write a larger box, or let the region end there."));
    }


    /// A reservoir that stands beside soil whose pores are dry. Collective.
    /// @param reservoir where the free water is
    template <int dim>
    void add_dry_ground(const Parameters &parameters,
                        const std::list<SoilBody<dim>> &bodies,
                        const Region<dim> &reservoir,
                        const MPI_Comm communicator,
                        std::vector<std::string> &remarks)
    {
      const WaterParameters &water = parameters.water;
      const Region<dim> wet(
          entry_name("Water", water.place().first), water.region_in_soil(dim), nullptr, water.table<dim>());
      std::string place;
      for (const SoilBody<dim> &body : bodies)
        for_each_point(body.points, [&](const auto &point) {
          for (unsigned int neighbour = 1; neighbour < 2 * dim && place.empty(); ++neighbour)
            {
              // Beside or above, where water at its level stands higher than the point.
              const unsigned int axis = neighbour < 2 * dim - 1 ? (neighbour - 1) / 2 : dim - 1;
              Point<dim> beside       = point.location;
              beside[axis] += (neighbour % 2 == 0 ? -1. : 1.) * parameters.grid.cell_size;
              const GridParameters &grid = parameters.grid;
              if (beside[axis] > grid.lower_corner[axis] && beside[axis] < grid.upper_corner[axis] &&
                  !wet.contains(point.location) && reservoir.contains(beside))
                place = number_text(point.location);
            }
        });
      place = first_fault(place, communicator);
      if (!place.empty())
        remarks.push_back("Unusual value: " +
                          entry_message({ "Water", "Reservoir level", water.reservoir_level },
                                        "it stands above " + quoted(water.place().first) + " = " +
                                            water.place().second + ", beside soil with dry pores, for instance at " +
                                            place +
                                            " m. Write the same level for both where they meet, unless the reservoir "
                                            "rises suddenly."));
    }


    /// A body with the stress of soil at rest, and nothing within a cell below any of its points. Collective.
    template <int dim>
    void add_hanging_body(const Parameters &parameters,
                          const std::vector<SoilRegion> &soil,
                          const unsigned int number,
                          const PointSet<dim> &points,
                          const LevelSet<dim> *ground,
                          const MPI_Comm communicator,
                          std::vector<std::string> &remarks)
    {
      const double h = parameters.grid.cell_size, bottom = parameters.grid.lower_corner[dim - 1];
      const bool has_obstacles = std::any_of(parameters.obstacles.begin(),
                                             parameters.obstacles.end(),
                                             [](const auto &one) { return one.surface.is_set(); });
      if (!parameters.bodies[number].initial_state.is_k0() || parameters.gravity[dim - 1] >= 0. || has_obstacles)
        return;
      std::vector<Region<dim>> others;
      for (unsigned int i = 0; i < soil.size(); ++i)
        if (i != number)
          others.push_back(soil[i].template places<dim>());
      const auto is_solid = [&](const Point<dim> &x) {
        return x[dim - 1] < bottom || (ground != nullptr && !ground->is_open(x)) ||
               std::any_of(others.begin(), others.end(), [&](const auto &other) { return other.contains(x); });
      };
      double least = std::numeric_limits<double>::max();                       // height above what is below, m
      for (const double reach : { h, parameters.grid.lengths()[dim - 1] + h }) // The second one is rare, and long.
        {
          for_each_point(points, [&](const auto &point) {
            Point<dim> below = point.location;
            for (double height = h; height <= reach && height < least; height += 0.25 * h)
              if (below[dim - 1] = point.location[dim - 1] - height; is_solid(below))
                least = height;
          });
          least = Utilities::MPI::min(least, communicator);
          if (least <= h)
            return;
        }
      remarks.push_back("Unusual value: " +
                        entry_message({ soil[number].name, soil[number].entry().first, soil[number].entry().second },
                                      "nothing is within " + number_text(least - 0.25 * h) +
                                          " m below it, and its stress is that of soil at rest. Check its "
                                          "coordinates and \"Lower corner\" in subsection Mesh; for soil that "
                                          "falls write \"Type = none\" in subsection Initial state."));
    }
  } // namespace


  template <int dim>
  void add_unusual_values(const Parameters &parameters,
                          const std::list<SoilBody<dim>> &bodies,
                          const std::list<WaterPhase<dim>> &water,
                          const LevelSet<dim> *ground,
                          const MPI_Comm communicator,
                          std::vector<std::string> &remarks)
  {
    add_unusual_units<dim>(parameters, remarks);
    const auto volume_of = [&](const PointSet<dim> &points, const unsigned int slot) {
      double volume = 0.;
      for_each_point(points, [&](const auto &point) { volume += point.properties[slot]; });
      return Utilities::MPI::sum(volume, communicator);
    };
    const std::vector<SoilRegion> soil = parameters.soil_regions();
    auto body                          = bodies.begin();
    for (unsigned int i = 0; i < soil.size(); ++i, ++body)
      {
        const SeedingParameters &seeding = parameters.bodies[i].seeding;
        const double volume              = volume_of(body->points, body->layout.volume);
        add_hanging_body(parameters, soil, i, body->points, ground, communicator, remarks);
        if (!seeding.has_expression()) // Maps are checked when they are read.
          continue;
        add_cut_region<dim>(parameters,
                            soil[i].template places<dim>(),
                            parameters.boundaries.walls(dim),
                            ground,
                            volume,
                            { body->name, "Region", seeding.region },
                            remarks);
        const double area = soil[i].map && !soil[i].map->is_layer() ? soil[i].map->area() : 0.;
        if (area > 0. && volume > 0.5 * std::pow(area, 1.5))
          remarks.push_back("Unusual value: " +
                            entry_message({ body->name, "Region", seeding.region },
                                          "it fills the " + number_text(area) + " m^2 of the \"Outline\" " +
                                              number_text(volume / area) +
                                              " m high, more than half their width. Its heights are those of the map. "
                                              "Write a \"Thickness\" above the bed in its place, or lower heights."));
      }
    if (!parameters.has_water || water.front().carrier() != nullptr)
      return;
    const double volume = volume_of(water.front().points(), water.front().layout.volume);
    for (const WaterPart<dim> &part : water_parts<dim>(parameters.water, soil))
      if (part.soil == nullptr)
        {
          const WaterParameters &entries = parameters.water;
          const bool is_reservoir        = !entries.reservoir_level.empty();
          add_cut_region<dim>(parameters,
                              part.region,
                              parameters.water_boundaries.walls(dim),
                              ground,
                              volume,
                              { "Water",
                                is_reservoir ? "Reservoir level" : "Region",
                                is_reservoir ? entries.reservoir_level : entries.region },
                              remarks);
          if (is_reservoir && entries.place().first.rfind("Phreatic", 0) == 0)
            add_dry_ground<dim>(parameters, bodies, part.region, communicator, remarks);
        }
  }

  template decltype(add_unusual_values<2>) add_unusual_values<2>;
  template decltype(add_unusual_values<3>) add_unusual_values<3>;
} // namespace scree
