#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace quasimc {

/// A file that is about to get its name.
struct PendingName {
    std::filesystem::path temporary, target;
};

/// What is to be done so that several files get their names together, in a hidden file beside the
/// last of them: if the program is killed on the way, finish_commits() does the rest. It is there
/// as long as the object, and locked.
class CommitRecord {
  public:
    /// Brings it to the disk. Where it can't be written there is none: the names are then as safe
    /// as without. @param names  of files that are on the disk
    explicit CommitRecord(std::span<const PendingName> names);
    ~CommitRecord();
    CommitRecord(const CommitRecord&) = delete;
    CommitRecord& operator=(const CommitRecord&) = delete;

  private:
    int descriptor_ = -1;
    std::filesystem::path path_;  // empty if there is none
};

/// Finishes what programs that were killed left half done: the outputs of which one is among these.
/// A target that is no longer what it was stays; its new content is dropped. Records of programs
/// that still run are left alone.
void finish_commits(const std::vector<std::filesystem::path>& outputs);

}  // namespace quasimc
