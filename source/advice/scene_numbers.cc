// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/advice/advise.h>
#include <scree/tensor/invariants.h>

#include <iterator>

namespace scree
{
  using namespace dealii;

  Groups groups_of(const SceneNumbers &scene)
  {
    Groups groups;
    const double H = scene.height, g = scene.gravity, M = scene.constrained_modulus();
    groups.cells_over_height = H / scene.cell_size;
    groups.wave_speed        = scene.mean.speed();
    groups.motion_time       = g > 0 ? std::sqrt(H / g) : groups.wave_speed > 0 ? H / groups.wave_speed : 0.;
    if (!scene.has_soil)
      return groups;
    const double weight       = scene.density() * g * H; // Pa
    groups.own_strain         = weight / M;
    groups.shear_stress_ratio = scene.mean.shear_modulus > 0 ? weight / scene.mean.shear_modulus : 0.;
    groups.mach_number        = std::sqrt(g * H) / groups.wave_speed;
    if (!scene.has_water)
      return groups;
    constexpr double earth_gravity   = 9.81; // m/s^2, at which the conductivity is defined, whatever the scene's
    const double unit_weight         = scene.water_density * earth_gravity; // N/m^3
    groups.consolidation_coefficient = scene.conductivity * M / unit_weight;
    groups.drainage_time             = H * H / groups.consolidation_coefficient;
    groups.drainage                  = groups.motion_time > 0 ? groups.drainage_time / groups.motion_time : 0.;
    groups.time_factor               = scene.end_time / groups.drainage_time;
    const double n = scene.porosity, drag = n * n * unit_weight / scene.conductivity; // N s/m^4
    groups.drag_time = 1. / (drag * (1. / ((1. - n) * scene.grain_density) + 1. / (n * scene.water_density)));
    return groups;
  }


  double conductivity_for(const SceneNumbers &scene, const double drainage)
  {
    const Groups groups = groups_of(scene);
    return scene.conductivity * groups.drainage / drainage;
  }


  namespace
  {
    template <int dim>
    class Surveyor
    {
    public:
      Surveyor(const Simulation<dim> &simulation, const Parameters &parameters, const MPI_Comm communicator)
          : run(simulation.state_of_scene())
          , parameters(parameters)
          , grid(run.grid)
          , communicator(communicator)
          , axis(dim - 1) // without gravity nothing depends on it
          , occupied(grid.triangulation().n_active_cells(), 0)
      {
        for (unsigned int a = 0; a < dim; ++a)
          if (std::abs(parameters.gravity[a]) > std::abs(parameters.gravity[axis]))
            axis = a;
      }

      SceneNumbers look()
      {
        read_entries();
        find_height();
        for (const auto &body : run.bodies)
          if (!body.is_rigid)
            look_at_soil(body);
        for (const auto &part : run.water)
          look_at_water(part);
        finish();
        return scene;
      }

    private:
      void read_entries()
      {
        scene.dim      = dim;
        scene.end_time = parameters.end_time;
        scene.gravity =
            Tensor<1, dim>(make_array_view(parameters.gravity.data(), parameters.gravity.data() + dim)).norm();
        scene.cell_size = grid.cell_size();
        scene.n_cells   = grid.n_cells_of_box();
        scene.has_soil  = std::any_of(
            parameters.bodies.begin(), parameters.bodies.end(), [](const auto &body) { return !body.is_rigid(); });
        const Wall floor =
            parameters.boundaries.walls(dim)[2 * axis + (parameters.gravity[axis] > 0)]; // in deal.II's numbering
        scene.sticks =
            parameters.bed.is_set() ? parameters.bed.type_kind() == BedType::fixed : floor.holds == Wall::Holds::all;
        scene.is_elastic          = scene.has_soil;
        scene.grain_diameter      = scene.has_soil ? std::numeric_limits<double>::max() : 0;
        scene.has_water           = parameters.has_water;
        scene.courant_of_transfer = parameters.transfer.courant_number(parameters.has_water);
        scene.has_changing_forces = parameters.surface_load.changes_with_time() || parameters.body_forces.is_set();
        if (!scene.has_water)
          return;
        scene.is_single_point  = parameters.water.point_sets_kind() == PointSets::single_point;
        scene.water_fills_soil = parameters.water.is_where_soil_is();
        scene.water_density    = parameters.water.density;
      }

      /// m, against gravity, above the lowest wall of the box.
      double height_of(const Point<dim> &x) const
      {
        return parameters.gravity[axis] > 0 ? grid.upper_corner()[axis] - x[axis] : x[axis] - grid.lower_corner()[axis];
      }

