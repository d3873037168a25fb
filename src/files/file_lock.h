#pragma once

#include <memory>
#include <string>

#include "files/descriptor.h"

namespace quasimc {

/// Restricts a file to one process at a time, by a lock on a file beside it (its name and ".lock"),
/// which names the owner and is removed at the end. The system releases the lock when the owner
/// ends; a leftover file does no harm.
class FileLock {
  public:
    /// @param path  of the file to restrict; it may be missing
    /// @throws InputError  if another process has it, with its name, or if the lock file can't be
    ///         written. File systems without locks are not protected.
    explicit FileLock(const std::string& path);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

  private:
    std::string name_;
    std::unique_ptr<Descriptor> file_;
};

}  // namespace quasimc
