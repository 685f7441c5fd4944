// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_checkpoint_files_h
#define scree_io_checkpoint_files_h

#include <cstdint>
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
} // namespace scree

#endif