      void find_height()
      {
        if (scene.has_soil && run.bed)
          {
            scene.is_layer = true;
            SoilMotion<dim> motion(grid, Tensor<1, dim>(), run.bed.get());
            scene.height = grid.cell_size() * motion.look(run.bodies, Tensor<1, 2 * dim>(), 0.).thickness;
            return;
          }
        // Largest coordinate and minus the smallest, for each axis.
        std::vector<double> ends(2 * dim, -std::numeric_limits<double>::infinity());
        const auto add = [&](const auto &point) {
          for (unsigned int a = 0; a < dim; ++a)
            {
              ends[2 * a]     = std::max(ends[2 * a], point.location[a]);
              ends[2 * a + 1] = std::max(ends[2 * a + 1], -point.location[a]);
            }
        };
        for (const auto &body : run.bodies)
          for_each_point(body.points, add);
        if (!scene.has_soil)
          for (const auto &part : run.water)
            for_each_point(part.points(), add);
        Utilities::MPI::max(ends, communicator, ends);
        // Outer points stand half a spacing inside the surface.
        scene.height  = scene.cell_size / (scene.has_soil ? parameters.bodies[0].seeding.points_per_cell
                                                          : parameters.water.points_per_cell);
        double length = 0.; // without points
        for (unsigned int a = 0; a < dim; ++a)
          if (scene.gravity == 0. || a == axis)
            length = std::max(length, ends[2 * a] + ends[2 * a + 1]);
        scene.height += length;
      }

      void look_at_soil(const SoilBody<dim> &body)
      {
        const Material<dim> &law = *body.material;
        scene.is_elastic         = scene.is_elastic && law.is_elastic();
        scene.grain_diameter     = std::min(scene.grain_diameter, law.grain_diameter);
        // Soil without stress gets its first one from its weight.
        const double first_pressure = 2. / 3. * body.density * scene.gravity * scene.height;
        for_each_point(body.points, [&](const auto &point) {
          const double *properties = point.properties;
          const double mass = properties[body.layout.mass], volume = properties[body.layout.volume];
          const double at_start = mean_effective_stress(properties + body.layout.stress);
          const double pressure = at_start > 0 ? at_start : first_pressure;
          const WaveMedium medium{ law.initial_bulk_modulus(pressure), law.shear_modulus, body.density };
          if (medium.speed() > scene.fastest.speed())
            scene.fastest = medium;
          ++scene.n_soil_points;
          soil_mass += mass;
          soil_volume += volume;
          grain_volume += mass / body.grain_density;
          bulk_sum += volume * medium.bulk_modulus;
          shear_sum += volume * medium.shear_modulus;
          height_moment += mass * height_of(point.location);
        });
        occupy(body.points);
      }

      void look_at_water(const WaterPhase<dim> &part)
      {
        for_each_point(part.points(), [&](const auto &point) {
          const double *properties = point.properties;
          scene.n_water_points += part.carrier() == nullptr;
          water_mass += properties[part.layout.mass];
          water_volume += properties[part.layout.volume];
          height_moment += properties[part.layout.mass] * height_of(point.location);
        });
        occupy(part.points());
      }

      /// Of the bodies that move, at the start, m/s.
      double smallest_conductivity() const
      {
        double smallest = std::numeric_limits<double>::infinity();
        for (const BodyParameters &body : parameters.bodies)
          if (const double porosity = body.initial_porosity(); porosity > 0 && !body.is_rigid())
            smallest = std::min(smallest, body.drag_law(parameters.water).conductivity(porosity));
        return std::isfinite(smallest) ? smallest : parameters.water.conductivity;
      }

      void occupy(const PointSet<dim> &points)
      {
        for (const auto &cell : points.cells())
          occupied[cell.cell] = 1;
      }

      void finish()
      {
        scene.n_occupied = std::count(occupied.begin(), occupied.end(), 1);
        const NumbersOf sums{ &scene.n_soil_points,  &soil_mass,       &soil_volume,
                              &grain_volume,         &bulk_sum,        &shear_sum,
                              &scene.n_water_points, &water_mass,      &water_volume,
                              &height_moment,        &scene.n_occupied };
        sums.sum_over_ranks(communicator);
        if (scene.has_soil)
          {
            scene.mean          = { bulk_sum / soil_volume, shear_sum / soil_volume, soil_mass / soil_volume };
            scene.grain_density = soil_mass / grain_volume;
            scene.porosity      = 1. - grain_volume / soil_volume;
            if (scene.has_water)
              scene.conductivity = smallest_conductivity();
          }
        // The rank with the fastest wave names its soil.
        const auto speeds = Utilities::MPI::min_max_avg(scene.fastest.speed(), communicator);
        scene.fastest     = Utilities::MPI::broadcast(communicator, scene.fastest, speeds.max_index);

        // Level in the box, soil and the water that finds no room in its pores have their centre at half their height.
        const double box_height = grid.upper_corner()[axis] - grid.lower_corner()[axis];
        const double floor      = scene.n_cells * Utilities::fixed_power<dim>(scene.cell_size) / box_height;
        const double free_water = std::max(0., water_volume - (soil_volume - grain_volume));
        const double level      = (soil_volume + free_water) / floor;
        scene.fall              = std::max(0., height_moment / (soil_mass + water_mass) - 0.5 * level);
      }

