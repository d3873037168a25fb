#include "files/writable.h"

#include <cerrno>
#include <system_error>

#include <unistd.h>

#include "files/file_identity.h"

namespace quasimc {

std::string why_unwritable(const std::filesystem::path& given) {
    namespace fs = std::filesystem;
    if (given == "-") {
        return "";
    }
    const fs::path path = followed(given);
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) {
        return std::generic_category().message(EISDIR);
    }
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const bool is_file = !fs::exists(status) || fs::is_regular_file(status);
    return is_file && ::access(folder.c_str(), W_OK | X_OK) != 0
               ? std::generic_category().message(errno)
               : "";
}

}  // namespace quasimc
