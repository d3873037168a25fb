#include "repetition.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace {

/// Options that do not change the numbers.
constexpr std::array<std::string_view, 2> kWithoutEffect{"threads", "tally_memory_mb"};

/// The flags that change the run: "--seed 9, --paths 64".
std::string flags_of_another_run(const RunArguments& arguments) {
    std::vector<std::string> flags;
    for (const quasimc::Override& given : arguments.flags.overrides()) {
        if (std::find(kWithoutEffect.begin(), kWithoutEffect.end(), given.key) ==
            kWithoutEffect.end()) {
            flags.push_back(fmt::format("{} {}", given.where, given.text));
        }
    }
    return fmt::format("{}", fmt::join(flags, ", "));
}

bool is_cut_short(quasimc::StopReason stop) {
    return stop == quasimc::StopReason::interrupted || stop == quasimc::StopReason::time_limit;
}

/// The reason why numbers differ as expected; "" if there is none.
std::string excuse(
    const RunArguments& arguments, const quasimc::StoredSweep& stored, quasimc::StopReason stop) {
    const std::string flags = flags_of_another_run(arguments);
    if (!flags.empty()) {
        return fmt::format("as asked by {}", flags);
    }
    if (stored.program_version != quasimc::version()) {
        return fmt::format(
            "which version {} wrote (this is {})", stored.program_version, quasimc::version());
    }
    if (stored.is_cut_short) {
        return "whose run was stopped before its end";
    }
    return is_cut_short(stop) ? "for this run was stopped before its end" : "";
}

}  // namespace

Repetition judge_repetition(
    const RunArguments& arguments,
    const quasimc::StoredSweep& stored,
    const std::string& digest,
    const std::string& difference,
    quasimc::StopReason stop) {
    const std::string& path = arguments.from;
    if (path.empty() || digest.empty()) {
        return {};
    }
    const bool is_same = digest == stored.organs_sha256;
    const bool asks_for_same = flags_of_another_run(arguments).empty();
    if (is_same && (difference.empty() || !asks_for_same)) {
        return {fmt::format("the same numbers as in {}", path), false};
    }
    const std::string reason = excuse(arguments, stored, stop);
    if (!reason.empty()) {
        return {fmt::format("OTHER numbers than in {}, {}", path, reason), false};
    }
    const std::string where = difference.empty() ? "" : fmt::format(" ({})", difference);
    return {
        is_same
            ? fmt::format(
                  "OTHER numbers than in {}, which was changed after it was written{}", path, where)
            : fmt::format("OTHER numbers than in {}{}", path, where),
        true};
}
