// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_postprocess_columns_h
#define scree_postprocess_columns_h

#include <scree/mesh/background_grid.h>
#include <scree/bodies/soil_body.h>
#include <scree/bodies/water_phase.h>

#include <deal.II/base/point.h>

#include <array>
#include <list>
#include <utility>
#include <vector>

namespace scree
{
  /// The columns of the mesh's fine cells along the last axis, along x first.
  template <int dim>
  class CellColumns
  {
  public:
    /// Keeps a reference to the grid.
    explicit CellColumns(const BackgroundGrid<dim> &grid);

    /// Their number.
    std::size_t size() const;

    /// Area of each, m^2 (2D: width, m).
    double area() const;

    /// The middle of a column, with 0 as its last coordinate, m.
    dealii::Point<dim> middle(const std::size_t column) const;

    /// The columns around a place and their weights, 1 - |distance|/(cell size) along each axis; what would fall to
    /// columns outside the box counts for those at its edge, so that the weights' sum is 1.
    std::array<std::pair<std::size_t, double>, (1 << (dim - 1))> around(const dealii::Point<dim> &x) const;

    /// Cells along each axis.
    const std::array<std::size_t, dim> &n_cells() const
    {
      return n;
    }

  private:
    const BackgroundGrid<dim> &grid;
    std::array<std::size_t, dim> n;
  };

  /// A piece of material around a point: its place, m, and volume with pores, m^3 (2D: per m).
  template <int dim>
  struct Lump
  {
    dealii::Point<dim> location; ///< its centre, m
    double volume;               ///< volume with pores, m^3 (2D: per m)
  };

  /// This rank's points as lumps: of soil, or of water with the share of the pores around that it fills.
  template <int dim>
  std::vector<Lump<dim>> lumps_of(const std::list<SoilBody<dim>> &bodies);

  /// The same of the water.
  template <int dim>
  std::vector<Lump<dim>> lumps_of(const std::list<SoilBody<dim>> &bodies,
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
  std::vector<GroundColumn> ground_columns(const std::vector<Lump<dim>> &lumps,
                                           const std::vector<std::vector<double>> &places,
                                           const BackgroundGrid<dim> &grid);

  /// The smallest and the largest x at which the thickness, volume over area of columns of cells, falls to `threshold`,
  /// m: linear between the columns' centres; of all y in 3D. nan if it is nowhere as thick. Collective.
  template <int dim>
  std::pair<double, double>
  rear_and_front(const std::vector<Lump<dim>> &lumps, const double threshold, const BackgroundGrid<dim> &grid);
} // namespace scree

#endif
