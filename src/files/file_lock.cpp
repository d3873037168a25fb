#include "files/file_lock.h"

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "quasimc/error.h"

namespace quasimc {
namespace {

constexpr std::string_view kOwnerBegin = "process ";

/// The name of the process that has the lock; "" if it is not written yet.
std::string read_owner(int file) {
    std::array<char, 512> text{};
    const ssize_t count = ::pread(file, text.data(), text.size(), 0);
    return count > 0 ? std::string(text.data(), static_cast<std::size_t>(count)) : "";
}

std::string own_name() {
    std::array<char, 256> host{};
    const bool is_known = ::gethostname(host.data(), host.size() - 1) == 0;
    return fmt::format(
        "{}{} on {}", kOwnerBegin, ::getpid(), is_known ? host.data() : "this machine");
}

/// Whether the name still refers to the locked file, as the last owner may have removed it before.
bool is_still(int file, const std::string& name) {
    struct stat locked {
    }, named{};
    return ::fstat(file, &locked) == 0 && ::stat(name.c_str(), &named) == 0 &&
           locked.st_dev == named.st_dev && locked.st_ino == named.st_ino;
}

[[noreturn]] void refuse_lock(const std::string& path, const std::string& owner) {
    throw InputError(
        {{path, "is in use by another run", owner.empty() ? "it holds the lock" : owner,
          "wait until that run ends, or name another file"}});
}

}  // namespace

FileLock::FileLock(const std::string& path) : name_(path + ".lock") {
    constexpr mode_t kReadable = 0666;  // restricted by the umask
    while (true) {
        file_ = std::make_unique<Descriptor>(
            ::open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, kReadable));
        if (!file_->is_open()) {
            throw InputError(
                {{name_, "can't be written", std::generic_category().message(errno),
                  "it keeps other runs from " + path}});
        }
        if (::flock(file_->number(), LOCK_EX | LOCK_NB) != 0) {
            if (errno == EWOULDBLOCK) {
                refuse_lock(path, read_owner(file_->number()));
            }
            break;  // a file system without locks
        }
        if (is_still(file_->number(), name_)) {
            break;
        }
    }
    const std::string before = read_owner(file_->number());
    if (!before.empty() && !before.starts_with(kOwnerBegin)) {
        throw InputError(
            {{name_, "exists and is not a lock file", "it would be overwritten and deleted",
              "delete it, or name another file than " + path}});
    }
    const std::string owner = own_name();
    const bool is_named = ::ftruncate(file_->number(), 0) == 0 &&
                          ::pwrite(file_->number(), owner.data(), owner.size(), 0) > 0;
    static_cast<void>(is_named);  // the lock holds even on a full disk
}

FileLock::~FileLock() {
    ::unlink(name_.c_str());
}

}  // namespace quasimc