      const Scene<dim> &run;
      const Parameters &parameters;
      const BackgroundGrid<dim> &grid;
      const MPI_Comm communicator;
      unsigned int axis; // of gravity
      SceneNumbers scene;

      std::vector<char> occupied; // cells, on this rank
      // Sums over the points, SI units; moduli times volume.
      double soil_mass = 0, soil_volume = 0, grain_volume = 0, bulk_sum = 0, shear_sum = 0;
      double water_mass = 0, water_volume = 0;
      double height_moment = 0; // kg m
    };
  } // namespace


  template <int dim>
  SceneNumbers survey(const Simulation<dim> &simulation, const Parameters &parameters, const MPI_Comm communicator)
  {
    return Surveyor<dim>(simulation, parameters, communicator).look();
  }

  template decltype(survey<2>) survey<2>;
  template decltype(survey<3>) survey<3>;


  RegimeChoice regime_choice(const SceneNumbers &scene)
  {
    if (!scene.has_water)
      return { Regime::dry, "dry", "the case has no water" };
    if (!scene.has_soil)
      return { Regime::free_water, "water alone", "the case has no soil that moves" };
    const Groups groups         = groups_of(scene);
    const std::string ratio     = "drainage time over motion time is " + short_text(groups.drainage);
    const std::string drained   = short_text(thresholds::drained_below);
    const std::string undrained = short_text(thresholds::undrained_above);
    if (groups.drainage < thresholds::drained_below)
      // Water outside, and that of soil that flows, moves on its own.
      return scene.is_elastic && scene.water_fills_soil
                 ? RegimeChoice{ Regime::drained,
                                 "drained",
                                 ratio + ", below " + drained +
                                     ": soil alone serves, of the saturated density and under water with its buoyant "
                                     "weight" }
                 : RegimeChoice{ Regime::coupled,
                                 "coupled",
                                 ratio + ", below " + drained + ", but its water must move, too" };
    if (!(groups.drainage > thresholds::undrained_above))
      return { Regime::coupled, "coupled", ratio + ", between " + drained + " and " + undrained };
    if (groups.time_factor < thresholds::consolidates_above && !scene.water_fills_soil)
      return { Regime::coupled,
               "coupled",
               ratio + ", above " + undrained + ", but its water outside the soil moves, too" };
    if (groups.time_factor < thresholds::consolidates_above)
      return { Regime::undrained,
               "undrained",
               ratio + ", above " + undrained + ", and T_v at the end " + short_text(groups.time_factor) + ", below " +
                   short_text(thresholds::consolidates_above) + ": water hardly moves through the soil" };
    return { Regime::coupled,
             "coupled",
             ratio + ", above " + undrained + ", but T_v at the end is " + short_text(groups.time_factor) +
                 ": pressure leaves during the run" };
  }


  PointSetChoice point_sets_for(const Regime regime, const SceneNumbers &scene)
  {
    constexpr double small_strain = 0.01;
    if (!scene.has_soil || !scene.water_fills_soil)
      return { PointSets::double_point, "there is water that is not in the soil's pores, or soil without" };
    if (scene.is_elastic && groups_of(scene).own_strain < small_strain)
      return { PointSets::single_point, "small motion: both agree, and single has half the points" };
    if (regime == Regime::undrained)
      return { PointSets::single_point, "water stays with its soil, whose points can carry it" };
    return { PointSets::double_point, "water leaves its soil; single-point water would not be conserved" };
  }


  namespace
  {
    /// Of which scenes a law of convergence is, the first that applies.
    struct LawOfScenes
    {
      bool (*applies)(const SceneNumbers &scene);
      ErrorLaw law;
    };

