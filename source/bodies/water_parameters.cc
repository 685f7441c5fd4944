// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/bodies/water_parameters.h>

namespace scree
{
  using namespace dealii;

  void PressureParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Pressure");
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Residual at which a solve ends, over the larger of the right-hand side and the product of the "
                      "matrix with the whole pressure.",
                      Patterns::Double(1e-14, 0.1));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "Number of iterations after which a solve that has not converged stops the run.",
                      Patterns::Integer(1, 100000));
    prm.add_parameter(
        "Cavitation pressure",
        cavitation_pressure,
        "Pa; pressure at which water cavitates: p does not fall below it. p = 0 is the atmospheric pressure.",
        Patterns::Double(-1e15, 0));
    prm.leave_subsection();
  }


  void WaterParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Region",
                      region,
                      "Region of the water, in the pores of the soil and outside: same (wherever soil is), or an "
                      "expression of x, y (z), in m. Without subsection Water the case is dry.");
    add_level_parameters(prm);
    prm.add_parameter(
        "Point sets",
        point_sets,
        "double: water has points of its own, which move with it. single: the soil points carry the water.",
        Patterns::Selection("double|single"));
    prm.add_parameter(
        "Points per cell",
        points_per_cell,
        "Water points along each axis of a cell. Double-point only. Take 6 where water flows into a body with "
        "pores: there the distance of the points grows to 1/n of it, n = porosity.",
        Patterns::Integer(1, 32));
    prm.add_parameter("Density", density, "kg/m^3; density of the water.", Patterns::Double(1e-12));
    add_drag_parameters(prm);
    prm.add_parameter("Viscosity", viscosity, "Pa s; dynamic viscosity of the water; 0: none.", Patterns::Double(0));
    prm.add_parameter(
        "Bulk modulus", bulk_modulus, "Pa; bulk modulus of the water; 0: incompressible.", Patterns::Double(0));
    prm.add_parameter("Volume correction rate",
                      volume_correction_rate,
                      "1/s; rate at which surplus free water leaves crowded cells; 0: never. Usual: 1/2 sqrt(g/h), "
                      "with cell size h. Double-point only.",
                      Patterns::Double(0));
    prm.add_parameter(
        "Initial pressure",
        initial_pressure,
        "hydrostatic: weight of the water above each point; buoyancy reduces the K0 stress of the soil. none: 0.",
        Patterns::Selection("hydrostatic|none"));
    prm.add_parameter("Initial velocity",
                      initial_velocity,
                      "m/s; velocity of the water at the start, one expression per axis, separated by semicolons. "
                      "Empty: at rest. Double-point only.");
    prm.add_parameter("Air entry pressure",
                      air_entry_pressure,
                      "Pa; suction at which air enters the pores. Where dry soil lies behind the surface of the water, "
                      "the pressure at this surface is its negative. With \"Phreatic surface\" the pores above it are "
                      "full up to the height where the suction is that "
                      "large. 0: no suction. Double-point only.",
                      Patterns::Double(0));
  }


  void WaterParameters::add_drag_parameters(ParameterHandler &prm)
  {
    prm.declare_entry("Hydraulic conductivity",
                      conductivity_text,
                      Patterns::Anything(),
                      "m/s; conductivity (Darcy) of the soil at its initial porosity. auto: 1e-3, unless \"Grain "
                      "diameter\" gives the drag.");
    prm.add_action("Hydraulic conductivity", [this](const std::string &text) {
      conductivity_text = text;
      conductivity      = text == "auto" ? WaterParameters().conductivity : number_of(text);
    });
    prm.add_parameter("Conductivity law",
                      conductivity_law,
                      "constant: independent of the porosity n. Kozeny-Carman: proportional to n^3/(1-n)^2.",
                      Patterns::Selection("constant|Kozeny-Carman"));
    prm.add_parameter("Grain diameter",
                      grain_diameter,
                      "m; grain diameter for the drag law of Ergun (1952), from slow to turbulent flow, with porosity, "
                      "\"Density\" and \"Viscosity\". 0: \"Hydraulic conductivity\" gives the drag.",
                      Patterns::Double(0));
  }


  void WaterParameters::check(const std::vector<double> &gravity, const unsigned int n_bodies) const
  {
    const std::size_t dim = gravity.size();
    require_entry(
        !is_where_soil_is() || n_bodies > 0,
        { "Water", "Region", region },
        "there is no soil, as entry \"Bodies\" is none. Write where the water is, for instance x < 1 && y < 1");
    if (region != WaterParameters().region)
      check_expression(dim, entry_name("Water", "Region"), region, 1);
    if (!initial_velocity.empty())
      check_expression(dim, entry_name("Water", "Initial velocity"), initial_velocity, dim);
    check_seepage(n_bodies);
    if (has_levels())
      check_levels(gravity, n_bodies);
    if (air_entry_pressure > 0)
      check_air_entry(n_bodies);
    if (point_sets_kind() == PointSets::single_point)
      check_single_point();
    if (n_bodies == 0)
      check_without_soil();
    require_entry(conductivity >= 1e-20 && std::isfinite(conductivity),
                  { "Water", "Hydraulic conductivity", conductivity_text },
                  "write auto, or a number from 1e-20 on, in m/s.");
    if (grain_diameter > 0)
      check_grain_diameter();
    // Gravity 0 is no fault: the pressure starts at 0.
    require_entry(!starts_hydrostatic() || std::count(gravity.begin(), gravity.end(), 0.) + 1 >= long(dim),
                  { "Water", "Initial pressure", initial_pressure },
                  "the weight above a point needs gravity along one axis, but entry \"Gravity\" = " +
                      number_text(gravity) + ". Change it, or write \"Initial pressure = none\".");
  }


  void WaterParameters::check_seepage(const unsigned int n_bodies) const
  {
    require_entry(is_steady || wall_heads.empty(),
                  { "Water", "Heads at walls", wall_heads },
                  "this entry has no effect. Remove it, or write \"Steady seepage = true\".");
    heads_at_walls();
    if (!is_steady)
      return;
    require_entry(n_bodies > 0,
                  { "Water", "Steady seepage", "true" },
                  "there is no soil, as entry \"Bodies\" is none. Remove this entry.");
    require_entry(phreatic_surface.empty() && phreatic_layer.empty(),
                  phreatic_surface.empty() ? EntryValue("Water", "Phreatic layer", phreatic_layer)
                                           : EntryValue("Water", "Phreatic surface", phreatic_surface),
                  "the water table follows from \"Steady seepage\". Keep one of the two.");
    require_entry(!reservoir_level.empty() || !wall_heads.empty(),
                  { "Water", "Steady seepage", "true" },
                  "no head is given. Write a \"Reservoir level\" or \"Heads at walls\".");
    require_entry(initial_pressure != "none",
                  { "Water", "Initial pressure", initial_pressure },
                  "the pressure is that of \"Steady seepage\". Keep one of the two.");
  }


  void WaterParameters::check_single_point() const
  {
    const WaterParameters defaults;
    require_entry(is_where_soil_is(),
                  { "Water", place().first, place().second },
                  "the soil points carry single-point water. Write \"Region = same\", or "
                  "\"Point sets = double\".");
    const std::string remedy =
        "this entry has no effect, as the soil points carry single-point water. Remove it, or write "
        "\"Point sets = double\".";
    require_entry(volume_correction_rate == defaults.volume_correction_rate,
                  { "Water", "Volume correction rate", volume_correction_rate },
                  remedy);
    require_entry(
        initial_velocity == defaults.initial_velocity, { "Water", "Initial velocity", initial_velocity }, remedy);
  }


  void WaterParameters::check_levels(const std::vector<double> &gravity, const unsigned int n_bodies) const
  {
    const std::size_t dim         = gravity.size();
    const auto [entry, elevation] = place();
    require_entry(region == WaterParameters().region,
                  { "Water", "Region", region },
                  quoted(entry) + " = " + elevation + " says where water is, too. Keep one of the two.");
    require_entry(phreatic_layer.empty() || phreatic_surface.empty(),
                  { "Water", "Phreatic layer", phreatic_layer },
                  "\"Phreatic surface\" is the water table, too. Keep one of the two.");
    require_entry(n_bodies > 0 || (phreatic_surface.empty() && phreatic_layer.empty()),
                  { "Water", entry, elevation },
                  "there is no soil, as entry \"Bodies\" is none. Write a \"Reservoir level\".");
    require_entry(gravity.back() < 0 && std::count(gravity.begin(), gravity.end(), 0.) + 1 == long(dim),
                  { "Water", entry, elevation },
                  std::string("an elevation needs gravity along -") + "xyz"[dim - 1] +
                      ", but entry \"Gravity\" = " + number_text(gravity) + ". Change it, or write a \"Region\".");
    for (const auto &[name, text] :
         { std::make_pair("Phreatic surface", phreatic_surface), std::make_pair("Reservoir level", reservoir_level) })
      if (!text.empty())
        check_expression(dim, entry_name("Water", name), text, 1, "", "8 - 0.2*x");
  }


  namespace
  {
    std::string below(const std::string &elevation, const unsigned int dim)
    {
      return (dim == 2 ? "y < (" : "z < (") + elevation + ")";
    }
  } // namespace


  std::string WaterParameters::region_in_soil(const unsigned int dim) const
  {
    if (is_steady || !phreatic_layer.empty()) // table() says where.
      return "1";
    if (has_levels())
      return below("(" + place().second + ')' + (fringe > 0. ? " + " + number_text(fringe) : ""), dim);
    return region;
  }


  std::string WaterParameters::region_outside(const unsigned int dim) const
  {
    if (!has_levels())
      return is_where_soil_is() ? "" : region;
    return reservoir_level.empty() ? "" : below(reservoir_level, dim);
  }
} // namespace scree
