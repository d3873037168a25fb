#include "files/input_files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <fmt/format.h>
#include <sys/stat.h>

#include "files/descriptor.h"
#include "files/sha256.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_read(const fs::path& path, const std::string& why) {
    throw InputError({{path.string(), "can't be read", why, ""}});
}

/// Waits for input. @returns false  after the given time
bool wait_for_bytes(int descriptor, int milliseconds) {
    pollfd asked{descriptor, POLLIN, 0};
    return ::poll(&asked, 1, milliseconds) != 0;
}

/// Reads a descriptor to its end. It may be non-blocking.
std::string read_all(int descriptor, const fs::path& path) {
    std::string text;
    struct stat status {};
    const bool is_known = ::fstat(descriptor, &status) == 0;
    if (is_known && S_ISREG(status.st_mode)) {
        text.reserve(static_cast<std::size_t>(status.st_size));
    }
    bool may_be_unwritten = is_known && S_ISFIFO(status.st_mode) && descriptor != STDIN_FILENO;
    std::array<char, 65536> buffer{};
    while (true) {
        const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
        if (count > 0) {
            text.append(buffer.data(), static_cast<std::size_t>(count));
            may_be_unwritten = false;
        } else if (count == 0) {
            constexpr int kPatience = 5000;
            if (!may_be_unwritten) {
                return text;
            }
            if (!wait_for_bytes(descriptor, kPatience)) {
                cannot_read(path, "no program writes into this pipe");
            }
            may_be_unwritten = false;
        } else if (errno == EAGAIN) {
            may_be_unwritten = false;
            wait_for_bytes(descriptor, -1);
        } else if (errno != EINTR) {
            cannot_read(path, std::generic_category().message(errno));
        }
    }
}

[[noreturn]] void refuse_size(int descriptor, const fs::path& path) {
    struct stat status {};
    const bool is_known = ::fstat(descriptor, &status) == 0 && status.st_size > 0;
    cannot_read(
        path, is_known ? fmt::format("not enough memory for its {} bytes", status.st_size)
                       : "not enough memory for it");
}

/// Refuses devices, which have no end.
void refuse_what_is_no_file(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::directory) {
        cannot_read(path, "it is a folder");
    }
    if (fs::is_block_file(status) || fs::is_character_file(status)) {
        cannot_read(path, "it is a device");
    }
}

/// Refuses UTF-16, which some programs write. Supported formats begin with letters or a binary
/// signature.
void refuse_utf16(std::string_view bytes, const fs::path& path) {
    const bool has_mark = bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
    const auto is_letter = [](char c) { return c >= '\t' && c <= '~'; };
    const bool alternates =
        bytes.size() >= 4 &&
        ((is_letter(bytes[0]) && bytes[1] == 0 && is_letter(bytes[2]) && bytes[3] == 0) ||
         (bytes[0] == 0 && is_letter(bytes[1]) && bytes[2] == 0 && is_letter(bytes[3])));
    if (has_mark || alternates) {
        throw InputError(
            {{path.string() + ":1", "is text in UTF-16", "text must be UTF-8",
              "save it as UTF-8"}});
    }
}

/// Reads a descriptor to its end; throws if the text does not fit in memory.
std::string read_text(int descriptor, const fs::path& path) {
    try {
        std::string bytes = read_all(descriptor, path);
        refuse_utf16(bytes, path);
        return bytes;
    } catch (const std::bad_alloc&) {
        refuse_size(descriptor, path);
    } catch (const std::length_error&) {
        refuse_size(descriptor, path);
    }
}

}  // namespace

fs::path absolute_path(const std::string& given) {
    std::error_code error;
    const bool is_stream = given == "-" || given == "/dev/stdin" || fs::is_fifo(given, error);
    return is_stream ? fs::current_path() / fs::path(given).filename() : fs::absolute(given);
}

std::string read_file(const fs::path& path) {
    if (path == "-" || path == "/dev/stdin") {
        return read_text(STDIN_FILENO, "standard input");
    }
    refuse_what_is_no_file(path);
    // Without O_NONBLOCK a pipe without a writer would block forever.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    if (!file.is_open()) {
        cannot_read(path, std::generic_category().message(errno));
    }
    return read_text(file.number(), path);
}

std::string InputFiles::read(const std::string& path) {
    if (path.empty() || path.find('\0') != std::string::npos) {
        throw InputError(
            {{"", "a file name is " + std::string(path.empty() ? "empty" : "broken"),
              "give the name of a file", ""}});
    }
    const fs::path full = resolved(path);
    std::string bytes = reader_(full);
    note(path, full, bytes);
    return bytes;
}

void InputFiles::note(const std::string& path, const fs::path& full, std::string_view bytes) {
    const auto is_same = [&](const InputFile& file) { return file.absolute_path == full.string(); };
    if (std::none_of(files_.begin(), files_.end(), is_same)) {
        files_.push_back({path, full.string(), sha256_hex(bytes), bytes.size(), false});
    }
}

fs::path InputFiles::resolved(const std::string& path) const {
    return path == "-" ? fs::path("-") : (folder_ / path).lexically_normal();
}

}  // namespace quasimc
