#include "io/input_files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "io/sha256.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_read(const fs::path& path, const std::string& why) {
    throw InputError({{path.string(), "can't be read", why, ""}});
}

struct Closer {
    void operator()(std::FILE* file) const {
        if (file != stdin) {
            std::fclose(file);
        }
    }
};

std::string read_all(std::FILE* file, const fs::path& path) {
    std::string text;
    std::error_code unknown_size;
    const std::uintmax_t size = fs::file_size(path, unknown_size);
    if (!unknown_size) {
        text.reserve(size);
    }
    std::array<char, 65536> buffer{};
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file)) {
        text.append(buffer.data(), count);
    }
    if (std::ferror(file) != 0) {
        cannot_read(path, std::generic_category().message(errno));
    }
    return text;
}

/// A device would never end.
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

}  // namespace

std::string read_file(const fs::path& path) {
    if (path == "-") {
        return read_all(stdin, "standard input");
    }
    refuse_what_is_no_file(path);
    const std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        cannot_read(path, std::generic_category().message(errno));
    }
    return read_all(file.get(), path);
}

std::string InputFiles::read(const std::string& path) {
    if (path.empty() || path.find('\0') != std::string::npos) {
        throw InputError(
            {{"", "a file name is " + std::string(path.empty() ? "empty" : "broken"),
              "it must name a file", ""}});
    }
    const fs::path full = resolved(path);
    std::string bytes = reader_(full);
    note(path, full, bytes);
    return bytes;
}

void InputFiles::note(const std::string& path, const fs::path& full, std::string_view bytes) {
    const auto is_same = [&](const InputFile& file) { return file.resolved == full.string(); };
    if (std::none_of(files_.begin(), files_.end(), is_same)) {
        files_.push_back({path, full.string(), sha256_hex(bytes), bytes.size(), false});
    }
}

fs::path InputFiles::resolved(const std::string& path) const {
    return path == "-" ? fs::path("-") : (folder_ / path).lexically_normal();
}

}  // namespace quasimc
