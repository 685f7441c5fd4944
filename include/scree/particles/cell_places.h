// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_cell_places_h
#define scree_particles_cell_places_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace scree
{
  /// Numbers of a cell along the axes of the box, from 0.
  template <int dim>
  using CellPlace = std::array<int, dim>;

  /// The number of a place on the curve that halves the box again and again (@source{morton1966}), as p4est's does: an
  /// aligned cube of 2^s places an axis has 2^(dim s) successive numbers. No coordinate may be negative or above 2^20.
  template <int dim>
  std::uint64_t curve_number(const CellPlace<dim> &place);

  /// The place with this number.
  template <int dim>
  CellPlace<dim> curve_place(const std::uint64_t number);

  /// The equal cubes that a box is made of.
  template <int dim>
  struct CellsOfBox
  {
    dealii::Point<dim> lower; ///< corner, m
    double width;             ///< of a cell, m
    CellPlace<dim> n;         ///< cells along each axis

    /// The cell whose lower corner is `corner`.
    CellPlace<dim> place_of_corner(const dealii::Point<dim> &corner) const
    {
      CellPlace<dim> place;
      for (unsigned int a = 0; a < dim; ++a)
        place[a] = static_cast<int>(std::lround((corner[a] - lower[a]) / width));
      return place;
    }

    /// The cell of the box that is nearest to a point.
    CellPlace<dim> place_near(const dealii::Point<dim> &x) const
    {
      CellPlace<dim> place;
      for (unsigned int a = 0; a < dim; ++a)
        place[a] = static_cast<int>(std::min(std::max((x[a] - lower[a]) / width, 0.), n[a] - 1.));
      return place;
    }

    /// Lower corner of a cell, m.
    dealii::Point<dim> corner(const CellPlace<dim> &place) const
    {
      dealii::Point<dim> corner = lower;
      for (unsigned int a = 0; a < dim; ++a)
        corner[a] += place[a] * width;
      return corner;
    }

    /// Whether the box has a cell at this place.
    bool contains(const CellPlace<dim> &place) const
    {
      bool inside = true;
      for (unsigned int a = 0; a < dim; ++a)
        inside = inside && place[a] >= 0 && place[a] < n[a];
      return inside;
    }

    /// Blocks of 2^dim cells along each axis.
    CellPlace<dim> n_blocks() const
    {
      CellPlace<dim> blocks;
      for (unsigned int a = 0; a < dim; ++a)
        blocks[a] = (n[a] + 1) / 2;
      return blocks;
    }

    /// Number of cells; a double, as it may exceed an unsigned int.
    double n_cells() const
    {
      double product = 1;
      for (const int along : n)
        product *= along;
      return product;
    }
  };

  /// Blocks of 2^dim cells, by the curve numbers of their places: ascending, each once. What p4est divides or not.
  using Blocks = std::vector<std::uint64_t>;

  /// Sorts them and drops those that stand there twice.
  void make_unique(Blocks &blocks);

  /// The union of all ranks' blocks. Collective.
  Blocks all_blocks(const Blocks &own, const MPI_Comm communicator);

  /// Adds the blocks up to `margin` blocks away, of at most `n` along each axis.
  template <int dim>
  Blocks with_margin(const Blocks &blocks, const unsigned int margin, const CellPlace<dim> &n);

  /// Whether one of them is among the `n` from number `first` on.
  bool has_any(const Blocks &blocks, const std::uint64_t first, const std::uint64_t n);

  /// What a cell of the mesh is for. A cell keeps this as its user index: those of a mesh of equal cells are inner.
  enum class CellUse : unsigned int
  {
    inner,  ///< of the finest size, as all its neighbours in the box are
    edge,   ///< of the finest size, beside a larger one: a point that gets there makes the fine part grow
    coarse, ///< larger, without nodes
    outside ///< beyond the walls of the box, which need not fill the mesh
  };

  /// Use of a cell of this rank or a ghost, as FineCells::reinit() has set it.
  template <typename Cell>
  CellUse use_of(const Cell &cell)
  {
    return static_cast<CellUse>(cell->user_index());
  }

  /// Whether nodes act on the cell: it is a fine one.
  template <typename Cell>
  bool holds_nodes(const Cell &cell)
  {
    return use_of(cell) <= CellUse::edge;
  }
} // namespace scree

#endif
