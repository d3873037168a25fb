#include "resultio/row_comparison.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace quasimc {
namespace {

using Row = nlohmann::json;

/// A line that is an organ or a group, as JsonWriter writes them.
bool is_row(std::string_view line) {
    return line.starts_with(R"({"id":)") || line.starts_with(R"({"by":)");
}

/// A row without what follows its object.
std::string_view object_of(std::string_view line) {
    return line.substr(0, line.rfind('}') + 1);
}

/// Whether a value that both have differs. Values that one of them lacks were not requested.
bool differ(const Row& there, const Row& here) {
    if (!there.is_object() || !here.is_object()) {
        return there != here;
    }
    for (const auto& item : there.items()) {
        const auto found = here.find(item.key());
        if (found != here.end() && differ(item.value(), *found)) {
            return true;
        }
    }
    return false;
}

}  // namespace

void RowComparison::add(std::string_view text) {
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
        begun_ += text.substr(0, end);
        compare(begun_);
        begun_.clear();
        text.remove_prefix(end + 1);
    }
    begun_ += text;
}

bool RowComparison::next_stored(std::string& row) {
    while (std::getline(stored_, row)) {
        if (is_row(row)) {
            ++stored_rows_;
            return true;
        }
    }
    return false;
}

void RowComparison::compare(std::string_view line) {
    std::string stored;
    if (!is_row(line)) {
        return;
    }
    ++rows_;
    if (!next_stored(stored)) {
        return;
    }
    const std::string_view there = object_of(stored), here = object_of(line);
    if (there != here && differ(Row::parse(there, nullptr, false), Row::parse(here))) {
        ++differing_;
    }
}

std::string RowComparison::difference() {
    for (std::string rest; next_stored(rest);) {
    }
    // Rows correspond only if the same times were requested.
    if (differing_ == 0 || stored_rows_ != rows_) {
        return "";
    }
    return fmt::format("{} of {} rows of numbers differ", differing_, rows_);
}

}  // namespace quasimc
