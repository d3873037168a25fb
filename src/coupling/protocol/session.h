#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "coupling/protocol/byte_stream.h"
#include "coupling/protocol/messages.h"

namespace quasimc {

/// What is sent back for one query.
struct Answer {
    std::uint32_t query = 0;  ///< index in Pass::queries
    ListPart values;  ///< of Answers::values; fewer than the query's slots: the rest is empty
};
struct Answers {
    std::vector<Answer> list;  ///< in the order to be sent
    std::vector<double> values;
    void clear() { list.clear(), values.clear(); }
};

/// Computes the light of a step. `check` throws when the plant simulator is gone.
using Answerer =
    std::function<void(const Pass& pass, const std::function<void()>& check, Answers& answers)>;

/// The text of answers, cut into chunks of at most `chunk` answers and `capacity` bytes; at least
/// one, the text of which may be a Control line alone.
[[nodiscard]] std::vector<std::string> reply_chunks(
    const Pass& pass, const Answers& answers, std::size_t chunk, std::size_t capacity);

/// What was wrong in a step, counted from 0; nothing if it was answered as it should be.
using StepListener = std::function<void(std::uint64_t step, const std::exception_ptr& fault)>;

/// Answers the plant simulator step after step, until it says exit; queries before that order are a
/// step too (a program that calls us for one writes "Control: 8" behind them). A step in which
/// something goes
/// wrong (a message that is not what the protocol says, a fault of the answerer) is answered as far
/// as the answerer got, mostly with nothing: modules without an answer keep the values they have.
/// @param on_step  is told of every step after its answer
/// @throws PeerDisconnected  when the simulator is gone without having said exit
/// @throws InputError  if not even an empty answer can be written
void serve(
    ByteStream& stream,
    const CommFile& format,
    const Answerer& answerer,
    const StepListener& on_step);

/// Answers every step with nothing, until the plant simulator says exit.
/// @throws PeerDisconnected, InputError  as serve()
void serve_nothing(ByteStream& stream);

}  // namespace quasimc
