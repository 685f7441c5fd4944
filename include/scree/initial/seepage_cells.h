// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_initial_seepage_cells_h
#define scree_initial_seepage_cells_h

#include <scree/bodies/water_parameters.h>
#include <scree/boundary/water_walls.h>
#include <scree/mesh/background_grid.h>
#include <scree/seeding/seeding.h>

#include <array>
#include <optional>
#include <vector>

namespace scree
{
  /// A cell with soil, divided into equal parts.
  template <int dim>
  struct SeepageCell
  {
    static constexpr unsigned int n_1d    = dim == 2 ? 4 : 3;                  ///< parts along an axis
    static constexpr unsigned int n_parts = dealii::Utilities::pow(n_1d, dim); ///< parts of a cell

    unsigned int index;                       ///< active cell index
    dealii::Point<dim> corner;                ///< lower one, m
    std::array<double, n_parts> conductivity; ///< m/s; 0 outside the soil
  };

  /// A piece of the soil's surface that water can cross.
  template <int dim>
  struct SeepageFace
  {
    unsigned int cell;           ///< in the list of cells
    dealii::Point<dim> location; ///< m
    dealii::Point<dim> place;    ///< in the cell, from 0 to 1 along each axis
    double area;                 ///< m^2 (2D: m)
    double conductivity;         ///< of the soil, m/s
    double head;                 ///< that is given, m; NaN in air, where water only leaves
  };

  /// Properties of the soil that the flow depends on.
  struct SeepageSoil
  {
    std::vector<SoilRegion> bodies;     ///< where they are
    std::vector<double> conductivities; ///< of each, m/s; 0: no flow
  };

  /// Finds the cells with soil of this rank, and its faces, by the centres of equal parts of the cells.
  template <int dim>
  class SeepageSurvey
  {
  public:
    /// @param ground only its open holds soil; null: all
    SeepageSurvey(const BackgroundGrid<dim> &grid,
                  const SeepageSoil &soil,
                  const WaterParameters &water,
                  const WaterBoundaryConditions<dim> &walls,
                  const double unit_weight,
                  const LevelSet<dim> *ground);

    /// Appends the cells of this rank and their faces. Throws ValueError if a reservoir is higher than the box, or an
    /// expression is no number.
    void find(std::vector<SeepageCell<dim>> &cells, std::vector<SeepageFace<dim>> &faces) const;

    /// Elevation of free water at a place, m; NaN without a reservoir.
    double level(const dealii::Point<dim> &x) const;

    /// Whether a body with flow is there.
    bool is_in_soil(const dealii::Point<dim> &x) const
    {
      return kind(x) >= 0;
    }

  private:
    using Cell               = SeepageCell<dim>;
    static constexpr int air = -1, closed = -2;
    static constexpr unsigned int n_wide = Cell::n_1d + 2, n_around = dealii::Utilities::pow(n_wide, dim);

    /// Number of the body at a place, or air, or closed: ground and soil without flow.
    int kind(const dealii::Point<dim> &x) const;

    /// The kinds at the centres of the parts of a cell and one part around it. False: no soil is in the cell.
    bool look_at(const dealii::Point<dim> &corner, std::array<int, n_around> &kinds) const;

    /// Appends the faces in air of a cell.
    void add_free_faces(const std::array<int, n_around> &kinds,
                        const dealii::Point<dim> &corner,
                        const unsigned int cell,
                        std::vector<SeepageFace<dim>> &faces) const;

    /// Appends the faces of a cell at walls of the box with a head, or drained.
    void add_faces_at_walls(const std::array<int, n_around> &kinds,
                            const dealii::Point<dim> &corner,
                            const unsigned int cell,
                            std::vector<SeepageFace<dim>> &faces) const;

    /// The head of a wall at a height of it; nothing if it is closed there.
    std::optional<double> head_of_wall(const unsigned int face, const double height) const;

    /// Whether a place is beyond this face of the box.
    bool is_beyond(const dealii::Point<dim> &x, const unsigned int face) const;

    const BackgroundGrid<dim> &grid;
    const WaterBoundaryConditions<dim> &walls;
    const LevelSet<dim> *ground;
    const double unit_weight; // of water, N/m^3
    const std::vector<double> heads;
    std::vector<Region<dim>> regions;
    std::vector<double> conductivities;
    std::unique_ptr<Expression<dim>> reservoir;
    const std::string reservoir_text;
  };
} // namespace scree

#endif
