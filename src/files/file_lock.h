#pragma once

#include <memory>
#include <string>

#include "files/descriptor.h"

namespace quasimc {

/// Keeps a file to one process at a time. The lock is of a file beside it (its name and ".lock"),
/// which names the owner and is removed at the end; the system gives it up when the owner dies, in
/// whatever way, and a file that is left over hinders nobody.
class FileLock {
  public:
    /// @param path  of the file to keep; it need not be there
    /// @throws InputError  if another process has it, who that is, or if the file of the lock can't
    ///         be written. Where the file system knows no locks, there is none.
    explicit FileLock(const std::string& path);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

  private:
    std::string name_;
    std::unique_ptr<Descriptor> file_;
};

}  // namespace quasimc
