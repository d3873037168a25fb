#include "growth/language/model_files.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "growth/language/format_values.h"

namespace quasimc {
namespace {

namespace fs = std::filesystem;

bool is_file_mode(const std::string& mode) {
    const bool has_kind = !mode.empty() && std::string_view("rwa").find(mode[0]) != mode.npos;
    return has_kind && mode.size() <= 3 && mode.find_first_not_of("+bt", 1) == mode.npos;
}

/// Whether the path is a file of the disk, or is free.
bool may_be_opened(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return status.type() == fs::file_type::not_found || fs::is_regular_file(status);
}

/// Whether a model may write to a path: only below the current folder.
bool may_be_written(const fs::path& path) {
    const fs::path normal = path.lexically_normal();
    return normal.is_relative() && normal.begin() != normal.end() && *normal.begin() != "..";
}

/// Reads what a part of a format describes. The format of fscanf is made from checked parts only.
/// @returns whether it matches
bool scan_part(std::FILE* file, const FormatPart& part, std::optional<double>& value) {
    constexpr int kMaxNumber = 1000;  // characters
    double number = 0;
    int end = -1;  // set by %n, after all else matched
    const bool is_text = part.kind == 's' || part.kind == 'c';
    if (is_text || part.kind == 0 || part.kind == '%') {
        const std::string width = part.width > 0 ? std::to_string(part.width) : "";
        const std::string format = is_text          ? "%*" + width + part.kind
                                   : part.kind == 0 ? std::string(part.text)
                                                    : "%%";
        static_cast<void>(std::fscanf(file, (format + "%n").c_str(), &end));
    } else if (part.is_number()) {
        const std::string format = fmt::format("%{}lf%n", part.width > 0 ? part.width : kMaxNumber);
        static_cast<void>(std::fscanf(file, format.c_str(), &number, &end));
        value = end >= 0 ? std::optional(number) : std::nullopt;
    }
    return end >= 0;
}

}  // namespace

const ModelFiles::OpenFile* ModelFiles::find(double file) const {
    if (!(file >= 0 && file < static_cast<double>(kMaxFiles))) {
        return nullptr;
    }
    const OpenFile& found = files_[static_cast<std::size_t>(file)];
    return found.stream ? &found : nullptr;
}

std::FILE* ModelFiles::prepared(double file, Action action) {
    if (find(file) == nullptr) {
        return nullptr;
    }
    auto& [stream, last] = files_[static_cast<std::size_t>(file)];
    if (std::exchange(last, action) != action) {
        static_cast<void>(std::fseek(stream.get(), 0, SEEK_CUR));  // as C demands
    }
    return stream.get();
}

double ModelFiles::open(const std::string& name, const std::string& mode) {
    const auto is_free = [](const OpenFile& file) { return !file.stream; };
    const auto end = files_.begin() + static_cast<std::ptrdiff_t>(max_open_);
    const auto slot = std::find_if(files_.begin(), end, is_free);
    if (slot == end || name.empty() || name.find('\0') != name.npos || !is_file_mode(mode)) {
        return -1;
    }
    const fs::path path = folder_ / name;
    const bool is_written = mode.find_first_of("wa+") != mode.npos;
    if (!may_be_opened(path) || (is_written && !may_be_written(name))) {
        return -1;
    }
    slot->stream.reset(std::fopen(path.c_str(), (mode + "e").c_str()));
    slot->last = Action::none;
    return slot->stream ? static_cast<double>(slot - files_.begin()) : -1;
}

double ModelFiles::close(double file) {
    if (find(file) == nullptr) {
        return -1;
    }
    std::FILE* const stream = files_[static_cast<std::size_t>(file)].stream.release();
    return std::fclose(stream) == 0 ? 0 : -1;
}

double ModelFiles::flush(double file) {
    const OpenFile* const found = find(file);
    return found != nullptr && std::fflush(found->stream.get()) == 0 ? 0 : -1;
}

double ModelFiles::write(double file, std::string_view text) {
    std::FILE* const stream = prepared(file, Action::writing);
    const bool is_written =
        stream != nullptr && std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    return is_written ? static_cast<double>(text.size()) : -1;
}

ScannedValues ModelFiles::scan(double file, std::string_view format) {
    std::FILE* const stream = prepared(file, Action::reading);
    ScannedValues result;
    bool matches = stream != nullptr;
    while (!format.empty()) {
        const FormatPart part = take_format_part(format);
        std::optional<double> value;
        matches = matches && scan_part(stream, part, value);
        const bool has_value = part.kind != 0 && part.kind != '%';
        if (has_value && part.flags.find('*') == part.flags.npos) {
            result.values.push_back(value);
            if (!part.is_number() || part.kind == 'c') {
                result.problems.push_back(
                    fmt::format("%{} can't read a number, use %lf", part.kind));
            }
        }
    }
    return result;
}

}  // namespace quasimc
