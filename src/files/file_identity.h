#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "quasimc/error.h"

namespace quasimc {

/// The file that a path stands for, whatever links lead there: two paths of one file are equal.
struct FileIdentity {
    std::uint64_t device = 0, inode = 0;  ///< of a file that is there
    std::filesystem::path name = {};      ///< where one will be that is not there yet
    bool is_regular = false;              ///< not so a pipe, a device, what is not there
    bool is_discard = false;              ///< /dev/null, which any number may share

    friend bool operator==(const FileIdentity& a, const FileIdentity& b) {
        return a.device == b.device && a.inode == b.inode && a.name == b.name;
    }
};

/// @param path  "-" is the descriptor `standard`
[[nodiscard]] FileIdentity identity_of(const std::filesystem::path& path, int standard);
/// Of an open file. All zero if it is not open.
[[nodiscard]] FileIdentity identity_of_descriptor(int descriptor);

/// The path where a file would be written: links are followed, so that they stay, even those to
/// what is not there yet.
[[nodiscard]] std::filesystem::path followed(std::filesystem::path path);

/// Which of the inputs a file is; null if it is none. Only regular files can be spoilt.
[[nodiscard]] const InputFile* input_at(
    const FileIdentity& file, std::span<const InputFile> inputs);

}  // namespace quasimc
