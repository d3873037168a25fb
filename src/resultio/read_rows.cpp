#include "resultio/read_rows.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "text/json_builder.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 3> kLists{"organs", "groups", "sensors"};

template <typename Names>
bool is_one_of(std::string_view name, const Names& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// A builder that takes rows of organs, groups and sensors out of a result, of which there may be
/// millions.
class RowsBuilder : public JsonNodeBuilder {
  public:
    RowsBuilder(
        const std::string& file,
        const RowsQuery& query,
        const std::function<void(PlacedRows)>& take)
        : JsonNodeBuilder(file), query_(query), take_(take) {
        for (std::size_t i = 0; i < query.columns.size(); ++i) {
            std::string path;
            for (const std::string& name : query.columns[i]) {
                path += '\n' + name;
            }
            columns_[path].push_back(i);
        }
    }

    bool null() override { return depth_ > 0 || JsonNodeBuilder::null(); }
    bool boolean(bool value) override { return depth_ > 0 || JsonNodeBuilder::boolean(value); }
    bool number_integer(std::int64_t value) override {
        return add_number(static_cast<double>(value)) || JsonNodeBuilder::number_integer(value);
    }
    bool number_unsigned(std::uint64_t value) override {
        return add_number(static_cast<double>(value)) || JsonNodeBuilder::number_unsigned(value);
    }
    bool number_float(double value, const std::string& text) override {
        return add_number(value) || JsonNodeBuilder::number_float(value, text);
    }
    bool string(std::string& value) override {
        return depth_ > 0 || JsonNodeBuilder::string(value);
    }
    bool start_object(std::size_t size) override {
        return enters() || JsonNodeBuilder::start_object(size);
    }
    bool start_array(std::size_t size) override {
        return enters() || JsonNodeBuilder::start_array(size);
    }
    bool end_object() override { return leaves() || JsonNodeBuilder::end_object(); }
    bool end_array() override { return leaves() || JsonNodeBuilder::end_array(); }
    bool key(std::string& value) override {
        if (depth_ == 0) {
            return JsonNodeBuilder::key(value);
        }
        row_key_ = value;
        return true;
    }

  private:
    enum class Entry { build, skip, take };

    /// Decides how a table or a list that begins is read. Sets the position of the rows.
    Entry entry() {
        using Rest = RowsQuery::Rest;
        std::vector<std::string_view> steps = steps_to_next();
        position_ = {};
        std::size_t at = 0;
        const auto has_item = [&] {
            return at + 1 < steps.size() && open()[at + 1]->as<Node::List>() != nullptr;
        };
        if (has_item() && steps[0] == "points") {
            position_.point = number_at(0);
            at = 2;
        }
        if (at < steps.size() && steps[at] == "total") {
            position_.part = steps[at++];
        } else if (has_item() && (steps[at] == "time_steps" || steps[at] == "days")) {
            position_.part = steps[at];
            position_.index = number_at(at);
            at += 2;
        }
        const std::size_t behind = steps.size() - at;
        if (behind == 1 && is_one_of(steps[at], kLists)) {
            return entry_of_rows(steps[at]);
        }
        const bool leads_to_rows =
            behind == 0 || (behind == 1 && position_.part.empty() &&
                            ((at == 0 && steps[at] == "points") || steps[at] == "time_steps" ||
                             steps[at] == "days"));
        const bool is_built = steps.empty() || query_.rest == Rest::all ||
                              (query_.rest == Rest::labels) == leads_to_rows;
        return is_built ? Entry::build : Entry::skip;
    }

    Entry entry_of_rows(std::string_view list) {
        position_.label = text_in(*open().back(), position_.part == "days" ? "date" : "time");
        list_ = list;
        const bool is_requested = is_one_of(list, query_.lists) &&
                                  position_.part == query_.part.value_or(position_.part) &&
                                  position_.point == query_.point.value_or(position_.point) &&
                                  position_.label.starts_with(query_.label);
        if (is_requested && !columns_.empty()) {
            return Entry::take;
        }
        return list == "groups" && query_.rest == RowsQuery::Rest::all ? Entry::build : Entry::skip;
    }

    /// The keys that lead to the value that begins; "" denotes an item of a list.
    [[nodiscard]] std::vector<std::string_view> steps_to_next() const {
        std::vector<std::string_view> steps;
        for (std::size_t i = 0; i < open().size(); ++i) {
            const auto* table = open()[i]->as<Node::Table>();
            steps.push_back(
                table == nullptr         ? std::string_view()
                : i + 1 == open().size() ? JsonNodeBuilder::key()
                                         : std::string_view(table->back().key));
        }
        return steps;
    }

    /// The number of the item behind a step, in a list that is open.
    [[nodiscard]] std::size_t number_at(std::size_t step) const {
        const std::size_t level = step + 1;
        const std::size_t size = open()[level]->as<Node::List>()->size();
        return level + 1 == open().size() ? size : size - 1;
    }

    /// @returns whether the value that begins is skipped
    bool enters() {
        if (depth_ == 0) {
            const Entry next = entry();
            takes_ = next == Entry::take;
            rows_ = {};
            rows_.resize(query_.columns.size());
            row_ = 0;
            depth_ = next == Entry::build ? 0 : 1;
            return depth_ > 0;
        }
        check_depth(open().size() + depth_, file());
        if (++depth_ > 2 && takes_) {
            ends_.push_back(path_.size());
            path_.append("\n").append(row_key_);
            const auto found = columns_.find(path_);
            selected_ = found == columns_.end() ? nullptr : &found->second;
            estimate_ = kUnknownEstimate;
        }
        return true;
    }

    bool leaves() {
        if (depth_ == 0) {
            return false;
        }
        --depth_;
        if (depth_ >= 2 && takes_) {
            for (const std::size_t column : selected_ == nullptr ? kNoColumns : *selected_) {
                rows_[column].resize(row_, kUnknownEstimate);
                rows_[column].push_back(estimate_);
            }
            selected_ = nullptr;
            path_.resize(ends_.back());
            ends_.pop_back();
        }
        row_ += depth_ == 1 ? 1 : 0;
        if (depth_ == 0 && takes_ && row_ > 0) {
            take_({position_, list_, std::move(rows_)});
        }
        return true;
    }

    /// @returns whether it is a number of a row
    bool add_number(double value) {
        if (selected_ != nullptr) {
            (row_key_ == "mean"             ? estimate_.mean
             : row_key_ == "standard_error" ? estimate_.standard_error
             : row_key_ == "ci95_low"       ? estimate_.ci95_low
             : row_key_ == "ci95_high"      ? estimate_.ci95_high
                                            : other_) = value;
        }
        return depth_ > 0;
    }

    static inline const std::vector<std::size_t> kNoColumns = {};

    const RowsQuery& query_;
    const std::function<void(PlacedRows)>& take_;
    std::map<std::string, std::vector<std::size_t>> columns_;  // by their path of keys
    std::size_t depth_ = 0;  // nesting in the skipped value; 0: none is skipped
    bool takes_ = false;     // whether the skipped value has requested rows
    RowsPosition position_;
    std::string list_;
    RowColumns rows_;
    std::size_t row_ = 0;
    std::string row_key_, path_;
    std::vector<std::size_t> ends_;                       // of the path, level by level
    const std::vector<std::size_t>* selected_ = nullptr;  // the columns of the estimate
    Estimate estimate_;
    double other_ = 0;
};

}  // namespace

