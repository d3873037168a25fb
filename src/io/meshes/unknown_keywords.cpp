#include "io/meshes/unknown_keywords.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {

void UnknownKeywords::check(
    std::string_view word, std::string_view where, std::span<const std::string_view> known) {
    if (std::find(known.begin(), known.end(), word) != known.end() || count_++ > 0) {
        return;
    }
    const std::string_view near = nearest_word(word, known);
    first_ = fmt::format(
        "the first is {} in {}{}", shown(word), where,
        near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
}

void UnknownKeywords::warn(std::string_view what, Reporter& reporter) const {
    if (count_ > 0) {
        reporter.warnings.push_back(
            {reporter.file, fmt::format("{} are left out: {} in all, {}", what, count_, first_)});
    }
}

}  // namespace quasimc
