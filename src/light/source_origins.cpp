#include "light/source_origins.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {
namespace {

/// A kind of sources, as RunSpec::origins names it.
struct OriginKind {
    std::string_view name;
    bool (*has)(const Source&);
};
constexpr std::array<OriginKind, 3> kOriginKinds{{
    {"sun", [](const Source& source) { return source.is_sun(); }},
    {"sky", [](const Source& source) { return !source.is_sun() && !source.is_lamp(); }},
    {"lamps", [](const Source& source) { return source.is_lamp(); }},
}};

/// The kind of a name, or null.
const OriginKind* find_origin_kind(std::string_view name) {
    const auto* const found = std::ranges::find(kOriginKinds, name, &OriginKind::name);
    return found == kOriginKinds.end() ? nullptr : found;
}

bool fits(const Source& source, std::string_view entry) {
    const OriginKind* kind = find_origin_kind(entry);
    return kind != nullptr ? kind->has(source)
                           : entry == kOtherOrigin || fits_pattern(source.name(), entry);
}

/// The entry that a source belongs to; their number if none fits.
std::size_t origin_of(const Source& source, std::span<const std::string> entries) {
    const auto found =
        std::ranges::find_if(entries, [&](const auto& entry) { return fits(source, entry); });
    return static_cast<std::size_t>(found - entries.begin());
}

/// Names for a message, the first few of them.
std::string some_names(const Sources& sources) {
    constexpr std::size_t kShown = 8;
    std::vector<std::string_view> names;
    for (const auto& source : sources) {
        if (std::ranges::find(names, source->name()) == names.end()) {
            names.emplace_back(source->name());
        }
    }
    const std::size_t rest = names.size() - std::min(names.size(), kShown);
    names.resize(names.size() - rest);
    return joined(names, ", ") + (rest > 0 ? fmt::format(" and {} more", rest) : "");
}

void check_kind(const OriginKind& kind, const Sources& sources, Faults& faults) {
    const auto is_other = [&](const auto& source) {
        return source->name() == kind.name && !kind.has(*source);
    };
    if (std::ranges::any_of(sources, is_other)) {
        faults.add(
            {"origins", fmt::format("'{}' is a kind and the name of a source", kind.name),
             "the source is of another kind", "rename the source"});
    }
}

}  // namespace

bool fits_pattern(std::string_view text, std::string_view pattern) {
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) {
        return text == pattern;
    }
    if (!text.starts_with(pattern.substr(0, star))) {
        return false;
    }
    const std::string_view rest = pattern.substr(star + 1);
    for (std::size_t at = star; at <= text.size(); ++at) {
        if (fits_pattern(text.substr(at), rest)) {
            return true;
        }
    }
    return false;
}

std::vector<std::string> complete_origins(
    const Sources& sources, std::span<const std::string> entries) {
    std::vector<std::string> names(entries.begin(), entries.end());
    const auto fits_none = [&](const auto& source) {
        return origin_of(*source, entries) == entries.size();
    };
    if (!entries.empty() && std::ranges::any_of(sources, fits_none)) {
        names.emplace_back(kOtherOrigin);
    }
    return names;
}

SourceOrigins source_origins(const Sources& sources, std::span<const std::string> entries) {
    SourceOrigins origins{complete_origins(sources, entries), {}};
    for (const auto& source : sources) {
        origins.of_source.push_back(origin_of(*source, entries));
    }
    return origins;
}

std::vector<Sources> sources_by_origin(
    const Sources& sources, std::span<const std::string> entries) {
    const SourceOrigins origins = source_origins(sources, entries);
    std::vector<Sources> found(origins.names.size());
    for (std::size_t i = 0; i < sources.size() && !found.empty(); ++i) {
        found[origins.of_source[i]].push_back(sources[i]);
    }
    return found;
}

void check_origins(const Sources& sources, std::span<const std::string> entries, Faults& faults) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string& entry = entries[i];
        const auto before = entries.first(i);
        if (std::ranges::find(before, entry) != before.end()) {
            faults.add({"origins", fmt::format("'{}' is given twice", entry), "", "give it once"});
        } else if (const OriginKind* kind = find_origin_kind(entry)) {
            check_kind(*kind, sources, faults);
        } else if (entry != kOtherOrigin && std::ranges::none_of(sources, [&](const auto& source) {
                       return fits(*source, entry);
                   })) {
            faults.add(
                {"origins", fmt::format("no source is called '{}'", entry),
                 "names are " + some_names(sources), "kinds are sun, sky and lamps"});
        }
    }
}

}  // namespace quasimc
