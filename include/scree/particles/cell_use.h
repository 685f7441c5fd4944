// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_particles_cell_use_h
#define scree_particles_cell_use_h

namespace scree
{
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
