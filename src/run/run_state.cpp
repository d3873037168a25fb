#include "run/run_state.h"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace quasimc {
namespace {

template <typename T>
void append(std::string& bytes, const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_block(std::string& bytes, const Sums* sums) {
    const std::string block = sums != nullptr ? save_sums(*sums) : "";
    append(bytes, std::uint64_t{block.size()});
    bytes += block;
}

std::string_view take(std::string_view& bytes, std::uint64_t size) {
    if (size > bytes.size()) {
        throw std::invalid_argument("the state of a run is truncated");
    }
    const std::string_view taken = bytes.substr(0, size);
    bytes.remove_prefix(size);
    return taken;
}

template <typename T>
void read(std::string_view& bytes, T& value) {
    std::memcpy(&value, take(bytes, sizeof value).data(), sizeof value);
}

std::optional<Sums> read_block(std::string_view& bytes) {
    std::uint64_t size = 0;
    read(bytes, size);
    const std::string_view block = take(bytes, size);
    return block.empty() ? std::nullopt : std::optional(load_sums(block));
}

/// Visits every number.
template <typename Visit, typename PositionOrConst>
void visit_numbers(const Visit& visit, PositionOrConst& position) {
    auto& rounds = position.rounds;
    visit(rounds.done), visit(rounds.is_pilot);
    visit(rounds.cost.last.paths), visit(rounds.cost.last.seconds);
    visit(rounds.cost.before.paths), visit(rounds.cost.before.seconds);
    visit(position.first_paths), visit(position.asked_paths);
    visit(position.target_error), visit(position.target_fraction);
    visit(position.round.first), visit(position.round.count);
    visit(position.tasks.calls), visit(position.tasks.task), visit(position.digest);
}

}  // namespace

std::string save_state(const RunSnapshot& state) {
    std::string bytes;
    visit_numbers([&](const auto& number) { append(bytes, number); }, state.position);
    append_block(bytes, state.done);
    append_block(bytes, state.partial);
    return bytes;
}

RunState load_state(std::string_view bytes) {
    RunState state;
    visit_numbers([&](auto& number) { read(bytes, number); }, state.position);
    state.done = read_block(bytes);
    state.partial = read_block(bytes);
    if (!bytes.empty()) {
        throw std::invalid_argument("the state of a run has extra bytes at its end");
    }
    return state;
}

}  // namespace quasimc
