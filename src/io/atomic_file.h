#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/commit_record.h"

namespace quasimc {

/// A file that is there whole or not at all: it gets its name when it is done. Until then (and
/// after an exception, a signal, a full disk) whatever stood at its path stands there still. What
/// is no file ("-" for standard output, a pipe, /dev/null) is written straight.
class AtomicFile {
  public:
    /// @throws InputError  if the file can't be written there; if it is a pipe that nothing reads
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// @throws InputError  if the bytes can't be written (full disk)
    void write(std::string_view bytes);
    /// Gives the file its name. At most once, nothing is written after it. @throws InputError
    void commit();

    // The three steps of it, for files that get their names together.

    /// Brings all of the file to the disk, beside its place. Nothing is written after it.
    /// @throws InputError
    void prepare();
    /// What put_in_place() will do; nothing of what is written straight. After prepare().
    [[nodiscard]] std::optional<PendingName> pending_name() const {
        return straight_ ? std::nullopt : std::optional(PendingName{temporary_, path_});
    }
    /// Puts it in its place. After prepare(). @throws InputError
    void put_in_place();
    /// Makes the name last, as far as the file system can. After put_in_place().
    void sync_place() const;

  private:
    [[noreturn]] void fail() const;
    void open_straight();
    void open_unnamed(const std::filesystem::path& folder);
    void open_named(const std::filesystem::path& folder);
    void name_temporary();

    std::filesystem::path path_;
    std::filesystem::path temporary_;  // empty if the file has no name yet, or is written straight
    std::FILE* file_ = nullptr;
    bool straight_ = false;
};

}  // namespace quasimc
