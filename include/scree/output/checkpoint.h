// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_output_checkpoint_h
#define scree_output_checkpoint_h

#include <scree/grid/background_grid.h>
#include <scree/points/point_set.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <functional>
#include <string>
#include <vector>

namespace scree
{
  /// Writes mesh, the points of all `sets` and `state` to the folder `checkpoint` of the run. The older checkpoint
  /// stays valid until this one is whole: the file `latest` names the newest. Collective.
  template <int dim>
  void save_checkpoint(const std::string &run_folder,
                       const BackgroundGrid<dim> &grid,
                       const std::vector<PointSet<dim> *> &sets,
                       const std::function<void(boost::archive::binary_oarchive &)> &state);

  /// Reads the newest checkpoint, on any number of ranks. The grid must be fresh, and the sets empty and in the
  /// order in which they were saved. Collective; throws EntryError if there is no checkpoint.
  template <int dim>
  void load_checkpoint(const std::string &run_folder,
                       BackgroundGrid<dim> &grid,
                       const std::vector<PointSet<dim> *> &sets,
                       const std::function<void(boost::archive::binary_iarchive &)> &state);
} // namespace scree

#endif
