#pragma once

// Parts of the readers of JSON. Included only by sources, as the library takes long to compile.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "quasimc/error.h"
#include "text/document.h"

namespace quasimc {

[[noreturn]] inline void refuse_json(
    const std::string& file, const std::string& problem, const std::string& why = {}) {
    throw InputError({{file, problem, why, ""}});
}

inline void check_depth(std::size_t depth, const std::string& file) {
    if (depth >= static_cast<std::size_t>(kDeepestNesting)) {
        refuse_json(
            file, "is nested too deeply", fmt::format("{} levels at most", kDeepestNesting));
    }
}

/// Builds nodes from the events of the parser.
class JsonNodeBuilder : public nlohmann::json_sax<nlohmann::ordered_json> {
  public:
    explicit JsonNodeBuilder(const std::string& file) : file_(file) {}

    bool null() override { return add({Node::Other{"null"}}); }
    bool boolean(bool value) override { return add({value}); }
    bool number_integer(std::int64_t value) override { return add({value}); }
    bool number_unsigned(std::uint64_t value) override {
        constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();
        return value <= kMost ? add({static_cast<std::int64_t>(value)})
                              : add({static_cast<double>(value)});
    }
    bool number_float(double value, const std::string& /*text*/) override { return add({value}); }
    bool string(std::string& value) override { return add({std::move(value)}); }
    bool binary(nlohmann::ordered_json::binary_t& /*value*/) override { return false; }
    bool start_object(std::size_t /*size*/) override { return open({Node::Table()}); }
    bool start_array(std::size_t /*size*/) override { return open({Node::List()}); }
    bool key(std::string& value) override {
        key_ = std::move(value);
        return true;
    }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool parse_error(
        std::size_t position,
        const std::string& /*token*/,
        const nlohmann::detail::exception& error) override {
        constexpr int kOutOfRange = 406;
        refuse_json(
            file_, error.id == kOutOfRange ? "a number is too large"
                                           : fmt::format("byte {} is not JSON", position));
    }

    Node result;

  protected:
    [[nodiscard]] const std::string& file() const { return file_; }
    /// The open tables and lists around the next value.
    [[nodiscard]] const std::vector<Node*>& open() const { return open_; }
    [[nodiscard]] const std::string& key() const { return key_; }

  private:
    bool add(Node node) {
        put(std::move(node));
        return true;
    }

    Node& put(Node node) {
        if (open_.empty()) {
            result = std::move(node);
            return result;
        }
        if (auto* list = std::get_if<Node::List>(&open_.back()->value)) {
            return list->emplace_back(std::move(node));
        }
        auto& table = std::get<Node::Table>(open_.back()->value);
        return table.emplace_back(Member{std::move(key_), 0, std::move(node)}).node;
    }

    bool open(Node node) {
        check_depth(open_.size(), file_);
        open_.push_back(&put(std::move(node)));
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    const std::string& file_;
    std::vector<Node*> open_;  // a list or table grows only while it is the innermost
    std::string key_;
};

}  // namespace quasimc