Node read_rows(
    std::string_view text,
    const std::string& path,
    const RowsQuery& query,
    const std::function<void(PlacedRows)>& take) {
    RowsBuilder builder(path, query, take);
    static_cast<void>(nlohmann::ordered_json::sax_parse(text, &builder));
    return std::move(builder.result);
}

std::vector<PlacedRows> read_rows(
    std::string_view text, const std::string& path, const RowsQuery& query) {
    std::vector<PlacedRows> all;
    read_rows(text, path, query, [&](PlacedRows rows) { all.push_back(std::move(rows)); });
    return all;
}

Node read_light_rows(
    std::string_view text,
    const std::string& path,
    const RowsQuery& query,
    const std::function<void(LightRows)>& take) {
    std::optional<LightRows> last;  // other lists may follow
    Node rest = read_rows(text, path, query, [&](PlacedRows rows) {
        if (last && last->position != rows.position) {
            take(*std::exchange(last, std::nullopt));
        }
        if (!last) {
            last.emplace(LightRows{rows.position, {}, {}, {}});
        }
        (rows.list == "sensors"  ? last->sensors
         : rows.list == "groups" ? last->groups
                                 : last->organs) = std::move(rows.columns);
    });
    if (last) {
        take(*std::move(last));
    }
    return rest;
}

std::string text_in(const Node& table, std::string_view key) {
    const Node* found = table.find(key);
    const auto* text = found == nullptr ? nullptr : found->as<std::string>();
    return text == nullptr ? "" : *text;
}

Node only_point(const Node& document, std::optional<std::size_t> point, const std::string& path) {
    const auto* members = document.as<Node::Table>();
    if (members == nullptr) {
        refuse_json(path, "is not a result");
    }
    if (!point) {
        return document;
    }
    const Node* found = document.find("points");
    const auto* points = found == nullptr ? nullptr : found->as<Node::List>();
    if (points == nullptr || *point >= points->size()) {
        refuse_json(path, "it does not contain this point of the sweep");
    }
    const Node& one = (*points)[*point];
    Node::Table all;
    for (const Member& member : *members) {  // the points are not copied: there may be many
        if (member.key != "points" && one.find(member.key) == nullptr) {
            all.push_back(member);
        }
    }
    if (const auto* own = one.as<Node::Table>()) {
        all.insert(all.end(), own->begin(), own->end());
    }
    return {.value = std::move(all), .line = document.line};
}

}  // namespace quasimc
