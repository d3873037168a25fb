#pragma once

#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/range.h"
#include "base/vec3.h"
#include "quasimc/error.h"
#include "text/document.h"

namespace quasimc {

/// The names of the rows of a table or of a list, for suggestions.
template <typename Rows>
[[nodiscard]] std::vector<std::string_view> names_in(const Rows& rows) {
    std::vector<std::string_view> names;
    names.reserve(std::size(rows));
    for (const auto& row : rows) {
        names.push_back(row.name);
    }
    return names;
}

/// The name of a table in messages: "Scene.time" for the key "time".
struct TableName {
    std::string_view key, name;
};

/// How messages name the tables of a document: by its syntax, "[time]", or in the words of a
/// program that makes the document from its own objects.
class Vocabulary {
  public:
    Vocabulary() = default;
    /// @param names  of tables; they outlive this object
    explicit Vocabulary(std::span<const TableName> names) : names_(names) {}
    /// The name of a table; "[key]" if it has no other.
    [[nodiscard]] std::string name_of(std::string_view key) const;

  private:
    std::span<const TableName> names_;
};

/// Collects the faults and warnings of a document's reader.
struct Reporter {
    std::string file;  ///< name of the document
    Faults faults;
    std::vector<Warning> warnings;
    Vocabulary vocabulary = {};

    /// "leaves.toml:12", or "leaves.toml" if the line is unknown.
    [[nodiscard]] std::string where(std::uint32_t line) const;
    /// The name of a table of the document, for messages.
    [[nodiscard]] std::string table_name(std::string_view key) const {
        return vocabulary.name_of(key);
    }
    /// Whether there are too many faults to report more.
    [[nodiscard]] bool is_full() const { return faults.size() >= 100; }
    void fault(
        std::uint32_t line, std::string problem, std::string why, std::string suggestion = {});
    void warn(std::string text, std::uint32_t line = 0) {
        warnings.push_back({where(line), std::move(text)});
    }
    /// Adds the faults and warnings of another one.
    void add(const Reporter& other);
};

/// Reads one table: each key once, by its type. A value with a fault is reported and then absent;
/// finish() reports the keys that were not read.
class TableReader {
  public:
    /// @param what  name of the table in messages: "material 'leaf'", "[run]"
    TableReader(const Node& node, std::string what, Reporter& reporter);

    /// The value of a key, of any type, or null.
    [[nodiscard]] const Node* any(std::string_view key);
    [[nodiscard]] std::optional<std::string> text(std::string_view key);
    /// A time as a text or as a date-time of TOML, in ISO 8601.
    [[nodiscard]] std::optional<std::string> time_text(std::string_view key);
    /// A list of such times.
    [[nodiscard]] std::optional<std::vector<std::string>> time_texts(std::string_view key);
    [[nodiscard]] std::optional<bool> boolean(std::string_view key);
    [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key, Range range);
    [[nodiscard]] std::optional<double> real(std::string_view key, Range range = kFinite);
    [[nodiscard]] std::optional<Vec3> vector(std::string_view key);
    [[nodiscard]] std::optional<std::vector<Vec3>> vectors(std::string_view key);
    [[nodiscard]] std::optional<std::vector<std::string>> texts(std::string_view key);
    [[nodiscard]] std::optional<std::string> choice(
        std::string_view key, std::span<const std::string_view> names);
    /// The tables of a list of tables; empty if absent.
    [[nodiscard]] std::vector<const Node*> tables(std::string_view key);

    /// A number within the value of a key.
    [[nodiscard]] std::optional<double> real_at(
        std::string_view key, const Node& node, Range range);
    /// Two numbers [low, high] of a range, the first less than the second, in the value of a key.
    [[nodiscard]] std::optional<Range> interval_at(
        std::string_view key, const Node& node, Range range);
    /// A list of points within the value of a key.
    [[nodiscard]] std::optional<std::vector<Vec3>> vectors_at(
        std::string_view key, const Node& node);

    /// Reports that a key must be there.
    void missing(std::string_view key, const std::string& suggestion = {});
    /// Returns `value`, or reports that the key is missing, unless its value had a fault.
    template <typename T>
    std::optional<T> required(std::string_view key, std::optional<T> value) {
        if (!value && node_->find(key) == nullptr) {
            missing(key);
        }
        return value;
    }

    /// Reports a fault in this table.
    void fault(std::string problem, std::string why = {}, std::string suggestion = {});
    /// Reports a fault in the value of a key.
    void fault_at(
        std::string_view key,
        std::string problem,
        std::string why = {},
        std::string suggestion = {});
    void fault_at(
        const Node& node, std::string problem, std::string why = {}, std::string suggestion = {});
    void warn_at(const Node& node, std::string text);
    /// Adds a warning about this table.
    void warn(std::string text) { reporter_->warnings.push_back({where(), std::move(text)}); }

    /// Reports the keys that were not read.
    void finish();
    /// Whether this table has had faults so far.
    [[nodiscard]] bool failed() const { return reporter_->faults.size() > faults_before_; }

    [[nodiscard]] const std::string& what() const { return what_; }
    /// The name of a table of the document, for messages.
    [[nodiscard]] std::string table_name(std::string_view key) const {
        return reporter_->table_name(key);
    }
    void rename(std::string what) { what_ = std::move(what); }
    [[nodiscard]] std::uint32_t line() const { return node_->line; }
    [[nodiscard]] std::string where() const { return reporter_->where(node_->line); }
    [[nodiscard]] Reporter& reporter() { return *reporter_; }

    static constexpr Range kFinite{-1.7976931348623157e308, 1.7976931348623157e308};
    static constexpr Range kNotNegative{0, kFinite.high};
    /// Range of amounts of light that can be computed.
    static constexpr Range kLight{0, 1e15};

  private:
    template <typename T>
    [[nodiscard]] std::optional<T> typed(std::string_view key, std::string_view expected);
    /// @param read  reads an item; @param items  name of the items in messages: "times"
    [[nodiscard]] std::optional<std::vector<std::string>> list_of(
        std::string_view key,
        std::optional<std::string> (*read)(const Node& node),
        std::string_view items);
    [[nodiscard]] std::optional<Vec3> vector_of(std::string_view key, const Node& node);
    void wrong_type(std::string_view key, const Node& node, std::string_view expected);

    const Node* node_;
    std::string what_;
    Reporter* reporter_;
    std::size_t faults_before_;
    std::vector<std::string_view> known_;
};

}  // namespace quasimc
