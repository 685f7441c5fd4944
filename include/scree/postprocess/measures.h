// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_measures_h
#define scree_postprocess_measures_h

#include <scree/bodies/phases.h>
#include <scree/mesh/discrete_level_set.h>
#include <scree/step/step_report.h>

#include <list>

namespace scree
{
  /// Sums over the points of one cell (2D: per m).
  struct CellContents
  {
    unsigned int n_soil_points = 0, ///< number of points of soil
        n_water_points         = 0; ///< number of points of water
    double soil_mass           = 0; ///< kg
    double soil_volume         = 0; ///< with pores, m^3
    double grain_volume        = 0; ///< m^3
    double soil_pressure       = 0; ///< volume times P, J
    double water_mass          = 0; ///< kg
    double water_volume        = 0; ///< m^3

    /// Of the soil; 1 without soil.
    double porosity() const
    {
      return soil_volume > 0 ? 1. - grain_volume / soil_volume : 1.;
    }

    /// Water volume over pore volume, at most 1; without soil the whole cell, m^3, is pore.
    double saturation(const double cell_volume) const
    {
      const double pores = n_soil_points > 0 ? soil_volume - grain_volume : cell_volume;
      if (pores <= 0) // soil crushed to its grains: what water there is overflows
        return water_volume > 0 ? 1. : 0.;
      return std::min(1., water_volume / pores);
    }
  };

  /// What the cells of this rank hold, by active cell index; other ranks' cells are empty.
  template <int dim>
  std::vector<CellContents> contents_of_cells(const std::list<SoilBody<dim>> &bodies,
                                              const std::list<WaterPhase<dim>> &water,
                                              const BackgroundGrid<dim> &grid);

  /// Calls `act(body, point)` with this rank's points of the bodies that can move.
  template <int dim, typename Act>
  void for_each_moving_point(const std::list<SoilBody<dim>> &bodies, const Act &act)
  {
    for (const auto &body : bodies)
      if (!body.is_rigid)
        for_each_point(body.points, [&](const auto &point) { act(body, point); });
  }

  /// The same of the water.
  template <int dim, typename Act>
  void for_each_moving_point(const std::list<WaterPhase<dim>> &water, const Act &act)
  {
    for (const auto &part : water)
      for_each_point(part.points(), [&](const auto &point) { act(part, point); });
  }

  /// Soil that can move, and water (2D: per m). Momentum and energies are those of both together.
  template <int dim>
  struct MovingSums
  {
    double moving_mass = 0;          ///< of the soil, kg
    double water_mass  = 0;          ///< kg
    dealii::Tensor<1, dim> momentum; ///< N s
    double kinetic   = 0;            ///< of velocities and affine fields, J
    double potential = 0;            ///< of gravity, J
    double elastic   = 0;            ///< of the soil, J

    MovingSums() = default;

    /// Sums over the points of soil and of water.
    /// @param gravity m/s^2
    MovingSums(const MotionSums<dim> &soil,
               const MotionSums<dim> &water,
               const double elastic,
               const dealii::Tensor<1, dim> &gravity)
        : moving_mass(soil.mass)
        , water_mass(water.mass)
        , kinetic(soil.kinetic + water.kinetic)
        , elastic(elastic)
    {
      for (unsigned int a = 0; a < dim; ++a)
        {
          momentum[a] = soil.momentum[a] + water.momentum[a];
          potential -= gravity[a] * (soil.moment[a] + water.moment[a]);
        }
    }

