#include "text/json.h"

#include <nlohmann/json.hpp>

namespace quasimc {
namespace {

constexpr std::size_t kJsonPiece = 1 << 16;

std::string dumped(const Json& value, int indent) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string json_text(const Json& value) {
    return dumped(value, -1);
}

std::string json_text_with(const Json& object, std::string_view key, std::string_view value) {
    std::string text = json_text(object);
    text.pop_back();
    text += object.empty() ? "" : ",";
    return text.append(json_text(key)).append(":").append(value).append("}");
}

void append_json(std::string& list, const Json& value) {
    list += (list.empty() ? "" : ",") + json_text(value);
}

void JsonLines::begin(char bracket, std::string_view key) {
    separate();
    out_ += key.empty() ? "" : json_text(key) + ": ";
    out_ += bracket;
    is_first_ = true;
}

void JsonLines::end(char bracket) {
    out_ += '\n';
    text({&bracket, 1});
    is_first_ = false;
}

void JsonLines::line(std::string_view json) {
    separate();
    text(json);
}

void JsonLines::members(const Json& object) {
    for (const auto& member : object.items()) {
        line(json_text(member.key()) + ": " + dumped(member.value(), 2));
    }
}

void JsonLines::text(std::string_view text) {
    out_ += text;
    if (out_.size() >= kJsonPiece) {
        flush();
    }
}

void JsonLines::flush() {
    sink_(out_);
    out_.clear();
}

void JsonLines::separate() {
    out_ += !is_first_ ? ",\n" : is_begun_ ? "\n" : "";
    is_begun_ = true;
    is_first_ = false;
}

}  // namespace quasimc
