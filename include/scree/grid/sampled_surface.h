// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_grid_sampled_surface_h
#define scree_grid_sampled_surface_h

#include <scree/geometry/level_set.h>
#include <scree/grid/background_grid.h>

#include <array>
#include <limits>
#include <vector>

namespace scree
{
  /// A rigid surface as this rank's fine cells near it see it: distance and normal at their corners, multilinear
  /// between. The normals are those of the corners and not the gradient of the distance, which jumps between cells.
  template <int dim>
  class SampledSurface
  {
  public:
    /// Both are kept by reference.
    SampledSurface(const BackgroundGrid<dim> &grid, const LevelSet<dim> &surface);

    /// Looks at the surface from the grid's current cells. Collective; throws EntryError if an expression is no number
    /// at one of the corners.
    void reinit();

    /// How far from the surface cells are near, m.
    double reach() const
    {
      // A point crosses a cell in a step at most, and touches from less than a cell away.
      return 3. * grid.cell_size();
    }

    /// Whether a cell is within some cells of the surface, so that the other functions may be asked.
    bool is_near(const unsigned int cell) const
    {
      return entry_of_cell[cell] != none;
    }

    /// The smallest distance of a cell's corners, m: none of its places is nearer. Infinite if it is not near.
    double least_distance(const unsigned int cell) const
    {
      return is_near(cell) ? least[entry_of_cell[cell]] : std::numeric_limits<double>::infinity();
    }

    /// The surface from a place (from 0 to 1) in a near cell.
    SurfaceView<dim> view(const unsigned int cell, const dealii::Point<dim> &place) const;

  private:
    static constexpr unsigned int n_corners = 1u << dim;
    static constexpr unsigned int none      = dealii::numbers::invalid_unsigned_int;
    using Corners                           = std::array<SurfaceView<dim>, n_corners>;

    void sample();

    const BackgroundGrid<dim> &grid;
    const LevelSet<dim> &surface;
    std::vector<unsigned int> entry_of_cell; // by active cell index
    std::vector<Corners> corners;            // of the near cells
    std::vector<double> least;
  };
} // namespace scree

#endif
