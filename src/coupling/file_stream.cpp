// Messages in two files of the working folder, handed over with semaphores.

#include <cerrno>
#include <cstdio>
#include <limits>
#include <memory>
#include <system_error>

#include "coupling/byte_stream.h"
#include "coupling/messages.h"
#include "coupling/semaphores.h"

namespace quasimc {
namespace {

struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

[[noreturn]] void fail(const std::string& path, const char* problem, int error) {
    throw InputError({{path, problem, std::generic_category().message(error), ""}});
}

class FileStream final : public ByteStream {
  public:
    FileStream(long key, const std::string& extension)
        : semaphores_(key), to_us_(".to_field" + extension), from_us_(".from_field" + extension) {
        semaphores_.announce();
    }
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

    [[nodiscard]] std::string_view receive() override {
        semaphores_.wait_for_master();
        read();
        const std::size_t end = message_end(buffer_);
        if (end == std::string::npos) {
            throw InputError({{to_us_, "the message breaks off", "it has no line 'Control'", ""}});
        }
        return std::string_view(buffer_).substr(0, end);
    }
    void send(std::string_view message, Continuation continuation) override {
        const File file(std::fopen(from_us_.c_str(), "wb"));
        if (!file || std::fwrite(message.data(), 1, message.size(), file.get()) < message.size() ||
            std::fflush(file.get()) != 0) {
            fail(from_us_, "can't be written", errno);
        }
        semaphores_.post_to_master();
        if (continuation == Continuation::more_follows) {
            semaphores_.wait_for_master();
        }
    }
    void check() override { semaphores_.check(); }
    void finish() override {}
    [[nodiscard]] std::size_t capacity() const override {
        return std::numeric_limits<std::size_t>::max();
    }
    [[nodiscard]] std::size_t default_chunk() const override { return 1000; }

  private:
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
