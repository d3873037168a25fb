#include "io/results/read_rounds.h"

#include <limits>

#include "io/results/read_rows.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

/// A list in a table; empty if there is none of the name.
const Node::List& list_in(const Node& table, std::string_view key) {
    static const Node::List kNone;
    const Node* found = table.find(key);
    const auto* list = found == nullptr ? nullptr : found->as<Node::List>();
    return list == nullptr ? kNone : *list;
}

double number_in(const Node& round, std::string_view key) {
    const Node* found = round.find(key);
    if (const auto* count = found == nullptr ? nullptr : found->as<std::int64_t>()) {
        return static_cast<double>(*count);
    }
    const auto* number = found == nullptr ? nullptr : found->as<double>();
    return number == nullptr ? std::numeric_limits<double>::quiet_NaN() : *number;
}

/// The moment of which the time begins so.
const Node& moment_of(const Node& head, const std::string& path, const std::string& time) {
    for (const Node& moment : list_in(head, "moments")) {
        if (!time.empty() && text_in(moment, "time").starts_with(time)) {
            return moment;
        }
    }
    throw InputError(
        {{"--time", path + " has no time that begins '" + time + "'",
          "rounds are those of one time", "give it as the file does: 2024-06-21T12:00"}});
}

}  // namespace

std::vector<RoundErrors> read_rounds(
    const std::string& text,
    const std::string& path,
    std::optional<std::size_t> point,
    const std::string& time) {
    const Node all = read_rows(text, path, {.rest = RowsQuery::Rest::all}, {});
    const Node head = only_point(all, point, path);
    std::vector<RoundErrors> rounds;
    const Node& one = head.find("moments") == nullptr ? head : moment_of(head, path, time);
    for (const Node& round : list_in(one, "rounds")) {
        rounds.push_back(
            {static_cast<std::uint64_t>(number_in(round, "paths")), number_in(round, "seconds"),
             number_in(round, "median_error"), number_in(round, "worst_error"),
             number_in(round, "fraction_at_target")});
    }
    return rounds;
}

}  // namespace quasimc
