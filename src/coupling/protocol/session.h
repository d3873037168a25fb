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

/// Answer to one query.
struct Answer {
    std::uint32_t query = 0;  ///< index in Pass::queries
    ListPart values;          ///< in Answers::values; the remaining slots of the query are empty
};
struct Answers {
    std::vector<Answer> list;  ///< in the order to be sent
    std::vector<double> values;
    void clear() { list.clear(), values.clear(); }
};

/// Function that computes the light of a step. Its `check` throws if the plant simulator is gone.
using Answerer =
    std::function<void(const Pass& pass, const std::function<void()>& check, Answers& answers)>;

/// Text of the answers in chunks of at most `chunk` answers and `capacity` bytes; at least one
/// chunk, possibly only a Control line.
[[nodiscard]] std::vector<std::string> reply_chunks(
    const Pass& pass, const Answers& answers, std::size_t chunk, std::size_t capacity);

/// Receives the fault of a step (counted from 0), or null after a complete answer.
using StepListener = std::function<void(std::uint64_t step, const std::exception_ptr& fault)>;

/// Answers the plant simulator step after step, until it sends exit; queries before that order are
/// a step too (a program that needs only one step sends "Control: 8" after them). After a fault (a
/// message that violates the protocol, or an exception of the answerer) the answers so far are
/// sent, usually none: modules without an answer keep their values.
/// @param on_step  called for every step after its answer
/// @throws PeerDisconnected  if the simulator ends without the order to exit
/// @throws InputError  if not even an empty answer can be written
void serve(
    ByteStream& stream,
    const CommFile& format,
    const Answerer& answerer,
    const StepListener& on_step);

/// Sends an empty answer to every step, until the plant simulator sends exit.
/// @throws PeerDisconnected, InputError  as serve()
void serve_nothing(ByteStream& stream);

}  // namespace quasimc
