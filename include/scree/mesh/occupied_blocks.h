// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mesh_occupied_blocks_h
#define scree_mesh_occupied_blocks_h

#include <scree/particles/cell_places.h>

#include <functional>

namespace scree
{
  /// Where points are to be put, for who looks for them in a box.
  template <int dim>
  struct PlacesOfPoints
  {
    /// Whether any are put in the cell with this lower corner, m.
    std::function<bool(const dealii::Point<dim> &corner)> in_cell;

    /// Whether the place x, m, of that cell shows that they are.
    std::function<bool(const dealii::Point<dim> &corner, const dealii::Point<dim> &x)> at_place;

    /// Places that in_cell() looks at.
    unsigned int n_places_of_cell;
  };

  /// Blocks of all ranks with cells in which points are put. All cells are looked at closely if these are few; else
  /// each at one place or some, spread evenly over cell and box, and closely only cells near those where that finds
  /// points: a part is missed only if no larger than a cell or so, and on its own. Throws on all ranks what `places`
  /// throws. Collective.
  template <int dim>
  Blocks occupied_blocks(const CellsOfBox<dim> &box, const PlacesOfPoints<dim> &places, const MPI_Comm communicator);
} // namespace scree

#endif
