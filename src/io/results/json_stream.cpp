#include "io/results/json_stream.h"

#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/checks.h"

namespace quasimc {
namespace {

constexpr std::size_t kJsonPiece = 1 << 16;
constexpr std::size_t kIndent = 2;

}  // namespace

std::string JsonStream::quoted(std::string_view text) {
    using Json = nlohmann::json;
    return Json(std::string(text)).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void JsonStream::begin(char bracket, JsonLayout layout) {
    separate();
    out_ += bracket;
    levels_.push_back({layout});
    indent_ += layout == JsonLayout::pretty ? kIndent : 0;
}

void JsonStream::end(char bracket) {
    EXPECT(!levels_.empty() && !has_key_);
    const Level level = levels_.back();
    levels_.pop_back();
    indent_ -= level.layout == JsonLayout::pretty ? kIndent : 0;
    if (level.layout == JsonLayout::rows ||
        (level.layout == JsonLayout::pretty && !level.is_empty)) {
        break_line();
    }
    out_ += bracket;
    flush_when_long();
}

void JsonStream::key(std::string_view name) {
    quoted_key(quoted(name));
}

void JsonStream::quoted_key(std::string_view name) {
    separate();
    out_ += name;
    out_ += levels_.back().layout == JsonLayout::compact ? ":" : ": ";
    has_key_ = true;
}

void JsonStream::text(std::string_view value) {
    raw(quoted(value));
}

void JsonStream::integer(std::int64_t value) {
    separate();
    fmt::format_to(std::back_inserter(out_), "{}", value);
}

void JsonStream::count(std::uint64_t value) {
    separate();
    fmt::format_to(std::back_inserter(out_), "{}", value);
}

void JsonStream::number(double value) {
    separate();
    if (std::isfinite(value)) {
        fmt::format_to(std::back_inserter(out_), "{}", value);
    } else {
        out_ += "null";
    }
}

void JsonStream::real(double value) {
    raw(nlohmann::json(value).dump());
}

void JsonStream::raw(std::string_view json) {
    separate();
    raw_continued(json);
}

void JsonStream::raw_continued(std::string_view json) {
    out_ += json;
    flush_when_long();
}

void JsonStream::flush() {
    sink_(out_);
    out_.clear();
}

std::string JsonStream::take() {
    EXPECT(levels_.empty() && !sink_);
    return std::exchange(out_, {});
}

/// What stands between the value, or its key, and what is before it.
void JsonStream::separate() {
    if (std::exchange(has_key_, false) || levels_.empty()) {
        return;
    }
    Level& level = levels_.back();
    const bool is_first = std::exchange(level.is_empty, false);
    out_ += is_first ? "" : ",";
    if (level.layout == JsonLayout::rows || level.layout == JsonLayout::pretty) {
        break_line();
    } else if (level.layout == JsonLayout::spaced && !is_first) {
        out_ += ' ';
    }
}

void JsonStream::break_line() {
    out_ += '\n';
    out_.append(indent_, ' ');
}

void JsonStream::flush_when_long() {
    if (sink_ && out_.size() >= kJsonPiece) {
        flush();
    }
}

}  // namespace quasimc
