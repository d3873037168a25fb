#include "coupling/session.h"

#include <algorithm>

#include "coupling/trailing_values.h"

namespace quasimc {
namespace {

/// An empty answer: the simulator goes on with the next chunk, or with the values it has.
const std::string kGoOn = "Control: 5\n";

class Session {
  public:
    Session(ByteStream& stream, const CommFile& format, const Answerer& answerer)
        : stream_(stream),
          parser_(format),
          answerer_(answerer),
          chunk_(format.chunk.value_or(stream.default_chunk())) {}

    /// Answers one step; false after the order to exit, which may end a step's queries (a program
    /// that calls us for a single step writes "Control: 8" behind them).
    bool step() {
        pass_.clear();
        while (true) {
            const std::string_view message = stream_.receive();
            const Control control = parser_.parse(message, pass_);
            pass_.step = control.step;
            if (control.is_exit) {
                pass_.queries.empty() ? stream_.send(kGoOn, Continuation::done) : answer(control);
                stream_.finish();
                return false;
            }
            if (control.is_last) {
                answer(control);
                return true;
            }
            stream_.send(kGoOn, Continuation::done);
        }
    }

  private:
    /// After queries that came with the order to exit, the simulator may close its end of the line
    /// at once: nothing more is awaited from it.
    void answer(const Control& control) {
        trailing_.remove(pass_, parser_.style());
        answers_.clear();
        const auto check = [&] {
            if (!control.is_exit) {
                stream_.check();
            }
        };
        answerer_(pass_, check, answers_);
        const std::vector<std::string> chunks =
            reply_chunks(pass_, answers_, chunk_, stream_.capacity());
        for (std::size_t i = 0; i < chunks.size(); ++i) {
            const bool is_last = i + 1 == chunks.size();
            stream_.send(chunks[i], is_last ? Continuation::done : Continuation::more_follows);
        }
    }

    ByteStream& stream_;
    MessageParser parser_;
    const Answerer& answerer_;
    std::size_t chunk_;
    TrailingValues trailing_;
    Pass pass_;
    Answers answers_;
};

}  // namespace

std::vector<std::string> reply_chunks(
    const Pass& pass, const Answers& answers, std::size_t chunk, std::size_t capacity) {
    constexpr std::size_t kControlLine = 11;
    constexpr std::size_t kUsualLine = 24;
    std::vector<std::string> texts(1);
    texts.back().reserve(kUsualLine * std::min(chunk, answers.list.size()));
    std::string line;
    std::size_t count = 0;
    for (const Answer& answer : answers.list) {
        const Query& query = pass.queries[answer.query];
        line.clear();
        append_answer(
            line, query.id, query.slots,
            std::span(answers.values).subspan(answer.values.first, answer.values.count));
        const bool is_full = texts.back().size() + line.size() + kControlLine > capacity;
        if (count == chunk || is_full) {
            texts.emplace_back();
            count = 0;
        }
        texts.back() += line;
        ++count;
    }
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const bool is_first = i == 0, is_last = i + 1 == texts.size();
        append_control(
            texts[i], is_first && is_last ? ChunkPlace::only
                      : is_first          ? ChunkPlace::first
                      : is_last           ? ChunkPlace::last
                                          : ChunkPlace::middle);
    }
    return texts;
}

void serve(ByteStream& stream, const CommFile& format, const Answerer& answerer) {
    Session session(stream, format, answerer);
    try {
        while (session.step()) {
        }
    } catch (const PeerDisconnected&) {
        throw;
    } catch (...) {
        // We end with a message; the simulator must not wait for us forever.
        stream.send(kGoOn, Continuation::done);
        throw;
    }
}

}  // namespace quasimc
