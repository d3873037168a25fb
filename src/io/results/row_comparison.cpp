#include "io/results/row_comparison.h"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace quasimc {
namespace {

using Json = nlohmann::ordered_json;

/// A line that is an organ or a group, as JsonWriter writes them.
bool is_row(std::string_view line) {
    return line.starts_with(R"({"id":)") || line.starts_with(R"({"by":)");
}

std::string_view without_comma(std::string_view line) {
    if (line.ends_with(',')) {
        line.remove_suffix(1);
    }
    return line;
}

/// The text of a key at the beginning of a line, as `{"time": "..."`; "" if it does not begin so.
std::string_view text_at_begin(std::string_view line, std::string_view key) {
    const std::string begin = fmt::format(R"({{"{}": ")", key);
    return line.starts_with(begin)
               ? line.substr(begin.size(), line.find('"', begin.size()) - begin.size())
               : std::string_view();
}

/// The first place at which two values differ, and both: "absorbed_flux.PAR.mean: 1 there, 2 here".
std::string first_difference(const std::string& place, const Json& there, const Json& here) {
    if (there.is_object() && here.is_object()) {
        for (const auto& item : there.items()) {
            const Json other = here.contains(item.key()) ? here[item.key()] : Json();
            if (item.value() != other) {
                const std::string name = place.empty() ? item.key() : place + "." + item.key();
                return first_difference(name, item.value(), other);
            }
        }
    }
    return fmt::format("{}: {} there, {} here", place, there.dump(), here.dump());
}

/// What a row is of: "organ 3 'leaf'", "group plant 7".
std::string subject_of(const Json& row) {
    const auto text = [&](const char* key) {
        const Json value = row.contains(key) ? row[key] : Json("");
        return value.is_string() ? value.get<std::string>() : value.dump();
    };
    return row.contains("id") ? fmt::format("organ {} '{}'", text("id"), text("name"))
                              : fmt::format("group {} {}", text("by"), text("value"));
}

}  // namespace

void LineSplitter::add(std::string_view text) {
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
        begun_ += text.substr(0, end);
        take_(begun_);
        begun_.clear();
        text.remove_prefix(end + 1);
    }
    begun_ += text;
}

RowComparison::RowComparison(const std::string& path)
    : stored_(path, std::ios::binary), written_([this](std::string_view line) { compare(line); }) {}

bool RowComparison::next_stored(std::string& row) {
    while (std::getline(stored_, row)) {
        if (row.ends_with('\r')) {
            row.pop_back();
        }
        if (is_row(row)) {
            ++stored_rows_;
            return true;
        }
    }
    return false;
}

std::string RowComparison::words_of(const std::string& there, const std::string& here) const {
    const Json a = Json::parse(there, nullptr, false), b = Json::parse(here, nullptr, false);
    const std::string when = when_.empty() ? "" : ", " + when_;
    if (a.is_discarded() || b.is_discarded()) {
        return fmt::format("a row there is no JSON{}", when);
    }
    return fmt::format("{}{}: {}", subject_of(b), when, first_difference("", a, b));
}

void RowComparison::compare(std::string_view line) {
    for (const char* key : {"time", "date"}) {
        const std::string_view when = text_at_begin(line, key);
        when_ = when.empty() ? when_ : std::string(when);
    }
    if (!is_row(line)) {
        return;
    }
    ++rows_;
    std::string there;
    if (!next_stored(there) || without_comma(there) == without_comma(line)) {
        return;
    }
    if (differing_++ == 0) {
        first_ = words_of(std::string(without_comma(there)), std::string(without_comma(line)));
    }
}

std::string RowComparison::difference() {
    const std::size_t compared = stored_rows_;
    for (std::string rest; next_stored(rest);) {
    }
    if (compared == 0 || (differing_ == 0 && stored_rows_ == rows_)) {
        return "";
    }
    if (stored_rows_ != rows_) {
        return fmt::format("{} rows of numbers there, {} here", stored_rows_, rows_);
    }
    return fmt::format("{} of {} rows of numbers differ; {}", differing_, rows_, first_);
}

}  // namespace quasimc
