#include "files/spool.h"

#include <array>
#include <cerrno>
#include <system_error>

#include "quasimc/error.h"

namespace quasimc {
namespace {

[[noreturn]] void fail(const char* problem) {
    throw InputError({{"temporary file", problem, std::generic_category().message(errno), ""}});
}

}  // namespace

void Spool::add(std::string_view text) {
    if (!file_) {
        file_.reset(std::tmpfile());
    }
    if (!file_ || std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) {
        fail("can't be written");
    }
}

void Spool::copy_to(const TextSink& sink) {
    if (!file_) {
        return;
    }
    if (std::fflush(file_.get()) != 0) {
        fail("can't be written");
    }
    std::rewind(file_.get());
    std::array<char, 1 << 16> piece{};
    while (const std::size_t size = std::fread(piece.data(), 1, piece.size(), file_.get())) {
        sink({piece.data(), size});
    }
    if (std::ferror(file_.get()) != 0) {
        fail("can't be read");
    }
}

}  // namespace quasimc
