#include "files/atomic_file.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <random>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <sys/stat.h>

#include "files/descriptor.h"
#include "files/file_identity.h"
#include "files/standard_streams.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kFileMode = 0666;  // restricted by the umask

/// Opens a pipe for writing; -1 if it has no reader.
int open_pipe(const fs::path& path) {
    constexpr int kTries = 100;
    constexpr std::chrono::milliseconds kApart{50};
    for (int i = 0; i < kTries; ++i) {
        const int descriptor = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
        if (descriptor >= 0) {
            ::fcntl(descriptor, F_SETFL, O_WRONLY);
            return descriptor;
        }
        if (errno != ENXIO) {
            break;
        }
        std::this_thread::sleep_for(kApart);
        errno = ENXIO;
    }
    return -1;
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(path == "-" ? path : followed(path)) {
    std::error_code error;
    const fs::file_status status = fs::status(path_, error);
    if (path == "-") {
        straight_ = true;
        if (!has_standard_output()) {
            throw InputError({{"standard output", "can't be written", "it is closed", ""}});
        }
        file_ = stdout;
        return;
    }
    if (fs::is_directory(status)) {
        errno = EISDIR;
        fail();
    }
    straight_ = fs::exists(status) && !fs::is_regular_file(status);
    if (straight_) {
        open_straight();
    } else {
        const fs::path folder = folder_of(path_);
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

void AtomicFile::prepare() {
    if (std::fflush(file_) != 0) {
        fail();
    }
    if (straight_) {
        return;
    }
    // A file system without fsync (EINVAL) has written the file all the same.
    if (::fsync(::fileno(file_)) != 0 && errno != EINVAL) {
        fail();
    }
    if (temporary_.empty()) {
        name_temporary();
    }
}

void AtomicFile::commit() {
    prepare();
    take_name();
    sync_name();
}

void AtomicFile::take_name() {
    if (straight_) {
        return;
    }
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
        fail();
    }
    temporary_.clear();
}

void AtomicFile::sync_name() const {
    if (straight_) {
        return;
    }
    const Descriptor folder(::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.is_open()) {
        static_cast<void>(::fsync(folder.number()));
    }
}

void AtomicFile::name_temporary() {
    const fs::path name =
        folder_of(path_) /
        fmt::format(".quasimc.{}.{}.{:08x}", ::getpid(), ::fileno(file_), std::random_device()());
    const std::string descriptor = fmt::format("/proc/self/fd/{}", ::fileno(file_));
    if (::linkat(AT_FDCWD, descriptor.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0) {
        fail();
    }
    temporary_ = name;
}

void AtomicFile::fail() const {
    if (path_ == "-" && errno == EPIPE) {
        throw ReaderGone();
    }
    const std::string why = std::generic_category().message(errno);
    const std::string where = path_ == "-" ? "standard output" : path_.string();
    throw InputError({{where, "can't be written", why, ""}});
}

/// Opens pipes and devices.
void AtomicFile::open_straight() {
    std::error_code error;
    if (!fs::is_fifo(path_, error)) {
        file_ = std::fopen(path_.c_str(), "wb");
        return;
    }
    const int descriptor = open_pipe(path_);
    if (descriptor < 0 && errno == ENXIO) {
        throw InputError({{path_.string(), "can't be written", "no program reads this pipe", ""}});
    }
    file_ = descriptor < 0 ? nullptr : ::fdopen(descriptor, "wb");
}

/// Opens a file without a name, which disappears with the process. Not every file system supports
/// this.
void AtomicFile::open_unnamed([[maybe_unused]] const fs::path& folder) {
#ifdef O_TMPFILE
    const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, kFileMode);
    if (descriptor >= 0) {
        file_ = ::fdopen(descriptor, "wb");
    }
#endif
}

void AtomicFile::open_named(const fs::path& folder) {
    std::string name = (folder / ".quasimc.XXXXXX").string();
    const int descriptor = ::mkstemp(name.data());
    if (descriptor < 0) {
        return;
    }
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(descriptor, kFileMode & ~mask);
    temporary_ = name;
    file_ = ::fdopen(descriptor, "wb");
}

}  // namespace quasimc
