#include "growth/language/macros.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

constexpr std::size_t kBytesPerExpansion = 32;  // bounds their number, and that of arguments

bool is_macro_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_macro_letter_or_digit(char c) {
    return is_macro_letter(c) || (c >= '0' && c <= '9');
}

/// A text that is being read: the given one, or the expansion of a macro, which is active until
/// its end.
struct MacroSource {
    std::string text;
    Macro* macro = nullptr;
    std::size_t at = 0;
};

/// Expands one text. The expansion of a macro is read next, before the text after its name.
class MacroScanner {
  public:
    /// @param depth  number of arguments that the text is nested in
    MacroScanner(MacroTable& macros, PreprocessorLog& log, std::size_t depth, NextLine next_line)
        : macros_(macros), log_(log), depth_(depth), next_line_(std::move(next_line)) {}

    std::string expand(std::string text);

  private:
    std::string_view peek();
    std::string take();
    void expand_name(const std::string& name);
    std::vector<std::string> take_arguments(const std::string& name);
    std::string body_with(const Macro& macro, const std::vector<std::string>& arguments);

    MacroTable& macros_;
    PreprocessorLog& log_;
    std::size_t depth_;
    NextLine next_line_;
    std::vector<MacroSource> sources_;
    std::string out_;
};

std::string MacroScanner::expand(std::string text) {
    sources_.push_back({std::move(text)});
    while (!peek().empty()) {
        const std::string token = take();
        if (token[0] == kPaint) {
            out_ += token + take();
        } else if (is_macro_letter(token[0])) {
            expand_name(token);
        } else {
            out_ += token;
        }
    }
    return std::move(out_);
}

/// The next token; "" at the end.
std::string_view MacroScanner::peek() {
    while (!sources_.empty()) {
        const MacroSource& source = sources_.back();
        if (source.at < source.text.size()) {
            return first_token(std::string_view(source.text).substr(source.at));
        }
        if (source.macro != nullptr) {
            --source.macro->active;
        }
        sources_.pop_back();
    }
    return {};
}

std::string MacroScanner::take() {
    std::string token(peek());
    if (!token.empty()) {
        sources_.back().at += token.size();
    }
    return token;
}

void MacroScanner::expand_name(const std::string& name) {
    constexpr std::size_t kMaxDepth = 200;
    const auto found = macros_.find(name);
    if (found == macros_.end() || found->second.active > 0) {
        out_ += found == macros_.end() ? name : kPaint + name;
        return;
    }
    if (sources_.size() + depth_ >= kMaxDepth) {
        log_.fail("macros are nested too deeply", "");
    }
    Macro& macro = found->second;
    std::string text = macro.body;
    if (macro.is_function) {
        std::string blanks;
        while (!peek().empty() && kBetweenWords.has(peek()[0])) {
            blanks += take();
        }
        if (peek() != "(") {
            out_ += name + blanks;
            return;
        }
        text = body_with(macro, take_arguments(name));
    }
    log_.spend(kBytesPerExpansion + text.size());
    ++macro.active;
    sources_.push_back({text + ' ', &macro});
}

/// Reads the arguments of a macro between parentheses.
std::vector<std::string> MacroScanner::take_arguments(const std::string& name) {
    std::vector<std::string> arguments(1);
    take();
    for (int parentheses = 1; parentheses > 0;) {
        const std::string token = take();
        log_.spend(token == "," ? kBytesPerExpansion : token.size());
        parentheses += token == "(" ? 1 : token == ")" ? -1 : 0;
        if (token.empty()) {
            const std::optional<std::string> line = next_line_ ? next_line_() : std::nullopt;
            if (!line) {
                log_.fail(
                    "the call of the macro " + shown(name) + " is not closed", "a \")\" ends it");
            }
            sources_.push_back({" " + *line});
        } else if (token == "," && parentheses == 1) {
            arguments.emplace_back();
        } else if (parentheses > 0) {
            arguments.back() += token;
        }
    }
    return arguments;
}

std::string MacroScanner::body_with(const Macro& macro, const std::vector<std::string>& arguments) {
    const std::size_t wanted = macro.parameters.size();
    const bool has_none = arguments.size() == 1 && trimmed(arguments[0]).empty();
    if (arguments.size() != wanted && !(has_none && wanted == 0)) {
        log_.warn(fmt::format(
            "a macro with {} has {}", counted(wanted, "parameter"),
            counted(arguments.size(), "argument")));
    }
    std::map<std::string_view, std::string> values;
    for (std::size_t i = 0; i < wanted; ++i) {
        const std::string argument(i < arguments.size() ? trimmed(arguments[i]) : "");
        values[macro.parameters[i]] =
            MacroScanner(macros_, log_, depth_ + 1, NextLine{}).expand(argument);
    }
    std::string text;
    for (std::string_view body = macro.body; !body.empty();) {
        const std::string_view token = first_token(body);
        const auto found = values.find(token);
        const std::string_view part = found == values.end() ? token : found->second;
        log_.spend(part.size() + 1);
        text += part;
        body.remove_prefix(token.size());
    }
    return text;
}

}  // namespace

void PreprocessorLog::spend(std::size_t more_bytes) {
    constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;
    bytes += more_bytes;
    if (bytes > kMaxBytes) {
        fail("the text exceeds 64 MiB after its macros and included files", "");
    }
}

std::string_view first_token(std::string_view text) {
    std::size_t size = 1;
    if (text.starts_with('"')) {
        while (size < text.size() && text[size] != '"') {
            size += text[size] == '\\' ? 2 : 1;
        }
        ++size;
    } else if (!text.empty() && is_macro_letter_or_digit(text[0])) {
        const auto* const end =
            std::find_if_not(text.begin(), text.end(), is_macro_letter_or_digit);
        size = static_cast<std::size_t>(end - text.begin());
    }
    return text.substr(0, size);
}

std::string_view name_at_start(std::string_view text) {
    const bool is_name = !text.empty() && is_macro_letter(text[0]);
    return is_name ? first_token(text) : std::string_view{};
}

std::optional<Macro> read_macro(std::string_view definition) {
    constexpr std::size_t kMaxParameters = 64;
    Macro macro{definition.starts_with('('), {}, {}, std::string(trimmed(definition))};
    if (macro.is_function) {
        const std::size_t end = definition.find(')');
        if (end == std::string_view::npos) {
            return std::nullopt;
        }
        std::string_view list = definition.substr(1, end - 1);
        while (!trimmed(list).empty()) {
            const std::string_view name = take_word(list, ", \t\r\v\f");
            auto& names = macro.parameters;
            const bool is_new = std::find(names.begin(), names.end(), name) == names.end();
            if (name.empty() || name_at_start(name) != name || !is_new ||
                names.size() == kMaxParameters) {
                return std::nullopt;
            }
            names.emplace_back(name);
        }
        definition.remove_prefix(end + 1);
    }
    macro.body = trimmed(definition);
    return macro;
}

std::string expand_macros(
    std::string text, MacroTable& macros, PreprocessorLog& log, const NextLine& next_line) {
    std::string expanded = MacroScanner(macros, log, 0, next_line).expand(std::move(text));
    expanded.erase(std::remove(expanded.begin(), expanded.end(), kPaint), expanded.end());
    return expanded;
}

}  // namespace quasimc
