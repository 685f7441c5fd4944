// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_water_parameters_h
#define scree_bodies_water_parameters_h

#include <scree/particles/region.h>

#include <tuple>

namespace scree
{
  /// Subsection Pressure of subsection Water.
  struct PressureParameters
  {
    double relative_tolerance       = 3e-5; ///< of the residual, over the larger of |b| and |S p|
    unsigned int maximum_iterations = 500;  ///< the run ends with an error beyond them
    double cavitation_pressure      = -1e5; ///< Pa

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);
  };

  /// How points carry soil and water.
  enum class PointSets
  {
    double_point, ///< water has points of its own
    single_point  ///< water rides on the soil's points
  };

  /// Subsection Water: where it is, and how it flows through the soil.
  struct WaterParameters
  {
    std::string region            = "same";        ///< as the soil, or an expression
    std::string point_sets        = "double";      ///< double | single, see PointSets
    unsigned int points_per_cell  = 3;             ///< along each axis
    double density                = 1000;          ///< kg/m^3
    double conductivity           = 1e-3;          ///< m/s, at the initial porosity; NaN: the entry is no number
    std::string conductivity_text = "auto";        ///< the entry
    std::string conductivity_law  = "constant";    ///< constant | Kozeny-Carman
    double grain_diameter         = 0;             ///< m; 0: the conductivity says what the drag is
    double viscosity              = 0;             ///< Pa s
    double bulk_modulus           = 0;             ///< Pa; 0: incompressible
    double volume_correction_rate = 0;             ///< of free water, 1/s
    std::string initial_pressure  = "hydrostatic"; ///< hydrostatic | none
    std::string initial_velocity  = "";            ///< m/s, one expression an axis; empty: at rest
    bool is_fed                   = false;         ///< as SeedingParameters::is_fed
    std::string phreatic_surface  = "";            ///< expression of its elevation, m; empty: not given
    std::string phreatic_layer    = "";            ///< of the drawing, with its line; empty: not given
    std::string reservoir_level   = "";            ///< expression of the elevation, m; empty: no reservoir
    double air_entry_pressure     = 0;             ///< suction at which air enters the soil, Pa; 0: none
    double fringe                 = 0;             ///< height above given levels up to which it fills the pores, m
    bool is_steady                = false;         ///< whether the pressure in soil is that of steady seepage
    std::string wall_heads        = "";            ///< of it, `Left: 12, Right: 4`, m; empty: none
    std::shared_ptr<const Profile> phreatic_line;  ///< once the drawing is read; null without

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    /// @param gravity m/s^2, one number an axis
    void check(const std::vector<double> &gravity, const unsigned int n_bodies) const;

    /// Throws EntryError if a head at a wall is not in the box.
    void check_wall_heads(const std::vector<double> &lower, const std::vector<double> &upper) const
    {
      const double bottom = lower.back(), top = upper.back();
      for (const auto &[wall, head] : heads_at_walls())
        {
          require_entry(wall != "Top",
                        { "Water", "Heads at walls", wall_heads },
                        "no soil at the top wall is below a head in the box. Remove \"Top\".");
          require_entry(head > bottom && head <= top,
                        { "Water", "Heads at walls", wall_heads },
                        "the head of " + number_text(head) +
                            " m is not in the box of subsection Mesh. Write one above " + number_text(bottom) +
                            " and up to " + number_text(top) + " m, or a larger box.");
        }
    }

    /// Names of walls and the heads of steady seepage there, m. Throws EntryError if the text does not read.
    std::vector<std::pair<std::string, double>> heads_at_walls() const
    {
      std::vector<std::pair<std::string, double>> heads;
      for (const std::string &part : dealii::Utilities::split_string_list(wall_heads, ','))
        {
          const std::vector<std::string> words = dealii::Utilities::split_string_list(part, ':');
          const double head                    = words.size() == 2 ? number_of(words[1]) : std::nan("");
          require_entry(std::isfinite(head),
                        { "Water", "Heads at walls", wall_heads },
                        "write walls with their heads in m, such as Left: 12, Right: 4.");
          heads.emplace_back(words.front(), head);
        }
      return heads;
    }

    /// Entry `Point sets` as an enum.
    PointSets point_sets_kind() const
    {
      return point_sets == "single" ? PointSets::single_point : PointSets::double_point;
    }

    /// Whether the pressure at the start is the weight of the water above.
    bool starts_hydrostatic() const
    {
      return initial_pressure == "hydrostatic";
    }

    /// Whether the region is wherever soil is, and not an expression.
    bool is_where_soil_is() const
    {
      return region == "same" && !has_levels();
    }

    /// Sets `fringe` from the air entry pressure, where levels say where water is, and the table of a phreatic line.
    /// @param gravity m/s^2
    void find_fringe(const double gravity)
    {
      if (air_entry_pressure > 0. && gravity > 0. && has_levels())
        fringe = air_entry_pressure / (density * gravity);
      if (phreatic_line)
        set_table<2>(std::make_shared<const Profile>(phreatic_line->raised(fringe)));
    }

    /// The same water with pores that are full up to the water table only.
    WaterParameters without_fringe() const
    {
      WaterParameters result = *this;
      result.fringe          = 0.;
      if (phreatic_line)
        result.set_table<2>(phreatic_line);
      return result;
    }

    /// Whether a phreatic surface, a reservoir level or steady seepage say where water is, in place of the region.
    bool has_levels() const
    {
      return is_steady || !(phreatic_surface.empty() && phreatic_layer.empty() && reservoir_level.empty());
    }

    /// Entry and value that place the water, for messages.
    std::pair<std::string, std::string> place() const
    {
      if (is_steady)
        return { "Steady seepage", "true" };
      if (!phreatic_surface.empty())
        return { "Phreatic surface", phreatic_surface };
      if (!phreatic_layer.empty())
        return { "Phreatic layer", phreatic_layer };
      if (!reservoir_level.empty())
        return { "Reservoir level", reservoir_level };
      return { "Region", region };
    }

    /// Where water is in pores, as an expression; a table() is asked besides.
    std::string region_in_soil(const unsigned int dim) const;

    /// Where water is outside the soil, as an expression; empty: nowhere.
    std::string region_outside(const unsigned int dim) const;

    /// What bounds the water in soil, as a surface whose open is dry: a phreatic line, or that of steady seepage once
    /// it is known. Null without.
    template <int dim>
    const std::shared_ptr<const LevelSet<dim>> &table() const
    {
      return std::get<dim - 2>(tables);
    }

    /// Sets table().
    template <int dim>
    void set_table(const std::shared_ptr<const LevelSet<dim>> &table)
    {
      std::get<dim - 2>(tables) = table;
    }

  private:
    void add_level_parameters(dealii::ParameterHandler &prm)
    {
      prm.add_parameter(
          "Phreatic surface",
          phreatic_surface,
          "m; elevation of the water table, an expression of x (3D: x, y). The pores of soil below it are "
          "full, and there is no water outside the soil but that of \"Reservoir level\". Alternative to "
          "\"Region\". The vertical axis is y (3D: z). Empty: not given.");
      prm.add_parameter("Phreatic layer",
                        phreatic_layer,
                        "2D. Layer of \"Drawing\" whose polyline is the water table, in place of \"Phreatic surface\". "
                        "Beyond its ends it is level. Empty: not given.");
      prm.add_parameter(
          "Reservoir level",
          reservoir_level,
          "m; elevation of free water outside the soil, an expression of x (3D: x, y), such as if(x < 20, "
          "8, 0.5). Without \"Phreatic surface\" it also fills the pores below it. Empty: no free water.");
      prm.add_parameter(
          "Steady seepage",
          is_steady,
          "Whether the pore pressure at the start is that of steady flow through the soil, with a free "
          "surface, between the heads of \"Reservoir level\" and \"Heads at walls\". Pores are full where "
          "it is not negative. Water leaves through faces in air. Alternative to \"Phreatic surface\".");
      prm.add_parameter(
          "Heads at walls",
          wall_heads,
          "m; elevations of the water table at walls of the box for \"Steady seepage\", such as Left: 12, "
          "Right: 4. They hold at the start only; in the run the wall is as in subsection "
          "Boundaries/Water. Empty: none.");
    }
    void add_drag_parameters(dealii::ParameterHandler &prm);

    /// Alone it gives the drag.
    void check_grain_diameter() const
    {
      const std::string grains = "\"Grain diameter\" = " + number_text(grain_diameter);
      require_entry(conductivity_text == "auto",
                    { "Water", "Hydraulic conductivity", conductivity_text },
                    "the drag follows from " + grains + ". Remove one of the two.");
      require_entry(viscosity > 0,
                    { "Water", "Viscosity", viscosity },
                    "the drag of grains of " + grains +
                        " needs it. Write 1e-3 for water, or \"Hydraulic conductivity\" in place of the diameter.");
      require_entry(conductivity_law == WaterParameters().conductivity_law,
                    { "Water", "Conductivity law", conductivity_law },
                    "the drag follows from " + grains + ". Remove one of the two.");
    }
    void check_air_entry(const unsigned int n_bodies) const
    {
      const auto require = [&](const bool possible, const std::string &remedy) {
        require_entry(possible, { "Water", "Air entry pressure", air_entry_pressure }, remedy);
      };
      require(n_bodies > 0, "this entry has no effect, as there is no soil: entry \"Bodies\" is none. Remove it.");
      require(point_sets_kind() == PointSets::double_point,
              "single-point water does not leave the soil, and no air enters it. Remove the entry, or write "
              "\"Point sets = double\".");
      require(
          !is_steady,
          "the pores above the water table of \"Steady seepage\" would not be full. Remove one of the two entries, or "
          "write the elevation as \"Phreatic surface\".");
    }
    void check_single_point() const;
    void check_without_soil() const
    {
      const WaterParameters defaults;
      const std::string remedy = "this entry has no effect, as there is no soil: entry \"Bodies\" is none. Remove it.";
      require_entry(conductivity_text == "auto", { "Water", "Hydraulic conductivity", conductivity_text }, remedy);
      require_entry(
          conductivity_law == defaults.conductivity_law, { "Water", "Conductivity law", conductivity_law }, remedy);
      require_entry(grain_diameter == defaults.grain_diameter, { "Water", "Grain diameter", grain_diameter }, remedy);
    }
    void check_levels(const std::vector<double> &gravity, const unsigned int n_bodies) const;
    void check_seepage(const unsigned int n_bodies) const;

    std::tuple<std::shared_ptr<const LevelSet<2>>, std::shared_ptr<const LevelSet<3>>> tables;
  };
} // namespace scree

#endif
