#include "io/results/read_rounds.h"

#include <limits>

#include <nlohmann/json.hpp>

#include "io/results/read_columns.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

using RoundsJson = nlohmann::json;

double number_in(const RoundsJson& round, const char* key) {
    const auto found = round.find(key);
    return found != round.end() && found->is_number() ? found->get<double>()
                                                      : std::numeric_limits<double>::quiet_NaN();
}

/// The moment of which the time begins so.
const RoundsJson& moment_of(
    const RoundsJson& head, const std::string& path, const std::string& time) {
    if (const auto moments = head.find("moments"); moments != head.end()) {
        for (const RoundsJson& moment : *moments) {
            if (!time.empty() && moment.value("time", "").starts_with(time)) {
                return moment;
            }
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
    const RoundsJson head = RoundsJson::parse(read_columns(text, path, {}, 0, point).head);
    const RoundsJson& one = head.contains("moments") ? moment_of(head, path, time) : head;
    std::vector<RoundErrors> rounds;
    const auto found = one.find("rounds");
    for (const RoundsJson& round : found != one.end() ? *found : RoundsJson::array()) {
        rounds.push_back(
            {static_cast<std::uint64_t>(number_in(round, "paths")), number_in(round, "seconds"),
             number_in(round, "median_error"), number_in(round, "worst_error"),
             number_in(round, "fraction_at_target")});
    }
    return rounds;
}

}  // namespace quasimc
