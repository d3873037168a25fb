#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

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
    /// Writes all of the file to the disk, under a temporary name in its directory. Nothing is
    /// written after it. @throws InputError
    void prepare();
    /// Gives a prepared file its name. At most once. @throws InputError
    void take_name();
    /// Brings the name to the disk, as far as the file system can.
    void sync_name() const;
    /// All three.
    void commit();

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
