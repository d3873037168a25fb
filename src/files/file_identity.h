#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "quasimc/error.h"

namespace quasimc {

/// Identity of the file at a path after all links: equal for two paths of one file.
struct FileIdentity {
    std::uint64_t device = 0, inode = 0;  ///< numbers of an existing file
    std::filesystem::path name = {};      ///< path of a file that does not exist yet
    bool is_regular = false;              ///< false for pipes, devices and missing files
    bool is_discard = false;              ///< /dev/null, which several outputs may share

    friend bool operator==(const FileIdentity& a, const FileIdentity& b) {
        return a.device == b.device && a.inode == b.inode && a.name == b.name;
    }
};

/// @param path  "-" is the descriptor `standard`
[[nodiscard]] FileIdentity identity_of(const std::filesystem::path& path, int standard);
/// Identity of an open file; all zero if it is not open.
[[nodiscard]] FileIdentity identity_of_descriptor(int descriptor);

/// The path at which a file would be written. Links are followed, also to missing files, so that
/// they are not replaced.
[[nodiscard]] std::filesystem::path followed(std::filesystem::path path);

/// The input that is the same regular file, or null.
[[nodiscard]] const InputFile* input_at(
    const FileIdentity& file, std::span<const InputFile> inputs);

}  // namespace quasimc
