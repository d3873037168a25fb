#include "growth/view/view_lines.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "quasimc/error.h"
#include "text/numbers.h"

namespace quasimc {

bool ViewLines::next() {
    do {
        if (!scanner_.next()) {
            line_ = rest_ = {};
            return false;
        }
        line_ = rest_ = trimmed(scanner_.line());
    } while (line_.empty());
    return true;
}

void ViewLines::need(std::string_view expected) {
    if (!next()) {
        fail("the file is incomplete", fmt::format("{} is expected", expected));
    }
}

std::optional<std::string> ViewLines::take_label() {
    const std::size_t colon = rest_.find(':');
    if (colon == std::string_view::npos) {
        return std::nullopt;
    }
    std::string label = lower_case(rest_of_line(rest_.substr(0, colon)));
    rest_.remove_prefix(colon + 1);
    return label;
}

double ViewLines::parsed(
    std::string_view word, std::string_view what, Range range, bool is_integer) const {
    const std::optional<double> value = parse_real(word);
    if (!value || !(*value >= range.low && *value <= range.high) ||
        (is_integer && !whole_number(*value))) {
        fail(
            fmt::format("{} is {}", what, word.empty() ? "missing" : shown(word)),
            fmt::format(
                "it is {} from {} to {}", is_integer ? "an integer" : "a number", range.low,
                range.high));
    }
    return *value;
}

Vec3 ViewLines::vector(std::string_view what) {
    Vec3 v;
    for (double* const coordinate : {&v.x, &v.y, &v.z}) {
        *coordinate = number(what);
    }
    return v;
}

SourceLine ViewLines::source() const {
    const std::uint32_t line = scanner_.number();
    return view_file_ == nullptr ? SourceLine{0, line} : view_file_->lines.at(line - 1);
}

const std::string& ViewLines::path() const {
    return view_file_ == nullptr ? named_->path : view_file_->files[source().file];
}

std::string ViewLines::where() const {
    return fmt::format("{}:{}", printable(one_line(path())), source().line);
}

void ViewLines::fail(std::string problem, std::string why, std::string suggestion) const {
    throw InputError({{where(), std::move(problem), std::move(why), std::move(suggestion)}});
}

std::optional<NamedFile> ViewFile::named_file(const std::string& what) {
    const std::string_view name = word();
    if (name.empty() || name == "-") {
        fail(fmt::format("the name of the file of {} is missing", what), "a file is expected");
    }
    const std::string named_path = (std::filesystem::path(path()).parent_path() / name).string();
    try {
        return NamedFile{named_path, files_.read(named_path)};
    } catch (const InputError& error) {
        warn(fmt::format("{} is ignored: {}", what, error.faults().front().text()));
        skip_words();
        return std::nullopt;
    }
}

}  // namespace quasimc
