// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_io_folder_lock_h
#define scree_io_folder_lock_h

#include <string>

namespace scree
{
  /// A file that says which run writes to a folder: host, process, start of the process, date. It is there as long as
  /// this lives; that of a process that has died is recognised and replaced.
  class FolderLock
  {
  public:
    /// Takes the lock, if no other process has it.
    explicit FolderLock(const std::string &file);
    ~FolderLock();
    FolderLock(const FolderLock &)            = delete;
    FolderLock &operator=(const FolderLock &) = delete;

    /// Who has the lock and what to do, in words; empty if this has it.
    const std::string &refusal() const
    {
      return why_not;
    }

    /// The process whose lock was replaced, in words; empty if there was none.
    const std::string &dead_owner() const
    {
      return replaced;
    }

  private:
    bool make();

    const std::string file, text;
    std::string why_not, replaced;
  };
} // namespace scree

#endif
