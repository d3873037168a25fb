#include "coupling/protocol/descriptor_stream.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <system_error>

#include <poll.h>
#include <unistd.h>

#include <sys/ioctl.h>

#include "coupling/protocol/messages.h"

namespace quasimc {
namespace {

/// The byte sent at the start and at the end of a session.
constexpr char kSign = '\x01';
/// The byte of a refusal, sent instead of the first sign.
constexpr char kNoSign = '\0';

[[noreturn]] void gone(const char* what) {
    throw PeerDisconnected(std::string("the plant simulator has ended: ") + what);
}

}  // namespace

DescriptorStream::~DescriptorStream() {
    if (ownership_ == Ownership::owned) {
        ::close(in_);
        if (out_ != in_) {
            ::close(out_);
        }
    }
}

void DescriptorStream::announce() {
    write_all({&kSign, 1});
}

RejectAction DescriptorStream::refuse() {
    write_all({&kNoSign, 1});
    return RejectAction::continues;
}

std::string_view DescriptorStream::receive() {
    buffer_.erase(0, taken_);
    taken_ = 0;
    MessageEndFinder finder;
    while (true) {
        const std::size_t end = finder.find(buffer_);
        if (end != std::string::npos) {
            taken_ = end;
            return std::string_view(buffer_).substr(0, end);
        }
        if (!read_some()) {
            end_input();
        }
    }
}

void DescriptorStream::end_input() {
    // A file may lack the end of its last line.
    const std::size_t last_line = buffer_.rfind('\n') + 1;  // 0 if there is none
    const std::string_view line = std::string_view(buffer_).substr(last_line);
    constexpr std::string_view kDigits = "0123456789";
    if (line.starts_with("Control") && line.find_first_of(kDigits) != std::string_view::npos) {
        buffer_ += '\n';
        return;
    }
    const bool is_blank = buffer_.find_first_not_of(" \t\r\n") == std::string::npos;
    gone(is_blank ? "its input ended without a command to exit" : "its last message is incomplete");
}

bool DescriptorStream::read_some() {
    constexpr std::size_t kPiece = 262144;
    piece_.resize(kPiece);
    ssize_t count = 0;
    do {
        count = ::read(in_, piece_.data(), piece_.size());
    } while (count < 0 && errno == EINTR);
    if (count < 0 && errno != ECONNRESET) {
        gone(std::generic_category().message(errno).c_str());
    }
    keep(std::string_view(piece_).substr(0, static_cast<std::size_t>(std::max<ssize_t>(count, 0))));
    return count > 0;
}

void DescriptorStream::keep(std::string_view bytes) {
    while (!bytes.empty()) {
        const std::size_t end = bytes.find('\n');
        const std::string_view text = bytes.substr(0, end);
        buffer_ += text.substr(0, kLongestLine - line_size_);
        line_size_ = std::min(line_size_ + text.size(), kLongestLine);
        if (end == std::string_view::npos) {
            return;
        }
        buffer_ += '\n';
        line_size_ = 0;
        bytes.remove_prefix(end + 1);
    }
}

void DescriptorStream::send(std::string_view message, Continuation /*continuation*/) {
    write_all(message);
}

void DescriptorStream::write_all(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(out_, bytes.data(), bytes.size());
        if (count < 0 && (errno == EPIPE || errno == ECONNRESET)) {
            gone("it no longer reads our answers");
        }
        if (count < 0 && errno != EINTR) {
            // The input is a file or empty; there may be no simulator.
            throw PeerDisconnected(
                "the answers can't be written: " + (errno == EBADF
                                                        ? "standard output is closed"
                                                        : std::generic_category().message(errno)));
        }
        bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
}

void DescriptorStream::check() {
    std::array<pollfd, 2> ends{{{in_, POLLRDHUP, 0}, {out_, 0, 0}}};
    if (::poll(ends.data(), ends.size(), 0) <= 0) {
        return;
    }
    if ((ends[1].revents & (POLLHUP | POLLERR)) != 0) {
        gone("it no longer reads our answers");
    }
    // The end of input comes after further messages (of a recorded session).
    int unread = 0;
    const bool has_more =
        buffer_.size() > taken_ || (::ioctl(in_, FIONREAD, &unread) == 0 && unread > 0);
    if ((ends[0].revents & (POLLHUP | POLLRDHUP | POLLERR)) != 0 && !has_more) {
        gone("it closed the connection during a computation");
    }
}

void DescriptorStream::send_last(std::string_view message) {
    try {
        write_all(std::string(message) + kSign);
    } catch (const PeerDisconnected&) {
        return;  // the simulator has ordered the exit
    }
}

void DescriptorStream::close() noexcept {
    pollfd end{out_, POLLOUT, 0};
    if (::poll(&end, 1, 0) > 0 && (end.revents & POLLOUT) != 0) {
        static_cast<void>(::write(out_, kEmptyAnswer.data(), kEmptyAnswer.size()) < 0);
    }
}

std::size_t DescriptorStream::capacity() const {
    return std::numeric_limits<std::size_t>::max();
}

std::unique_ptr<ByteStream> make_pipe_stream(int in, int out) {
    return std::make_unique<DescriptorStream>(in, out, DescriptorStream::Ownership::borrowed);
}

}  // namespace quasimc
