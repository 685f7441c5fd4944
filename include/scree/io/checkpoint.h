// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_checkpoint_h
#define scree_io_checkpoint_h

#include <scree/input/case_entries.h>
#include <scree/io/files.h>
#include <scree/mesh/background_grid.h>
#include <scree/particles/point_set.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

namespace scree
{
  /// One file of a checkpoint, as it was written.
  struct CheckedFile
  {
    std::string name;       ///< name in the folder of the checkpoint
    std::uint64_t size = 0, ///< bytes
        checksum       = 0; ///< CRC-64

    /// Saves or loads name, size and checksum (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &name &size &checksum;
    }
  };

  /// A whole checkpoint of a run. All of it but the points is the file `manifest`, which is written last, under a
  /// checksum of its own.
  struct Checkpoint
  {
    std::string folder;             ///< path of its folder
    std::string program;            ///< that wrote it
    unsigned int dimension = 0;     ///< 2 or 3
    double time            = 0;     ///< s
    std::uint64_t step     = 0;     ///< number of the time step
    CaseEntries entries;            ///< of the case that wrote it
    std::vector<CheckedFile> files; ///< of the ranks' points
    Blocks blocks;                  ///< of fine cells, of all ranks, if the grid follows the points
    std::string state;              ///< of the run but its points, as an archive

    /// Saves or loads all but the folder (Boost).
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      std::string text = entries.text();
      archive &program &dimension &time &step &text &files &blocks &state;
      if (Archive::is_loading::value)
        entries = CaseEntries(text);
    }
  };

  using SaveState = std::function<void(boost::archive::binary_oarchive &)>; ///< writes the state of a run
  using LoadState = std::function<void(boost::archive::binary_iarchive &)>; ///< reads it

  /// Gathers `entries`, the points of all `sets` and the `state` of a run at `time` s. The job writes them to a new
  /// checkpoint of the run, which gets its name when all of it has been read again and found whole; before that no
  /// older one is touched. If that fails, the job throws EntryError on all ranks: it names the file, what the
  /// checkpoint needs and what is still there. Collective.
  template <int dim>
  FileJob checkpoint_files(const std::string &run_folder,
                           const double time,
                           const std::uint64_t step,
                           const CaseEntries &entries,
                           const BackgroundGrid<dim> &grid,
                           const std::vector<PointSet<dim> *> &sets,
                           const SaveState &state);

  /// The newest checkpoint of the run that is whole; `log` gets a line for each newer one that is not. Collective;
  /// throws EntryError if there is none.
  Checkpoint find_checkpoint(const std::string &run_folder,
                             const std::function<void(const std::string &)> &log,
                             const MPI_Comm communicator);

  /// The folders of the checkpoints of a run whose files are all as they were written, the newest first.
  std::vector<std::string> whole_checkpoints(const std::string &run_folder);

  /// Reads a checkpoint, on any number of ranks. The grid must be of the same box; it gets the fine cells of then. The
  /// sets, in the order in which they were saved, lose the points they have. Collective; throws
  /// EntryError if the files do not fit.
  template <int dim>
  void load_checkpoint(const Checkpoint &checkpoint,
                       BackgroundGrid<dim> &grid,
                       const std::vector<PointSet<dim> *> &sets,
                       const LoadState &state);
} // namespace scree

#endif
