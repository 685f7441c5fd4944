// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_pressure_free_surface_h
#define scree_pressure_free_surface_h

#include <scree/boundary/water_walls.h>
#include <scree/pressure/pressure_parameters.h>
#include <scree/mixture/closures.h>
#include <scree/mixture/mixture.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace scree
{
  using CornerVector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// What the pressure is at a corner of the cells.
  enum class PressureDofType : char
  {
    dry,        ///< 0
    unknown,    ///< a degree of freedom
    surface,    ///< extrapolated from unknown neighbours, so that it vanishes at the surface beside the corner
    beyond,     ///< extrapolated from those of kind surface that are inside the water
    prescribed, ///< by a drained wall
  };

  /// Where the water ends: kinds of the corners, and the pressure at those beside the surface.
  ///
  /// The fill F of a corner (volume of water and wet grains under its linear function) gives its signed distance d from
  /// a surface along the cells: F = (1 + d)^2/2 outside the water, 1 - (1 - d)^2/2 inside. What gently inclined ground
  /// takes of the surroundings of free water counts as full, as it lies below its surface. Unknown are the corners at
  /// least a quarter of a cell inside. Those beside them hold p = d sum p_j / sum d_j of their unknown neighbours: p
  /// is linear and vanishes at the surface, wherever that is in the cell. At the face of soil, corners no less than
  /// half full between two unknown ones where p is not negative are unknown, too: what closes there, a gap between two
  /// bodies, has the pressure of both.
  template <int dim>
  class FreeSurfaceLocator
  {
  public:
    /// @param corners the numbering of linear functions on the grid
    /// @param gravity m/s^2
    /// @param cut_cells what rigid ground leaves of the cells; null: all
    FreeSurfaceLocator(const BackgroundGrid<dim> &grid,
                       const NodeNumbering<dim> &corners,
                       const WaterBoundaryConditions<dim> &walls,
                       const dealii::Tensor<1, dim> &gravity,
                       const CutCells<dim> *cut_cells);

    /// Fits the surface to the grid's current corners. Collective.
    void reinit();

    /// Fits it to ground that has moved, on the mesh as it was. Collective.
    void follow_ground()
    {
      find_closed();
    }

    /// Finds the surface, and fills `pressure` at the unknown corners from the mixture's points (0 elsewhere but at
    /// drained walls). Collective.
    void locate(const Mixture<dim> &mixture, CornerVector &pressure);

    /// Sets a pressure (or its change) at the corners beside the surface. Collective; ghosts hold values afterwards.
    void extrapolate(const Mixture<dim> &mixture, CornerVector &pressure);

    PressureDofType kind(const unsigned int corner) const
    {
      return kinds[corner];
    }

    /// Pressure at `surface_corner` over that at an unknown corner of the same cell, as the matrix sees it.
    double ratio(const unsigned int surface_corner, const unsigned int unknown_corner) const
    {
      return std::max(distances[surface_corner] / depth(unknown_corner, surface_corner),
                      -closures::steepest_extrapolation);
    }

    /// Volume of water under the linear function of an owned corner, m^3.
    double water_volume(const unsigned int corner) const
    {
      return filling[corner][Filling::water];
    }

    /// What the water's points forget of the pressure under the linear function of an owned corner, 0 to 1.
    double forgotten(const unsigned int corner) const
    {
      return filling[corner][Filling::weighted_forgotten] / water_volume(corner);
    }

    /// Whether no grains are under the linear function of an owned corner.
    bool is_free_water(const unsigned int corner) const
    {
      return filling[corner][Filling::filled] <= filling[corner][Filling::water] * (1. + 1e-12);
    }

    /// Fill of an owned corner's linear function, 1 if it is full of water and wet grains.
    double fill(const unsigned int corner) const
    {
      return filling[corner][Filling::filled] / volume_under(corner);
    }

    /// Integral of a corner's linear function over what is open of the box, m^3.
    double volume_under(const unsigned int corner) const;

    /// The same over a cell of this rank that has the corner as its `v`th.
    double volume_in_cell(const unsigned int cell, const unsigned int v) const;

    /// Whether a cell of this rank has an unknown corner.
    bool has_unknown(const unsigned int cell) const
    {
      const unsigned int *nodes = corners.nodes(cell);
      return std::any_of(nodes, nodes + (1 << dim), [this](const unsigned int corner) {
        return kinds[corner] == PressureDofType::unknown;
      });
    }

    /// Whether all corners of a cell of this rank are unknown.
    bool is_within(const unsigned int cell) const
    {
      const unsigned int *nodes = corners.nodes(cell);
      return std::all_of(nodes, nodes + (1 << dim), [this](const unsigned int corner) {
        return kinds[corner] == PressureDofType::unknown;
      });
    }

    /// The owned corners of cells with water.
    const std::vector<unsigned int> &wet_corners() const
    {
      return filling.active_nodes();
    }

  private:
    /// Sums over the points under a corner's linear function; the number of wet cells around it, each as far as it is
    /// open.
    enum Filling : unsigned int
    {
      water,              // m^3
      filled,             // by water and wet grains, m^3
      weighted_pressure,  // Pa m^3
      weighted_forgotten, // m^3
      wet_cells,
      by_scatter // of `filled`: grains that are wet because the scatter of points explains what water lacks, m^3
    };

    /// Of the neighbours inside the water of a corner beside the surface.
    enum Neighbours : unsigned int
    {
      number,
      sum_of_distances, // cells
      sum_of_pressures  // Pa
    };

    /// Distance of a corner from the surface that is beside its neighbour, cells. Fills near 1 tell it badly, and not
    /// at all beyond one cell: a corner deeper than its neighbour in the water is taken to be a cell deeper.
    double depth(const unsigned int corner, const unsigned int neighbour) const
    {
      const double own = distances[corner], from_neighbour = 1. + distances[neighbour];
      if (distances[neighbour] <= 0. || own < 0.5)
        return own;
      return own + std::min(4. * (own - 0.5), 1.) * std::max(from_neighbour - own, 0.);
    }

    /// Calls `act(corner, neighbour)` for the corners of a kind and those of another kind (inside the water, if they
    /// are not unknown) in the same cell, cell by cell.
    template <typename Function>
    void for_pairs(const Mixture<dim> &mixture,
                   const PressureDofType kind,
                   const PressureDofType kind_of_neighbour,
                   const Function &act) const;

    /// Integral of a corner's linear function over the box, m^3.
    double whole_volume(const unsigned int corner) const;

    /// Cells around a corner.
    unsigned int cells_in_box(const unsigned int corner) const;

    /// The same, each as far as it is open.
    double open_cells_around(const unsigned int corner) const;

    /// Finds what rigid ground takes from the corners' surroundings. Collective.
    void find_closed();

    /// The fill of a corner's linear function with what ground below free water takes of it, from that of the open
    /// part.
    double fill_with_ground(const unsigned int corner, const double fill) const;
    /// Whether all cells around a corner hold water.
    bool is_among_wet_cells(const unsigned int corner) const;
    void sum_filling(const Mixture<dim> &mixture);

    /// The pressure of a corner's points, Pa.
    double pressure_of_points(const unsigned int corner) const
    {
      return filling[corner][weighted_pressure] / filling[corner][water];
    }

    /// Makes the corners in gaps unknown. Collective.
    void close_gaps(const Mixture<dim> &mixture, CornerVector &pressure);

    /// Calls `act(corner)` for the owned corners that any rank's water may touch, and for the ghosts that this rank's
    /// water touches: for these more than once.
    template <typename Function>
    void for_all_wet_corners(const Mixture<dim> &mixture, const Function &act) const
    {
      for (const unsigned int corner : filling.active_nodes())
        act(corner);
      for (const MixtureCell<dim> &cell : mixture.cells())
        if (cell.water_volume > 0)
          for (unsigned int v = 0; v < cell.n_corners; ++v)
            if (const unsigned int corner = corners.nodes(cell.cell)[v]; corner >= corners.n_owned())
              act(corner);
    }

    const BackgroundGrid<dim> &grid;
    const NodeNumbering<dim> &corners;
    const WaterBoundaryConditions<dim> &walls;
    const dealii::Tensor<1, dim> down; // unit, or 0
    const CutCells<dim> *cut_cells;    // may be null
    NodeValues<dim, 6> filling;        // Filling
    NodeValues<dim, 3> neighbours;     // Neighbours
    NodeValues<dim, 2 * dim> sides;    // number of neighbours that press, on each side along each axis
    std::vector<PressureDofType> kinds;
    std::vector<double> distances; // cells; positive in the water

    // Without ground they are empty.
    std::vector<double> closed_volume; // under a corner's linear function, m^3
    std::vector<double> closed_cells;  // around a corner, each as far as it is closed
    std::vector<double> full_ground;   // part of a corner's linear function that lies in ground below level water
  };
} // namespace scree

#endif
