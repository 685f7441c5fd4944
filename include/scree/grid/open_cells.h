// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_grid_open_cells_h
#define scree_grid_open_cells_h

#include <scree/geometry/open_part.h>
#include <scree/grid/sampled_surface.h>

#include <algorithm>

namespace scree
{
  /// What rigid ground leaves open of a cell, and the ground in it. The ground is plane in each simplex of the cell
  /// (Kuhn's), between distances at the corners.
  template <int dim>
  struct CutCell
  {
    static constexpr unsigned int n_corners = 1 << dim;
    static constexpr unsigned int n_gauss   = 4; // an axis: Lagrange's cubics through them span what is integrated
    static constexpr unsigned int n_points  = dealii::Utilities::pow(n_gauss, dim);
    using AtCorners                         = std::array<double, n_corners>;

    unsigned int cell    = 0;  ///< active cell index
    double open_fraction = 0.; ///< of the volume
    /// Of the Gauss points of the whole cell (first axis fastest), over its volume: they integrate polynomials of third
    /// degree an axis exactly over the open part. Some are negative.
    std::array<double, n_points> weights{};
    AtCorners open_hats{}; ///< integrals of the corners' linear functions over the open part, over the cell's volume

    double area = 0.;              ///< of the ground: what its normals add up to, m^(dim-1)
    dealii::Tensor<1, dim> normal; ///< unit, mean over the ground, out of the open
    AtCorners ground_hats{};       ///< means of the linear functions over the ground
    std::vector<double> shapes;    ///< the same of the velocity's functions; empty without ground
  };

  /// The cells of this rank that are not all open: cut by rigid ground, beside it, or below it.
  template <int dim>
  class OpenCells
  {
  public:
    /// Both are kept by reference.
    OpenCells(const BackgroundGrid<dim> &grid, const SampledSurface<dim> &surface);

    /// Looks at the cells anew, after the surface has.
    void reinit();

    /// What the ground does to a cell; null if that is all open and has none on its faces.
    const CutCell<dim> *find(const unsigned int cell) const
    {
      const unsigned int entry = entry_of_cell[cell];
      return entry == none ? nullptr : &cut_cells[entry];
    }

    /// Part of a cell that is open: at least so much that what has got into a closed one fills it.
    double open_fraction(const unsigned int cell) const
    {
      const CutCell<dim> *cut = find(cell);
      return cut == nullptr ? 1. : std::max(cut->open_fraction, smallest);
    }

    const std::vector<CutCell<dim>> &cells() const
    {
      return cut_cells;
    }

    /// The Gauss points of CutCell::weights along an axis.
    static std::array<double, CutCell<dim>::n_gauss> gauss_points();

    static constexpr double smallest = 1e-9;

  private:
    static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    void integrate_open_part(const std::vector<Simplex<dim>> &simplices, CutCell<dim> &cut) const;
    void integrate_ground(const std::vector<Simplex<dim>> &simplices, CutCell<dim> &cut) const;

    const BackgroundGrid<dim> &grid;
    const SampledSurface<dim> &surface;
    std::vector<unsigned int> entry_of_cell; // by active cell index
    std::vector<CutCell<dim>> cut_cells;
  };
} // namespace scree

#endif
