// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_bodies_water_parameters_h
#define scree_bodies_water_parameters_h

#include <scree/geometry/level_set.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace scree
{
  /// Subsection Pressure of subsection Water.
  struct PressureParameters
  {
    double relative_tolerance       = 1e-4; ///< of the residual, over the larger of |b| and |S p|
    unsigned int maximum_iterations = 500;  ///< the run ends with an error beyond them
    double cavitation_pressure      = -1e5; ///< Pa

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);
  };

  /// Entries of subsection Water for a start from steady seepage.
  struct SeepageStart
  {
    bool is_steady         = false; ///< whether the pressure in soil is that of steady flow
    std::string wall_heads = "";    ///< `Left: 12, Right: 4`, m; empty: none

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations with other entries of subsection Water.
    /// @param phreatic entry and value of a phreatic surface; empty: not given
    void check(const unsigned int n_bodies,
               const std::pair<std::string, std::string> &phreatic,
               const std::string &reservoir_level,
               const std::string &initial_pressure) const;

    /// Throws EntryError if a head at a wall is not in the box.
    void check_heads(const std::vector<double> &lower, const std::vector<double> &upper) const;

    /// Names of walls and heads, m. Throws EntryError if the text does not read.
    std::vector<std::pair<std::string, double>> heads() const;
  };

  /// How points carry soil and water.
  enum class PointSets
  {
    double_point, ///< water has points of its own
    single_point  ///< water rides on the soil's points
  };

  /// What the water's pressure is at the start.
  enum class InitialPressure
  {
    hydrostatic, ///< the weight of the water above
    none
  };

  /// How the hydraulic conductivity follows the porosity.
  enum class ConductivityLaw
  {
    constant,     ///< k, m/s, of the entry at any porosity
    kozeny_carman ///< in proportion to n^3/(1-n)^2 (@source{carman1937})
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
    std::string reservoir_level   = "";            ///< expression of the elevation, m; empty: no reservoir
    double air_entry_pressure     = 0;             ///< suction at which air enters the soil, Pa; 0: none
    double fringe                 = 0;             ///< height above given levels up to which it fills the pores, m
    SeepageStart seepage_start;                    ///< steady flow at the start

    /// Declares the entries in the subsection that is open.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations.
    /// @param gravity m/s^2, one number an axis
    void check(const std::vector<double> &gravity, const unsigned int n_bodies) const;

    /// Entry `Point sets` as an enum.
    PointSets point_sets_kind() const;

    /// Entry `Initial pressure` as an enum.
    InitialPressure initial_pressure_kind() const;

    /// Entry `Conductivity law` as an enum.
    ConductivityLaw conductivity_law_kind() const;

    /// Whether the region is wherever soil is, and not an expression.
    bool is_where_soil_is() const;

    /// Sets `fringe` from the air entry pressure, where levels say where water is.
    /// @param gravity m/s^2
    void find_fringe(const double gravity)
    {
      if (air_entry_pressure > 0. && gravity > 0. && has_levels())
        fringe = air_entry_pressure / (density * gravity);
    }

    /// The same water with pores that are full up to the water table only.
    WaterParameters without_fringe() const
    {
      WaterParameters result = *this;
      result.fringe          = 0.;
      return result;
    }

    /// Whether a phreatic surface, a reservoir level or steady seepage say where water is, in place of the region.
    bool has_levels() const;

    /// Entry and value that place the water, for messages.
    std::pair<std::string, std::string> place() const;

    /// Where water is in pores, as an expression; a table() is asked besides.
    std::string region_in_soil(const unsigned int dim) const;

    /// Where water is outside the soil, as an expression; empty: nowhere.
    std::string region_outside(const unsigned int dim) const;

    /// What bounds the water in soil, as a surface whose open is dry: that of steady seepage once it is known. Null
    /// without.
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
    void add_level_parameters(dealii::ParameterHandler &prm);
    void add_drag_parameters(dealii::ParameterHandler &prm);
    void check_grain_diameter() const; // alone it gives the drag
    void check_air_entry(const unsigned int n_bodies) const;
    void check_single_point() const;
    void check_without_soil() const;
    void check_levels(const std::vector<double> &gravity, const unsigned int n_bodies) const;

    std::tuple<std::shared_ptr<const LevelSet<2>>, std::shared_ptr<const LevelSet<3>>> tables;
  };

  /// What a body of soil does to water that flows through it, where it differs from what subsection Water says.
  struct SeepageParameters
  {
    double conductivity = 0; ///< m/s, at the initial porosity; 0: that of subsection Water

    /// Declares the entries in the body's subsection.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError at impossible combinations; `body` is the name of the subsection.
    /// @param water null in a dry scene
    void check(const std::string &body, const WaterParameters *water) const;

    /// The entries of subsection Water, with those of the body in their place.
    WaterParameters in_place_of(const WaterParameters &water) const;
  };
} // namespace scree

#endif
