#include "scene/fold_warnings.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace quasimc {
namespace {

bool is_alnum(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

/// The end of a name that begins with a quotation mark at `at`; `at` if none begins there.
std::size_t end_of_quoted(const std::string& text, std::size_t at) {
    if (text[at] != '\'' || (at > 0 && is_alnum(text[at - 1]))) {
        return at;  // an apostrophe, or no mark
    }
    std::size_t end = text.find('\'', at + 1);
    while (end != std::string::npos && end + 1 < text.size() && is_alnum(text[end + 1])) {
        end = text.find('\'', end + 1);
    }
    return end == std::string::npos ? at : end + 1;
}

/// Whether a word is a number, or a file's name or path.
bool varies(std::string_view word) {
    for (std::size_t i = 0; i < word.size(); ++i) {
        const bool is_inner_dot = word[i] == '.' && i + 1 < word.size() && is_alnum(word[i + 1]);
        if (std::isdigit(static_cast<unsigned char>(word[i])) != 0 || word[i] == '/' ||
            is_inner_dot) {
            return true;
        }
    }
    return false;
}

/// A text without quoted names, numbers and file names.
std::string kind_of(const std::string& text) {
    std::string kind, word;
    const auto end_word = [&] {
        kind += varies(word) ? "#" : word;
        word.clear();
    };
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = end_of_quoted(text, at);
        if (end > at) {
            end_word();
            kind += '#';
            at = end;
            continue;
        }
        if (text[at] == ' ') {
            end_word();
            kind += ' ';
        } else {
            word += text[at];
        }
        ++at;
    }
    end_word();
    return kind;
}

constexpr std::string_view kEndOfFolded = " warnings of this kind)";

/// Splits off the count at the end of a text; 1 if there is none.
std::pair<std::string, std::size_t> without_count(const std::string& text) {
    const std::size_t open = text.rfind(" (");
    std::size_t count = 0;
    if (open == std::string::npos || !text.ends_with(kEndOfFolded)) {
        return {text, 1};
    }
    for (std::size_t i = open + 2; i < text.size() - kEndOfFolded.size(); ++i) {
        count = 10 * count + static_cast<std::size_t>(text[i] - '0');
    }
    return {text.substr(0, open), count};
}

/// Folds warnings of one kind, some of which may be folded already.
Warning folded(const std::vector<Warning>& all) {
    constexpr std::size_t kShown = 3;
    std::size_t count = 0;
    for (const Warning& warning : all) {
        count += without_count(warning.text).second;
    }
    std::vector<std::string> locations;
    for (const Warning& warning : all) {
        if (std::find(locations.begin(), locations.end(), warning.where) == locations.end() &&
            locations.size() <= kShown) {
            locations.push_back(warning.where);
        }
    }
    const std::size_t shown = std::min(locations.size(), kShown);
    std::string where;
    for (std::size_t i = 0; i < shown; ++i) {
        where += (i == 0 ? "" : ", ") + locations[i];
    }
    if (locations.size() > shown) {
        where += " and others";
    }
    return {
        where, fmt::format("{} ({}{}", without_count(all.front().text).first, count, kEndOfFolded)};
}

}  // namespace

std::vector<Warning> fold_warnings(std::vector<Warning> warnings, std::vector<Warning> others) {
    constexpr std::size_t kMaxAlike = 3;
    std::map<std::string, std::vector<Warning>> kinds;
    std::vector<std::string> kind_of_each;
    for (const Warning& warning : warnings) {
        kind_of_each.push_back(kind_of(without_count(warning.text).first));
        kinds[kind_of_each.back()].push_back(warning);
    }
    std::vector<Warning> result;
    for (std::size_t i = 0; i < warnings.size(); ++i) {
        std::vector<Warning>& kind = kinds[kind_of_each[i]];
        if (!kind.empty() && kind.size() <= kMaxAlike) {
            result.push_back(std::move(warnings[i]));
        } else if (!kind.empty()) {
            result.push_back(folded(kind));
            kind.clear();
        }
    }
    std::move(others.begin(), others.end(), std::back_inserter(result));
    return result;
}

}  // namespace quasimc
