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
    /// @throws InputError  if the file can't be written there
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// @throws InputError  if the bytes can't be written (full disk)
    void write(std::string_view bytes);
    /// Gives the file its name. At most once, nothing is written after it. @throws InputError
    void commit();

  private:
    [[noreturn]] void fail() const;
    void open_unnamed(const std::filesystem::path& folder);
    void open_named(const std::filesystem::path& folder);

    std::filesystem::path path_;
    std::filesystem::path temporary_;  // empty if the file has no name yet, or is written straight
    std::FILE* file_ = nullptr;
    bool straight_ = false;
};

}  // namespace quasimc
