// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_output_checkpoint_h
#define scree_output_checkpoint_h

#include <scree/grid/background_grid.h>
#include <scree/points/phase.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <functional>
#include <list>
#include <string>

namespace scree
{
  /// Writes mesh, points and `state` to the folder `checkpoint` of the run. The older checkpoint stays valid until this
  /// one is whole: the file `latest` names the newest. Collective.
  template <int dim>
  void save_checkpoint(const std::string &run_folder,
                       const BackgroundGrid<dim> &grid,
                       std::list<Phase<dim>> &phases,
                       const std::function<void(boost::archive::binary_oarchive &)> &state);

  /// Reads the newest checkpoint, on any number of ranks. The grid must be fresh and the phases empty. Collective;
  /// throws EntryError if there is no checkpoint.
  template <int dim>
  void load_checkpoint(const std::string &run_folder,
                       BackgroundGrid<dim> &grid,
                       std::list<Phase<dim>> &phases,
                       const std::function<void(boost::archive::binary_iarchive &)> &state);
} // namespace scree

#endif
