#include "io/results/read_estimates.h"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "quasimc/error.h"

namespace quasimc {
namespace {

using SaxJson = nlohmann::json;

/// Follows the parser, and takes what is asked for. A level of nesting is named by the key or the
/// number of what is being read in it.
class EstimateReader final : public nlohmann::json_sax<SaxJson> {
  public:
    EstimateReader(
        const EstimateQuery& query,
        const std::vector<EstimateNames>& columns,
        const std::string& path)
        : query_(query), columns_(columns), path_(path), times_(columns.size()) {}

    std::vector<std::vector<TimedEstimates>> take() {
        for (std::vector<TimedEstimates>& times : times_) {
            std::erase_if(times, [](const TimedEstimates& time) { return time.values.empty(); });
        }
        return std::move(times_);
    }

    bool null() override { return real(std::nan("")); }
    bool boolean(bool) override { return next(); }
    bool number_integer(number_integer_t value) override {
        return real(static_cast<double>(value));
    }
    bool number_unsigned(number_unsigned_t value) override {
        return real(static_cast<double>(value));
    }
    bool number_float(number_float_t value, const string_t&) override { return real(value); }
    bool string(string_t& value) override {
        if (levels_.size() == part_depth() && is_part() && levels_.back().key == label_key()) {
            label_ = value;
        }
        return next();
    }
    bool binary(binary_t&) override { return next(); }
    bool start_object(std::size_t) override {
        levels_.push_back({});
        return true;
    }
    bool key(string_t& name) override {
        levels_.back().key = name;
        if (levels_.size() == list_depth()) {
            in_list_ = name == query_.list && is_part() && label_.starts_with(query_.label);
            for (std::size_t i = 0; in_list_ && i < times_.size(); ++i) {
                times_[i].push_back({label_, {}});
            }
        }
        return true;
    }
    bool end_object() override { return end(); }
    bool start_array(std::size_t) override {
        levels_.push_back({.is_list = true});
        return true;
    }
    bool end_array() override { return end(); }
    bool parse_error(
        std::size_t byte, const std::string&, const nlohmann::detail::exception&) override {
        throw InputError(
            {{path_, fmt::format("byte {}: not JSON", byte),
              "a result that `quasimc run --json` wrote is needed", ""}});
    }

  private:
    struct Level {
        std::string key = {};
        std::size_t index = 0;
        bool is_list = false;
    };

    /// Levels down to the object that has the list: that of the result, of a point, of a time.
    [[nodiscard]] std::size_t list_depth() const { return part_depth(); }
    [[nodiscard]] std::size_t part_depth() const {
        const std::size_t nested = query_.part == "total" ? 1 : query_.part.empty() ? 0 : 2;
        return (query_.point ? 3 : 1) + nested;
    }
    [[nodiscard]] std::string_view label_key() const {
        return query_.part == "days" ? "date" : "time";
    }

    /// Whether the levels so far lead to the point and the part that are asked for.
    [[nodiscard]] bool is_part() const {
        std::size_t level = 0;
        if (query_.point) {
            if (levels_[0].key != "points" || levels_[1].index != *query_.point) {
                return false;
            }
            level = 2;
        }
        return query_.part.empty() || levels_[level].key == query_.part;
    }

    bool real(double value) {
        for (std::size_t i = 0; in_list_ && i < columns_.size(); ++i) {
            take_number(value, columns_[i], times_[i]);
        }
        return next();
    }

    /// @param names  what leads to the numbers that are wanted
    void take_number(double value, const EstimateNames& names, std::vector<TimedEstimates>& times) {
        const std::size_t first = list_depth() + 1;  // below it: the names, and mean, low, ...
        const bool is_null = levels_.size() == first + names.size();
        if (levels_.size() < first + names.size() || levels_.size() > first + names.size() + 1) {
            return;
        }
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (levels_[first + i].key != names[i]) {
                return;
            }
        }
        const double unknown = std::numeric_limits<double>::quiet_NaN();
        std::vector<Estimate>& values = times.back().values;
        const std::size_t index = levels_[list_depth()].index;
        while (values.size() <= index) {
            values.push_back({unknown, unknown, unknown, unknown});
        }
        if (!is_null) {
            set(values[index], levels_.back().key, value);
        }
    }

    static void set(Estimate& estimate, std::string_view field, double value) {
        if (field == "mean") {
            estimate.mean = value;
        } else if (field == "standard_error") {
            estimate.standard_error = value;
        } else if (field == "low") {
            estimate.low = value;
        } else if (field == "high") {
            estimate.high = value;
        }
    }

    bool end() {
        if (levels_.size() == list_depth() + 1) {
            in_list_ = false;
        }
        if (levels_.size() == part_depth()) {
            label_.clear();
        }
        levels_.pop_back();
        return next();
    }

    /// A value has ended.
    bool next() {
        if (!levels_.empty() && levels_.back().is_list) {
            ++levels_.back().index;
        }
        return true;
    }

    const EstimateQuery& query_;
    const std::vector<EstimateNames>& columns_;
    const std::string& path_;
    std::vector<Level> levels_;
    std::string label_;
    bool in_list_ = false;
    std::vector<std::vector<TimedEstimates>> times_;  // of each column
};

}  // namespace

std::vector<std::vector<TimedEstimates>> read_estimate_columns(
    std::string_view text,
    const std::string& path,
    const EstimateQuery& query,
    const std::vector<EstimateNames>& columns) {
    EstimateReader reader(query, columns, path);
    SaxJson::sax_parse(text, &reader);
    return reader.take();
}

std::vector<TimedEstimates> read_estimates(
    std::string_view text, const std::string& path, const EstimateQuery& query) {
    return read_estimate_columns(text, path, query, {query.names}).front();
}

}  // namespace quasimc
