// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_seeding_seeding_h
#define scree_seeding_seeding_h

#include <scree/bodies/phases.h>

namespace scree
{
  /// Unit weights of a soil, and what else its subsection says of grains and pores.
  struct UnitWeights
  {
    double dry             = 0,     ///< N/m^3; 0: not given
        saturated          = 0;     ///< N/m^3; 0: not given
    double grain_density   = 0;     ///< kg/m^3, of the entry or its default
    bool has_grain_density = false; ///< whether the file has the entry
    std::optional<double> porosity; ///< of the entry or of the law
  };

  /// Density of the grains, kg/m^3, and volume of pores over total volume.
  struct GrainsAndPores
  {
    double grain_density, ///< kg/m^3
        porosity;         ///< -
  };

  /// The grains and pores that have these unit weights: dry (1 - n) rho_s g, saturated (1 - n) rho_s g + n rho_w g.
  /// Throws EntryError if there are none, or if they contradict another entry of the body.
  /// @param body name of the subsection
  /// @param gravity m/s^2
  /// @param water_density kg/m^3
  GrainsAndPores
  grains_and_pores(const std::string &body, const UnitWeights &given, const double gravity, const double water_density);

  /// Where a body is and how densely it is filled with points.
  struct SeedingParameters
  {
    std::string region = "0";             ///< expression; true where the body is
    SourceMapParameters source;           ///< maps that bound the region, too
    std::shared_ptr<const SourceMap> map; ///< of them, once they are read; null without
    unsigned int points_per_cell = 3;     ///< along each axis
    double grain_density         = 2500;  ///< kg/m^3
    double initial_porosity      = -1;    ///< below 0: as the law says
    std::string initial_velocity = "";    ///< m/s, one expression an axis; empty: at rest
    bool is_fed                  = false; ///< whether an inflow brings points, so that there may be none at the start
    double dry_unit_weight       = 0;     ///< N/m^3; 0: not given
    double saturated_unit_weight = 0;     ///< N/m^3; 0: not given

    /// Declares the entries in the body's subsection.
    void add_parameters(dealii::ParameterHandler &prm);

    /// Throws EntryError if an expression does not read; `body` is the name of the subsection.
    void check(const std::string &body, const unsigned int dim) const;

    /// Whether an expression bounds the body.
    bool has_expression() const
    {
      return region != SeedingParameters().region;
    }

    /// The expression of the region; true everywhere if maps alone bound the body.
    std::string expression() const
    {
      return !has_expression() && source.is_set() ? "1" : region;
    }

    /// Entry and value that place the body, for messages.
    std::pair<std::string, std::string> place() const
    {
      const bool by_maps = source.is_set() && !(has_expression() && source.first().first == "Outline");
      return by_maps ? source.first() : std::make_pair(std::string("Region"), region);
    }

    /// Whether unit weights say how heavy it is.
    bool has_unit_weights() const
    {
      return dry_unit_weight > 0 || saturated_unit_weight > 0;
    }
  };

  /// Where a body of soil is at the start, and what water finds there.
  struct SoilRegion
  {
    std::string name;                               ///< of the body
    std::string region;                             ///< expression
    double porosity;                                ///< volume of pores over total volume
    double bulk_density;                            ///< dry, kg/m^3
    std::shared_ptr<const SourceMap> map = nullptr; ///< that bounds it, too; null without

    /// The region as a function of place.
    template <int dim>
    Region<dim> places() const
    {
      return Region<dim>(entry_name(name, "Region"), region, map);
    }

    /// Entry and value, for messages.
    std::pair<std::string, std::string> entry() const
    {
      return map ? map->entry : std::make_pair(std::string("Region"), region);
    }
  };

  /// Where points may be.
  template <int dim>
  struct Lattice
  {
    const dealii::Triangulation<dim> &triangulation; ///< with fine cells where points are to be
    const double cell_size;                          ///< of these, m
    const LevelSet<dim> *ground = nullptr;           ///< only what is in its open is filled; null: all
    const bool in_water         = false;             ///< slivers beside the ground stay: in water it has to feel them
  };

  /// Throws EntryError, with a place, if two bodies claim the same one; looks at 2 places an axis for each of
  /// `points_per_cell`. Collective.
  template <int dim>
  void
  require_apart(const std::vector<SoilRegion> &soil, const unsigned int points_per_cell, const Lattice<dim> &lattice);

  /// Fills the body's region with points: a regular lattice of `points_per_cell` an axis; at oblique edges a point
  /// stands at the centroid of the part of its cube that is inside and has its volume, and slivers join their
  /// neighbour. Points get volume, mass and velocity, and are stress-free. Collective; throws EntryError if the region
  /// holds no volume, or an expression is no number at one of the places.
  template <int dim>
  void seed(SoilBody<dim> &body, const SeedingParameters &parameters, const Lattice<dim> &lattice);

  /// Sets the gradient of an initial velocity at the points, 1/s, by differences over a cell: what the nodes see of it.
  ///
  /// @param expressions of the velocity, m/s, one an axis
  /// @param slot of the points' properties, the first of dim x dim: row c is grad v_c
  /// @param width of a cell, m
  template <int dim>
  void set_velocity_gradient(PointSet<dim> &points,
                             const std::string &expressions,
                             const unsigned int slot,
                             const double width);

  /// A part of the water's region, and how much room there is for water.
  template <int dim>
  struct WaterPart
  {
    Region<dim> region;     ///< place of the water
    double porosity;        ///< 1 outside the soil
    const SoilRegion *soil; ///< null outside
  };

  /// The water's region, cut along the surfaces of the soil. Refers to `soil`.
  template <int dim>
  std::vector<WaterPart<dim>> water_parts(const WaterParameters &parameters, const std::vector<SoilRegion> &soil);

  /// Throws EntryError unless a body in the water has pores.
  void require_pores(const SoilRegion &soil);

  /// Fills the pores of the points that carry the water: its volume is theirs less the grains', its velocity theirs.
  /// Water with points of its own: fills its region with them, on a lattice as seed() does. A point's volume is that of
  /// the water itself: porosity times the part of its cube in soil, plus the part outside; its mass is density times
  /// volume. They get the velocity of the entry; pressure is 0. Collective; throws EntryError if the region holds no
  /// volume, or covers a body without pores.
  template <int dim>
  void seed_water(WaterPhase<dim> &water,
                  const WaterParameters &parameters,
                  const std::vector<SoilRegion> &soil,
                  const Lattice<dim> &lattice);
} // namespace scree

#endif
