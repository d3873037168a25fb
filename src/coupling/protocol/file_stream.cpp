// Messages in two files of the working folder, handed over with semaphores.

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <limits>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "base/checks.h"
#include "coupling/protocol/byte_stream.h"
#include "coupling/protocol/messages.h"
#include "coupling/protocol/semaphores.h"
#include "files/descriptor.h"

namespace quasimc {
namespace {

struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

off_t as_offset(std::size_t place) {
    return static_cast<off_t>(place);
}

/// A file that is written without being emptied first.
int open_kept(const std::string& path) {
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
}

/// Whether all of the text was written there; errno otherwise.
bool write_at(const Descriptor& file, std::string_view text, std::size_t place) {
    while (!text.empty()) {
        const ssize_t count = ::pwrite(file.number(), text.data(), text.size(), as_offset(place));
        if (count < 0 && errno != EINTR) {
            return false;
        }
        const auto written = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
        text.remove_prefix(written);
        place += written;
    }
    return true;
}

[[noreturn]] void fail(const std::string& path, const char* problem, int error) {
    throw InputError({{path, problem, std::generic_category().message(error), ""}});
}

class FileStream final : public ByteStream {
  public:
    FileStream(long key, const std::string& extension)
        : semaphores_(key), to_us_(".to_field" + extension), from_us_(".from_field" + extension) {}
    ~FileStream() override {
        // The simulator removes what it made, and our file; if it died, nobody else does.
        if (semaphores_.master_died()) {
            std::remove(to_us_.c_str());
            std::remove(from_us_.c_str());
            semaphores_.remove();
        }
    }

    FileStream(const FileStream&) = delete;
    FileStream& operator=(const FileStream&) = delete;

    void announce() override {
        write(kEmptyAnswer);
        semaphores_.announce();
    }
    /// lpfg takes silence for an answer that is there, and waits for the next one for ever.
    [[nodiscard]] AfterRefusal refuse() override {
        announce();
        return AfterRefusal::it_asks;
    }
    [[nodiscard]] std::string_view receive() override {
        semaphores_.wait_for_master();
        prepare_for_our_end();
        read();
        const std::size_t end = message_end(buffer_);
        if (end == std::string::npos) {
            throw InputError({{to_us_, "the message breaks off", "it has no line 'Control'", ""}});
        }
        return std::string_view(buffer_).substr(0, end);
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
    void resign() noexcept override {
        prepare_for_our_end();
        semaphores_.post_forever();
    }
    [[nodiscard]] std::size_t capacity() const override {
        return std::numeric_limits<std::size_t>::max();
    }
    [[nodiscard]] std::size_t default_chunk() const override { return 1000; }

  private:
    /// What the simulator reads if we come to an end before we have answered: the head of the file
    /// becomes an empty answer, behind which nothing is read.
    void prepare_for_our_end() const noexcept {
        const Descriptor file(open_kept(from_us_));
        static_cast<void>(write_at(file, kEmptyAnswer, 0));
    }
    /// Writes the head last, so that at any time the file begins with a message that is whole.
    void write(std::string_view message) const {
        EXPECT(message.size() >= kEmptyAnswer.size());
        const Descriptor file(open_kept(from_us_));
        const std::size_t head = kEmptyAnswer.size();
        const bool is_written = file.is_open() && write_at(file, message.substr(head), head) &&
                                ::ftruncate(file.number(), as_offset(message.size())) == 0 &&
                                write_at(file, message.substr(0, head), 0);
        if (!is_written) {
            fail(from_us_, "can't be written", errno);
        }
    }
    /// If not even an empty answer can be written, what stands in the file must do.
    void write_answer(std::string_view message) const {
        try {
            write(message);
        } catch (const InputError&) {
            if (message != kEmptyAnswer) {
                throw;
            }
        }
    }
    void read() {
        const File file(std::fopen(to_us_.c_str(), "rb"));
        if (!file) {
            fail(to_us_, "can't be read", errno);
        }
        constexpr std::size_t kPiece = 262144;
        std::size_t count = 0;
        buffer_.clear();
        do {
            buffer_.resize(count + kPiece);
            const std::size_t more = std::fread(buffer_.data() + count, 1, kPiece, file.get());
            count += more;
            buffer_.resize(count);
        } while (std::feof(file.get()) == 0 && std::ferror(file.get()) == 0);
    }

    SemaphorePair semaphores_;
    std::string to_us_, from_us_;
    std::string buffer_;
};

}  // namespace

std::unique_ptr<ByteStream> make_file_stream(long key, const std::string& extension) {
    return std::make_unique<FileStream>(key, extension);
}

}  // namespace quasimc
