#include "io/atomic_file.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <sys/stat.h>

#include "quasimc/error.h"

namespace quasimc {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kEverybody = 0666;  // less the process's umask

/// The file that a path stands for: links are followed, so that they stay.
fs::path target_of(const fs::path& path) {
    std::error_code error;
    const fs::path target = fs::weakly_canonical(path, error);
    return error ? path : target;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(path == "-" ? path : target_of(path)) {
    std::error_code error;
    const fs::file_status status = fs::status(path_, error);
    if (path == "-") {
        straight_ = true;
        file_ = stdout;
        return;
    }
    if (fs::is_directory(status)) {
        errno = EISDIR;
        fail();
    }
    straight_ = fs::exists(status) && !fs::is_regular_file(status);
    if (straight_) {
        file_ = std::fopen(path_.c_str(), "wb");
    } else {
        const fs::path folder = path_.has_parent_path() ? path_.parent_path() : fs::path(".");
        open_unnamed(folder);
        if (file_ == nullptr) {
            open_named(folder);
        }
    }
    if (file_ == nullptr) {
        fail();
    }
}

AtomicFile::~AtomicFile() {
    if (file_ != nullptr && file_ != stdout) {
        std::fclose(file_);
    }
    if (!temporary_.empty()) {
        ::unlink(temporary_.c_str());
    }
}

void AtomicFile::write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
        fail();
    }
}

void AtomicFile::commit() {
    if (std::fflush(file_) != 0) {
        fail();
    }
    if (straight_) {
        return;
    }
    if (temporary_.empty()) {
        const fs::path name =
            path_.parent_path() / fmt::format(".{}.{}", path_.filename().string(), ::getpid());
        const std::string descriptor = fmt::format("/proc/self/fd/{}", ::fileno(file_));
        ::unlink(name.c_str());
        if (::linkat(AT_FDCWD, descriptor.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) !=
            0) {
            fail();
        }
        temporary_ = name;
    }
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
        fail();
    }
    temporary_.clear();
}

void AtomicFile::fail() const {
    throw InputError(
        {{path_.string(), "can't be written", std::generic_category().message(errno), ""}});
}

/// A file without a name leaves nothing behind, however the program ends. Not every file system has
/// them.
void AtomicFile::open_unnamed([[maybe_unused]] const fs::path& folder) {
#ifdef O_TMPFILE
    const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, kEverybody);
    if (descriptor >= 0) {
        file_ = ::fdopen(descriptor, "wb");
    }
#endif
}

void AtomicFile::open_named(const fs::path& folder) {
    std::string name = (folder / fmt::format(".{}.XXXXXX", path_.filename().string())).string();
    const int descriptor = ::mkstemp(name.data());
    if (descriptor < 0) {
        return;
    }
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(descriptor, kEverybody & ~mask);
    temporary_ = name;
    file_ = ::fdopen(descriptor, "wb");
}

}  // namespace quasimc
