#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "coupling/protocol/byte_stream.h"
#include "coupling/protocol/messages.h"
#include "coupling/protocol/semaphores.h"

namespace quasimc {

/// Messages in a mailbox that both sides open (a pair of files, or shared memory), synchronized by
/// a pair of semaphores.
///
/// A mailbox reads the whole text that is there, writes an answer whose head becomes visible last,
/// makes the head of an answer an empty one (prepare_for_our_end), and can be removed.
template <typename Mailbox>
class SemaphoreStream final : public ByteStream {
  public:
    template <typename... Arguments>
    explicit SemaphoreStream(long key, Arguments&&... arguments)
        : semaphores_(key), mailbox_(std::forward<Arguments>(arguments)...) {}
    ~SemaphoreStream() override {
        // The simulator removes its mailbox and the answers, unless it has died.
        if (semaphores_.master_died()) {
            mailbox_.remove();
            semaphores_.remove();
        }
    }
    SemaphoreStream(const SemaphoreStream&) = delete;
    SemaphoreStream& operator=(const SemaphoreStream&) = delete;

    void announce() override {
        mailbox_.write(kEmptyAnswer);
        semaphores_.announce();
    }
    /// Without a sign lpfg assumes an answer and waits forever for the next one; cpfg assumes a
    /// refusal, but then leaves its semaphores and memory behind.
    [[nodiscard]] RejectAction refuse() override {
        announce();
        return RejectAction::keeps_asking;
    }
    [[nodiscard]] std::string_view receive() override {
        semaphores_.wait_for_master();
        mailbox_.prepare_for_our_end();
        mailbox_.read(message_);
        const std::size_t end = message_end(message_);
        if (end == std::string::npos) {
            throw InputError(
                {{mailbox_.name(), "the message is incomplete", "the line 'Control' is missing",
                  ""}});
        }
        message_.resize(end);
        return message_;
    }
    void send(std::string_view message, Continuation /*continuation*/) override {
        write_answer(message);
        semaphores_.post_to_master();
    }
    void send_last(std::string_view message) override {
        write_answer(message);
        semaphores_.post_last();
    }
    void await_request() override { semaphores_.wait_for_master(); }
    void check() override { semaphores_.check(); }
    void close() noexcept override {
        mailbox_.prepare_for_our_end();
        semaphores_.post_forever();
    }
    [[nodiscard]] std::size_t capacity() const override { return Mailbox::kCapacity; }
    [[nodiscard]] std::size_t default_chunk() const override { return Mailbox::kDefaultChunk; }

  private:
    /// Writes an answer; if even an empty one can't be written, the content of the mailbox remains.
    void write_answer(std::string_view message) const {
        try {
            mailbox_.write(message);
        } catch (const InputError&) {
            if (message != kEmptyAnswer) {
                throw;
            }
        }
    }

    SemaphorePair semaphores_;
    Mailbox mailbox_;
    std::string message_;
};

}  // namespace quasimc
