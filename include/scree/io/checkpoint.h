// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_checkpoint_h
#define scree_io_checkpoint_h

#include <scree/input/case_entries.h>
#include <scree/io/files.h>
#include <scree/mesh/background_grid.h>
#include <scree/particles/point_set.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

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

  /// What a file of this content is.
  CheckedFile checked_file(const std::string &name, const std::string &content);

  /// The content of the file, or FileError unless it has its size and checksum.
  std::string read_checked_file(const std::string &folder, const CheckedFile &file);

  /// The head of a checkpoint: what it is, who wrote it, and the files that belong to it. Written last, as the file
  /// `manifest`, under a checksum of its own.
  struct Manifest
  {
    std::string program;            ///< that wrote it
    unsigned int dimension = 0;     ///< 2 or 3
    double time            = 0;     ///< s
    std::uint64_t step     = 0;     ///< number of the time step
    std::vector<CheckedFile> files; ///< files of the checkpoint but the manifest

    /// Writes it to the folder. Throws FileError.
    void write(const std::string &folder) const;

    /// Reads that of the folder. Throws FileError if it is not whole or of another format.
    static Manifest read(const std::string &folder);

    /// The file of that name. Throws FileError if the manifest has none.
    const CheckedFile &file(const std::string &name) const;

    /// Bytes of all files.
    std::uint64_t size() const;
  };

  /// The checkpoints of a run: folders `checkpoint/step-<n>`, of which the two newest are kept, and
  /// `checkpoint/unfinished` while one is written.
  class CheckpointFolder
  {
  public:
    /// @param run_folder path; nothing is read or written yet
    explicit CheckpointFolder(const std::string &run_folder);

    /// The path of a new, empty folder for the files of a checkpoint. Throws FileError.
    std::string begin() const;

    /// Writes the manifest, reads it again, gives the checkpoint its name and removes older ones than the last.
    /// Throws FileError.
    void finish(const Manifest &manifest) const;

    /// Removes what begin() made.
    void abandon() const;

    /// The folders of all checkpoints, the newest first, whole or not.
    std::vector<std::string> all() const;

    /// Those whose files are all as they were written.
    std::vector<std::string> whole() const;

    const std::string unfinished; ///< path of the folder that is being written

  private:
    const std::string folder;
  };

  /// This rank's points, cell by cell: for each set the numbers of properties and of points; for each cell its id and
  /// the number of its points; for each point its id, location, reference location and properties.
  template <int dim>
  std::string pack_points(const std::vector<PointSet<dim> *> &sets);

  /// Cells of this rank, by their ids.
  template <int dim>
  using OwnCells = std::map<dealii::CellId, typename dealii::Triangulation<dim>::active_cell_iterator>;

  /// Collects the cells of this rank, without ghosts.
  template <int dim>
  OwnCells<dim> own_cells(const dealii::Triangulation<dim> &mesh);

  /// Inserts the points of `cells` into the set; returns how many points the file has of it.
  template <int dim>
  std::uint64_t unpack_points(ByteReader &file, const OwnCells<dim> &cells, PointSet<dim> &points);

  /// A whole checkpoint of a run.
  struct Checkpoint
  {
    std::string folder;  ///< path of its folder
    Manifest manifest;   ///< its files and their checksums
    CaseEntries entries; ///< of the case that wrote it
  };

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
                           const std::function<void(boost::archive::binary_oarchive &)> &state);

  /// The newest checkpoint of the run that is whole; `log` gets a line for each newer one that is not. Collective;
  /// throws EntryError if there is none.
  Checkpoint find_checkpoint(const std::string &run_folder,
                             const std::function<void(const std::string &)> &log,
                             const MPI_Comm communicator);

  /// Reads a checkpoint, on any number of ranks. The grid must be of the same box; it gets the fine cells of then. The
  /// sets, in the order in which they were saved, lose the points they have. Collective; throws
  /// EntryError if the files do not fit.
  template <int dim>
  void load_checkpoint(const Checkpoint &checkpoint,
                       BackgroundGrid<dim> &grid,
                       const std::vector<PointSet<dim> *> &sets,
                       const std::function<void(boost::archive::binary_iarchive &)> &state);
} // namespace scree

#endif
