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

/// The first place at which both have a value and these differ, and both of them:
/// "absorbed_flux.PAR.mean: 1 there, 2 here"; "" if nowhere. What one of them leaves out was not
/// asked for.
std::string first_difference(const std::string& place, const Json& there, const Json& here) {
    if (!there.is_object() || !here.is_object()) {
        return there == here
                   ? ""
                   : fmt::format("{}: {} there, {} here", place, there.dump(), here.dump());
    }
    for (const auto& item : there.items()) {
        if (here.contains(item.key())) {
            const std::string name = place.empty() ? item.key() : place + "." + item.key();
            std::string found = first_difference(name, item.value(), here[item.key()]);
            if (!found.empty()) {
                return found;
            }
        }
    }
    return "";
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

std::string RowComparison::words_of(std::string_view there, std::string_view here) const {
    const Json a = Json::parse(there, nullptr, false), b = Json::parse(here, nullptr, false);
    const std::string when = when_.empty() ? "" : ", " + when_;
    if (a.is_discarded() || b.is_discarded()) {
        return fmt::format("a row there is no JSON{}", when);
    }
    const std::string found = first_difference("", a, b);
    return found.empty() ? "" : fmt::format("{}{}: {}", subject_of(b), when, found);
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
    const std::string words = words_of(without_comma(there), without_comma(line));
    if (!words.empty() && differing_++ == 0) {
        first_ = words;
    }
}

std::string RowComparison::difference() {
    for (std::string rest; next_stored(rest);) {
    }
    // Other times may have been asked for: which row is which can't be told then.
    if (differing_ == 0 || stored_rows_ != rows_) {
        return "";
    }
    return fmt::format("{} of {} rows of numbers differ; {}", differing_, rows_, first_);
}

}  // namespace quasimc
