#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "coupling/byte_stream.h"
#include "coupling/messages.h"

namespace quasimc {

/// What is sent back for one query.
struct Answer {
    std::uint32_t query = 0;  ///< place in Pass::queries
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

/// Answers the plant simulator step after step, until it says exit; queries before that order are
/// answered too.
/// @throws PeerDisconnected   when it is gone without having said so
/// @throws InputError   for a message that is not what the protocol says, after having let the
///                      simulator go on without an answer
void serve(ByteStream& stream, const CommFile& format, const Answerer& answerer);

}  // namespace quasimc
