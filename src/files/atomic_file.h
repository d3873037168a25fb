#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace quasimc {

/// A file that appears under its name only when it is complete. Until then (and after an exception,
/// a signal, a full disk) an existing file at its path is unchanged. Standard output ("-"), pipes
/// and devices are written directly.
class AtomicFile {
  public:
    /// @throws InputError  if the file can't be written, or is a pipe without a reader
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// @throws InputError  if the bytes can't be written (full disk)
    void write(std::string_view bytes);
    /// Flushes the file to the disk, under a temporary name in its directory. Must be the last
    /// write. @throws InputError
    void prepare();
    /// Gives a prepared file its name. At most once. @throws InputError
    void take_name();
    /// Flushes the directory entry to the disk, if the file system can.
    void sync_name() const;
    /// Calls prepare(), take_name() and sync_name().
    void commit();

  private:
    [[noreturn]] void fail() const;
    void open_straight();
    void open_unnamed(const std::filesystem::path& folder);
    void open_named(const std::filesystem::path& folder);
    void name_temporary();

    std::filesystem::path path_;
    std::filesystem::path temporary_;  // empty if the file has no name yet, or is written directly
    std::FILE* file_ = nullptr;
    bool straight_ = false;
};

}  // namespace quasimc
