#include "coupling/protocol/session.h"

#include <algorithm>

#include "coupling/protocol/trailing_values.h"

namespace quasimc {
namespace {

/// Parses the Control line of a message; an unreadable one counts as the last chunk.
Control control_of(std::string_view message) {
    const std::size_t before = message.find_last_of('\n', message.size() - 2);
    const std::string_view line =
        before == std::string_view::npos ? message : message.substr(before + 1);
    Pass nothing;
    try {
        return MessageParser({}).parse(line, nothing);
    } catch (const InputError&) {
        return {};
    }
}

class Session {
  public:
    Session(ByteStream& stream, const CommFile& format, const Answerer& answerer)
        : stream_(stream),
          parser_(format),
          answerer_(answerer),
          chunk_(format.chunk.value_or(stream.default_chunk())) {}

    /// Answers one step; false after the order to exit.
    bool step(const StepListener& on_step) {
        fault_ = nullptr;
        pass_.clear();
        answers_.clear();
        Control control = take_message();
        while (!control.is_exit && !control.is_last) {
            stream_.send(kEmptyAnswer, Continuation::done);
            control = take_message();
        }
        pass_.step = control.step;
        const bool is_step = !control.is_exit || !pass_.queries.empty() || fault_;
        if (is_step && !fault_) {
            guarded([&] { compute(control); });
        }
        send_answers(control);
        if (is_step) {
            on_step(steps_++, fault_);
        }
        return !control.is_exit;
    }

  private:
    /// Does `work` and records its exception; rethrows it if the simulator is gone.
    template <typename Work>
    void guarded(const Work& work) {
        try {
            work();
        } catch (const PeerDisconnected&) {
            throw;
        } catch (...) {
            fault_ = fault_ ? fault_ : std::current_exception();
        }
    }

    Control take_message() {
        std::string_view message;
        Control control;
        bool is_read = false;
        guarded([&] {
            message = stream_.receive();
            control = control_of(message);
            is_read = true;
        });
        if (is_read && !fault_) {
            guarded([&] { control = parser_.parse(message, pass_); });
        }
        return control;
    }

    /// After queries with the order to exit, the simulator may close its end of the connection at
    /// once, so nothing more is awaited.
    void compute(const Control& control) {
        trailing_.remove(pass_, parser_.style());
        const auto check = [&] {
            if (!control.is_exit) {
                stream_.check();
            }
        };
        answerer_(pass_, check, answers_);
    }

    /// Sends the answers computed so far; an empty answer if they can't be written.
    void send_answers(const Control& control) {
        const auto send_end = [&](std::string_view text) {
            control.is_exit ? stream_.send_last(text) : stream_.send(text, Continuation::done);
        };
        bool is_sent = false;
        guarded([&] {
            const std::vector<std::string> chunks =
                reply_chunks(pass_, answers_, chunk_, stream_.capacity());
            for (std::size_t i = 0; i + 1 < chunks.size(); ++i) {
                stream_.send(chunks[i], Continuation::more_follows);
                stream_.await_request();
            }
            send_end(chunks.back());
            is_sent = true;
        });
        if (!is_sent) {
            send_end(kEmptyAnswer);
        }
    }

    ByteStream& stream_;
    MessageParser parser_;
    const Answerer& answerer_;
    std::size_t chunk_;
    TrailingValues trailing_;
    Pass pass_;
    Answers answers_;
    std::exception_ptr fault_;
    std::uint64_t steps_ = 0;
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
            texts[i], is_first && is_last ? ChunkPosition::only
                      : is_first          ? ChunkPosition::first
                      : is_last           ? ChunkPosition::last
                                          : ChunkPosition::middle);
    }
    return texts;
}

void serve(
    ByteStream& stream,
    const CommFile& format,
    const Answerer& answerer,
    const StepListener& on_step) {
    Session session(stream, format, answerer);
    while (session.step(on_step)) {
    }
}

void serve_nothing(ByteStream& stream) {
    while (true) {
        bool is_exit = false;
        try {
            is_exit = control_of(stream.receive()).is_exit;
        } catch (const InputError&) {
            is_exit = false;  // no message: it waits for an answer all the same
        }
        if (is_exit) {
            stream.send_last(kEmptyAnswer);
            return;
        }
        stream.send(kEmptyAnswer, Continuation::done);
    }
}

}  // namespace quasimc