    /// Lists all numbers, see NumbersOf.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &moving_mass &water_mass &momentum &kinetic &potential &elastic;
    }
  };

  /// Sums over all points of all ranks (2D: per m).
  template <int dim>
  struct PointSums : MovingSums<dim>
  {
    double soil_points      = 0; ///< number of points
    double soil_mass        = 0; ///< kg
    double pressure         = 0; ///< P of the soil, Pa, summed over points
    double largest_pressure = 0; ///< P, Pa
    double height;               ///< of the highest soil point, m; far below everything without soil
    double largest_porosity = 0; ///< of soil points

    /// Collective.
    /// @param gravity m/s^2
    PointSums(const std::list<SoilBody<dim>> &bodies,
              const std::list<WaterPhase<dim>> &water,
              const dealii::Tensor<1, dim> &gravity,
              const BackgroundGrid<dim> &grid);

  private:
    class Energies;
  };

  /// The columns of the mesh's fine cells along the last axis, along x first.
  template <int dim>
  class CellColumns
  {
  public:
    /// Keeps a reference to the grid's box.
    explicit CellColumns(const BackgroundGrid<dim> &grid)
        : box(grid.fine_cells().box())
    {
    }

    /// Their number.
    std::size_t size() const
    {
      return dim == 3 ? std::size_t(box.n[0]) * box.n[1] : box.n[0];
    }

    /// Area of each, m^2 (2D: width, m).
    double area() const
    {
      return dealii::Utilities::fixed_power<dim - 1>(box.width);
    }

    /// The middle of a column, with 0 as its last coordinate, m.
    dealii::Point<dim> middle(const std::size_t column) const
    {
      dealii::Point<dim> x;
      std::size_t rest = column;
      for (unsigned int a = 0; a + 1 < dim; ++a, rest /= box.n[a - 1])
        x[a] = box.lower[a] + (rest % box.n[a] + 0.5) * box.width;
      return x;
    }

    /// The columns around a place and their weights, 1 - |distance|/(cell size) along each axis; what would fall to
    /// columns outside the box counts for those at its edge, so that the weights' sum is 1.
    std::array<std::pair<std::size_t, double>, (1 << (dim - 1))> around(const dealii::Point<dim> &x) const;

    const CellsOfBox<dim> &box; ///< with the number of cells along each axis
  };

  /// A piece of material around a point: its place, m, and volume with pores, m^3 (2D: per m).
  template <int dim>
  struct PointVolume
  {
    dealii::Point<dim> location; ///< its centre, m
    double volume;               ///< volume with pores, m^3 (2D: per m)
  };

  /// This rank's points as lumps: of soil, or of water with the share of the pores around that it fills.
  template <int dim>
  std::vector<PointVolume<dim>> point_volumes(const std::list<SoilBody<dim>> &bodies);

  /// The same of the water.
  template <int dim>
  std::vector<PointVolume<dim>> point_volumes(const std::list<SoilBody<dim>> &bodies,
                                              const std::list<WaterPhase<dim>> &water,
                                              const BackgroundGrid<dim> &grid);

  /// What stands above a place on the ground.
  struct GroundColumn
  {
    double thickness; ///< volume over area, of lumps weighted by 1 - |distance|/(cell size) along each axis, m
    /// The tops of the highest lumps within half a cell, the mean over the quarters (2D: halves) around the place, m;
    /// nan without lumps. A lump's top is half its side above it, at most half a cell.
    double height;
  };

  /// The column at each of the places, dim - 1 coordinates, m. Collective.
  template <int dim>
  std::vector<GroundColumn> ground_columns(const std::vector<PointVolume<dim>> &lumps,
                                           const std::vector<std::vector<double>> &places,
                                           const BackgroundGrid<dim> &grid);

  /// The smallest and the largest x at which the thickness, volume over area of columns of cells, falls to `threshold`,
  /// m: linear between the columns' centres; of all y in 3D. nan if it is nowhere as thick. Collective.
  template <int dim>
  std::pair<double, double>
  rear_and_front(const std::vector<PointVolume<dim>> &lumps, const double threshold, const BackgroundGrid<dim> &grid);

  /// A mass, kg, and a number of it, such as a coordinate or a speed.
  struct PartOfMass
  {
    double place; ///< the number
    double mass;  ///< kg, or a volume, m^3
  };

  /// The numbers below which the given fractions of the mass of all ranks lie; `lower` without mass. Collective.
  /// @param lower, upper all numbers are at least the first and less than the second
  std::vector<double> percentiles(const std::vector<PartOfMass> &parts,
                                  const double lower,
                                  const double upper,
                                  const std::vector<double> &fractions,
                                  const MPI_Comm communicator);

  /// The number below which a fraction of the mass lies; 0 without mass. Collective.
  inline double percentile(const std::vector<PartOfMass> &parts, const double fraction, const MPI_Comm communicator)
  {
    std::vector<double> ends(2, std::numeric_limits<double>::lowest()); // largest number, and minus the smallest
    for (const PartOfMass &part : parts)
      ends = { std::max(ends[0], part.place), std::max(ends[1], -part.place) };
    dealii::Utilities::MPI::max(ends, communicator, ends);
    const double above = 1e-9 * std::max(std::abs(ends[0]), std::abs(ends[1]));
    return ends[0] >= -ends[1] ? percentiles(parts, -ends[1], ends[0] + above, { fraction }, communicator)[0] : 0.;
  }

  /// The x below which the given fractions of the mass of all bodies, or of the water, lie, m. Collective.
  template <int dim, template <int> class Phase>
  std::vector<double> mass_percentiles(const std::list<Phase<dim>> &phases,
                                       const BackgroundGrid<dim> &grid,
                                       const std::vector<double> &fractions)
  {
    std::vector<PartOfMass> parts;
    for_each_moving_point(phases, [&](const auto &phase, const auto &point) {
      parts.push_back({ point.location[0], point.properties[phase.layout.mass] });
    });
    return percentiles(parts, grid.lower_corner()[0], grid.upper_corner()[0], fractions, grid.communicator());
  }

  /// Oscillation of P: the rms, over the points of all bodies, of P minus a linear fit of P over the 3^dim cells around
  /// the point's cell, over the mean of |P|. 0 where the soil has no stress. Collective.
  template <int dim>
  double stress_oscillation(const std::list<SoilBody<dim>> &bodies, const BackgroundGrid<dim> &grid);

  /// The same of the pore pressure at the water points. Collective.
  template <int dim>
  double pressure_oscillation(const std::list<WaterPhase<dim>> &water, const BackgroundGrid<dim> &grid);

  /// What the statistics say of the water of all ranks (2D: per m).
  struct WaterMeasures
  {
    double n_points          = 0; ///< number of points
    double mass              = 0; ///< kg
    double mass_outside_soil = 0; ///< in cells without soil points, kg
    double smallest_pressure = 0; ///< p of points, Pa
    double largest_pressure  = 0; ///< Pa
    double tip               = 0; ///< largest x of points; the lower corner's x without points, m
    double volume_error      = 0; ///< grains and water beyond their cells' volume, over all grains and water
    double void_share        = 0; ///< volume without water in cells of free water, see doc/output.md
  };

  /// Collective.
  template <int dim>
  WaterMeasures measure_water(const std::list<SoilBody<dim>> &bodies,
                              const std::list<WaterPhase<dim>> &water,
                              const BackgroundGrid<dim> &grid);
} // namespace scree

#endif
