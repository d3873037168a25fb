#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/run_spec.h"

namespace quasimc {

/// The value of an option, from a file, a command line or a program.
using OptionValue =
    std::variant<std::int64_t, double, std::string, std::vector<std::string>, std::vector<double>>;

/// The values that an option accepts.
struct IntegerDomain {
    std::int64_t low, high;
};
struct RealDomain {
    double low, high;
};
struct ChoiceDomain {
    std::vector<std::string_view> names;
};
struct ListDomain {
    std::string_view form;  ///< form of an item, "BAND:BAND"
};
struct RealsDomain {};  ///< a list of finite numbers
using OptionDomain = std::variant<IntegerDomain, RealDomain, ChoiceDomain, ListDomain, RealsDomain>;

/// The texts of a row.
struct OptionWords {
    std::string_view key;         ///< in the run file's [run]; the flag is --key with '-' for '_'
    std::string_view unit;        ///< may be empty
    std::string_view summary;     ///< one line for the manual, the usage and the default file
    std::string_view group = {};  ///< heading in the help, set by make_table()
};

/// One row of the table of run options: one field of RunSpec.
struct Option : OptionWords {
    OptionDomain domain;
    std::function<void(RunSpec&, const OptionValue&)>
        set;  ///< takes values that check_option accepts
    std::function<OptionValue(const RunSpec&)> get;
};

/// All options of a run, in the order of the manual.
[[nodiscard]] std::span<const Option> option_table();

/// A number, of an integer too.
[[nodiscard]] double as_real(const OptionValue& value);

/// A list of numbers; an empty list of texts is one of numbers too.
[[nodiscard]] std::vector<double> as_reals(const OptionValue& value);

/// The row of that key, or null.
[[nodiscard]] const Option* find_option(std::string_view key);

/// The keys of the table of options, for suggestions.
[[nodiscard]] std::vector<std::string_view> option_keys();

/// "--max-depth" for max_depth.
[[nodiscard]] std::string option_flag(const Option& option);

/// Range or choices of the option: "1 to 2^30", "one of sobol, halton", "list of BAND:BAND".
[[nodiscard]] std::string domain_text(const Option& option);

/// A whole number of an integer option, however it is written (1e6), as an integer; other values
/// as they are.
[[nodiscard]] OptionValue whole_if_integer(const Option& option, OptionValue value);

/// The error in a value for this option, without a location; nothing if the value is valid. An
/// integer is accepted as a real.
[[nodiscard]] std::optional<Fault> check_option(const Option& option, const OptionValue& value);

/// How run files name a method: "first_hits".
[[nodiscard]] std::string method_name(Method from);

/// The value of a text on the command line ("65536", "sobol", "R:FR,B:R"); a text that is
/// no number stays text, for check_option to refuse.
[[nodiscard]] OptionValue parse_option(const Option& option, std::string_view text);

/// An option's value as TOML: 65536, 0.95, "sobol", ["R:FR"].
[[nodiscard]] std::string option_toml(const OptionValue& value);

/// The [run] section of a run file, each option with its default and a comment.
[[nodiscard]] std::string default_run_section();

/// The table of options in Markdown.
[[nodiscard]] std::string options_markdown();

}  // namespace quasimc
