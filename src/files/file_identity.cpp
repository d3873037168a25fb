#include "files/file_identity.h"

#include <algorithm>
#include <system_error>

#include <unistd.h>

#include <sys/stat.h>

namespace quasimc {
namespace {

namespace fs = std::filesystem;

FileIdentity identity(const struct stat& status) {
    struct stat null {};
    const bool has_null = ::stat("/dev/null", &null) == 0;
    return {
        status.st_dev,
        status.st_ino,
        {},
        S_ISREG(status.st_mode),
        has_null && S_ISCHR(status.st_mode) && status.st_rdev == null.st_rdev};
}

}  // namespace

fs::path followed(fs::path path) {
    constexpr int kMaxLinks = 40;
    std::error_code error;
    for (int i = 0; i < kMaxLinks && fs::is_symlink(fs::symlink_status(path, error)); ++i) {
        if (fs::exists(path, error)) {
            break;
        }
        path = path.parent_path() / fs::read_symlink(path, error);
    }
    const fs::path whole = fs::weakly_canonical(path, error);
    return error ? path : whole;
}

FileIdentity identity_of_descriptor(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 ? identity(status) : FileIdentity{};
}

FileIdentity identity_of(const fs::path& path, int standard) {
    if (path == "-") {
        return identity_of_descriptor(standard);
    }
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) {
        return identity(status);
    }
    std::error_code error;
    return {.name = followed(fs::absolute(path, error))};
}

const InputFile* input_at(const FileIdentity& file, std::span<const InputFile> inputs) {
    if (!file.is_regular) {
        return nullptr;
    }
    const auto found = std::find_if(inputs.begin(), inputs.end(), [&](const InputFile& input) {
        const fs::path path = input.path == "-" ? "-" : input.absolute_path;
        return identity_of(path, STDIN_FILENO) == file;
    });
    return found == inputs.end() ? nullptr : &*found;
}

}  // namespace quasimc
