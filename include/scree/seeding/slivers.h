// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_seeding_slivers_h
#define scree_seeding_slivers_h

#include <scree/geometry/level_set.h>
#include <scree/particles/lattice.h>

#include <vector>

namespace scree
{
  /// Lets slivers stay that are less than a cell's diameter from the ground: in water it has to feel them.
  /// @param ground null: none
  template <int dim>
  void keep_slivers_at(const LevelSet<dim> *ground, std::vector<Seed<dim>> &seeds);

  /// Seeds that fill less than a quarter of a cube, alone in their cells, join others of the cells around theirs (those
  /// that share a face, an edge or a corner), but for those that stay. Beside a fuller seed they join the nearest one,
  /// and take those with them that have no fuller seed but them beside theirs. Elsewhere, as in a sheet that is thin
  /// everywhere, they gather in the one that fills most of its surroundings. A seed that others join moves towards the
  /// common centroid, as far as its cell goes, and no nearer to the ground than both were. So volume is kept, and a
  /// sliver is left only where all that is within a cell of it is one. The same on any number of ranks. Collective.
  /// @param ground null: none
  template <int dim>
  void join_slivers(const dealii::Triangulation<dim> &triangulation,
                    const LevelSet<dim> *ground,
                    std::vector<Seed<dim>> &seeds);
} // namespace scree

#endif