    // Measured: doc/studies/pages/run_out.md (dry, against the extrapolated front),
    // saturated_slopes.md (against the run with H/h = 40); doc/verification/saturated_slopes.md: undrained heap in
    // total stress, Terzaghi's column at T_v = .1 with 20 cells, order 1.9 to 2.25, the dam break's tip at h = .1 and
    // .05 m.
    const LawOfScenes laws[] = {
      { [](const SceneNumbers &scene) { return !scene.has_soil; },
        { "of the water's tip",
          0.5,
          1.,
          "1.1 to 3.0 % at H/h = 20, against H/h = 80; the tip is then 12 % ahead of Martin & Moyce's experiment" } },
      { [](const SceneNumbers &scene) { return scene.is_elastic; },
        { "of stress and pressure", 0.33, 2., "0.03 to 0.08 % of the load at H/h = 20, Terzaghi's column" } },
      { [](const SceneNumbers &scene) { return !scene.falls(); },
        { "of the run-out", 3.8, 1., "", "its law is that of soil that falls and runs out" } },
      { [](const SceneNumbers &scene) { return scene.has_water && regime_choice(scene).regime == Regime::undrained; },
        { "of the run-out",
          3.8,
          1.,
          "-5.5 % at H/h = 10 to +18.5 % at H/h = 80, undrained heap against total stress",
          "the front of undrained soil has not converged",
          "its error grows with finer cells. Compare three cell sizes, and report their range" } },
      { [](const SceneNumbers &scene) { return scene.has_water && scene.sticks; },
        { "of the run-out",
          3.8,
          1.,
          "13 to 24 % at H/h = 20, saturated loose slope on a fixed base against H/h = 40",
          "fronts of saturated slopes on such a base have not converged" } },
      { [](const SceneNumbers &scene) { return scene.has_water; },
        { "of the run-out",
          2.4,
          1.,
          "12 and 5 % of the displacement of the front of 90 % of the mass at H/h = 20 and 40 with TPIC, saturated "
          "loose slope on a base with friction, against the extrapolated front; extrapolated fronts of TPIC, FLIP and "
          "AFLIP differ by 12 %; the front of 99 % has no limit" } },
      { [](const SceneNumbers &scene) {
         constexpr double least_grain= 0.005; // of the height; smaller ones hardly slow the flow
         return scene.grain_diameter > least_grain * scene.height;
       },
        { "of the run-out",
          1.2,
          1.,
          "2 to 10 % of the displacement of the front at H/h = 48 to 12, columns with inertial friction, d/H = 0.011, "
          "against the extrapolated front" } },
      { [](const SceneNumbers &scene) { return scene.sticks; },
        { "of the run-out",
          3.8,
          1.,
          "10 to 19 % of the displacement of the front at H/h = 20 on a base that holds the soil, against the "
          "extrapolated front",
          "",
          "the front then runs ahead of experiments, by 20 to 40 % of its displacement. Set Grain diameter, or give "
          "the base the friction of the soil" } },
      { [](const SceneNumbers &) { return true; },
        { "of the run-out",
          1.6,
          1.,
          "4 to 8 % of the displacement of the front of 90 % of the mass at H/h = 20 on a base with friction, against "
          "the extrapolated front; the front of 99 % up to 14 % from H/h = 28 to 40" } }
    };

    /// Why the law of elastic soil, measured where a constant load drains, does not decide; empty: it does.
    std::string gap_of_elastic_law(const SceneNumbers &scene)
    {
      constexpr double least_time_factor = 0.1;
      if (scene.has_changing_forces)
        return "its law is that of a constant load, and here a load changes with time, or there is a body force";
      if (!scene.has_water)
        return "its law is that of a load that drains, and there is no water";
      if (!scene.water_fills_soil)
        return "its law is that of saturated soil alone, and there is other water or soil without";
      if (groups_of(scene).time_factor < least_time_factor)
        return "its law begins at T_v = 0.1, after the end of this run";
      return "";
    }
  } // namespace


  ErrorLaw error_law_of(const SceneNumbers &scene)
  {
    ErrorLaw law =
        std::find_if(std::begin(laws), std::end(laws), [&](const auto &of) { return of.applies(scene); })->law;
    if (!scene.has_soil && !scene.falls())
      law.gap = "its law is that of water that falls and runs";
    else if (scene.has_soil && scene.is_elastic)
      law.gap = gap_of_elastic_law(scene);
    else if (scene.is_layer)
      {
        law.gap    = "its law is that of heaps, and here soil runs out on a bed";
        law.remedy = "";
      }
    return law;
  }


  double cell_size_for(const GridParameters &grid, const double height, const double cells)
  {
    const double largest = height / cells, present = grid.cell_size;
    // The cell size at hand divides the box: at worst a whole part of it does.
    const double at_worst = present / std::ceil(present / largest), size = grid.size_that_divides(largest, at_worst);
    return size > 0. ? size : at_worst;
  }


  TimeStepParameters time_step_for(const SceneNumbers &scene, TimeStepParameters present)
  {
    // Measured, doc/developer/development_log.md: Terzaghi's error is the same at Courant numbers 0.1 and 0.9; the dam
    // breaks ran with 0.04 s/m.
    constexpr double free_water_step_over_cell = 0.04; // s/m
    present.courant = scene.is_elastic && scene.has_water && scene.water_fills_soil ? "0.9" : "auto";
    present.choose(scene.has_water, scene.courant_of_transfer, scene.gravity, scene.cell_size);
    if (!scene.has_soil)
      present.maximum_time_step = free_water_step_over_cell * scene.cell_size;
    return present;
  }
} // namespace scree
