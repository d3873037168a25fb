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
#include "coupling/protocol/semaphore_stream.h"
#include "files/descriptor.h"

namespace quasimc {
namespace {

struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

off_t as_offset(std::size_t offset) {
    return static_cast<off_t>(offset);
}

/// Opens a file for writing without emptying it.
int open_cached(const std::string& path) {
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
}

/// Returns whether all of the text was written; sets errno otherwise.
bool write_at(const Descriptor& file, std::string_view text, std::size_t offset) {
    while (!text.empty()) {
        const ssize_t count = ::pwrite(file.number(), text.data(), text.size(), as_offset(offset));
        if (count < 0 && errno != EINTR) {
            return false;
        }
        const auto written = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
        text.remove_prefix(written);
        offset += written;
    }
    return true;
}

[[noreturn]] void fail(const std::string& path, const char* problem, int error) {
    throw InputError({{path, problem, std::generic_category().message(error), ""}});
}

class FilePair {
  public:
    static constexpr std::size_t kCapacity = std::numeric_limits<std::size_t>::max();
    static constexpr std::size_t kDefaultChunk = 1000;

    explicit FilePair(const std::string& extension)
        : to_us_(".to_field" + extension), from_us_(".from_field" + extension) {}

    [[nodiscard]] const std::string& name() const { return to_us_; }
    void remove() const {
        std::remove(to_us_.c_str());
        std::remove(from_us_.c_str());
    }
    /// Makes the head of the file an empty answer, which the simulator reads if this process ends
    /// before it answers.
    void prepare_for_our_end() const noexcept {
        const Descriptor file(open_cached(from_us_));
        static_cast<void>(write_at(file, kEmptyAnswer, 0));
    }
    /// Writes the head last, so that at any time the file begins with a message that is whole.
    void write(std::string_view message) const {
        EXPECT(message.size() >= kEmptyAnswer.size());
        const Descriptor file(open_cached(from_us_));
        const std::size_t head = kEmptyAnswer.size();
        const bool is_written = file.is_open() && write_at(file, message.substr(head), head) &&
                                ::ftruncate(file.number(), as_offset(message.size())) == 0 &&
                                write_at(file, message.substr(0, head), 0);
        if (!is_written) {
            fail(from_us_, "can't be written", errno);
        }
    }
    void read(std::string& text) const {
        const File file(std::fopen(to_us_.c_str(), "rb"));
        if (!file) {
            fail(to_us_, "can't be read", errno);
        }
        constexpr std::size_t kPiece = 262144;
        std::size_t count = 0;
        text.clear();
        do {
            text.resize(count + kPiece);
            const std::size_t more = std::fread(text.data() + count, 1, kPiece, file.get());
            count += more;
            text.resize(count);
        } while (std::feof(file.get()) == 0 && std::ferror(file.get()) == 0);
    }

  private:
    std::string to_us_, from_us_;
};

}  // namespace

std::unique_ptr<ByteStream> make_file_stream(long key, const std::string& extension) {
    return std::make_unique<SemaphoreStream<FilePair>>(key, extension);
}

}  // namespace quasimc
