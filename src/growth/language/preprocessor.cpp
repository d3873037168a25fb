#include "growth/language/preprocessor.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "growth/language/condition.h"
#include "growth/language/macros.h"
#include "quasimc/error.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 13> kDirectives{
    "define", "undef", "include", "if",    "ifdef",   "ifndef", "elif",
    "else",   "endif", "line",    "error", "warning", "pragma"};

/// A directive without its "#", and the text after its name.
struct Directive {
    std::string_view name, arguments;
};

/// The directive of a line, or empty for text. As "#" is also a symbol of models, lines with other
/// names are text. A "#" in the first column is one alone, or before a line number.
std::optional<Directive> read_directive(std::string_view line) {
    const std::string_view text = trimmed(line);
    if (!text.starts_with('#')) {
        return std::nullopt;
    }
    const std::string_view rest = trimmed(text.substr(1));
    if (line[0] == '#' && (rest.empty() || (rest[0] >= '0' && rest[0] <= '9'))) {
        return Directive{"line", rest};
    }
    const std::string_view name = name_at_start(rest);
    const bool is_known =
        std::find(kDirectives.begin(), kDirectives.end(), name) != kDirectives.end();
    return is_known ? std::optional(Directive{name, trimmed(rest.substr(name.size()))})
                    : std::nullopt;
}

/// A line after the splices and without comments.
struct LogicalLine {
    std::string text;
    std::uint32_t number = 0;  ///< first line of the file, from 1
};

/// Adds a line without its comments to a text. @returns whether a comment is open at its end
bool add_without_comments(std::string_view line, bool is_open, std::string& text) {
    while (!line.empty() && (is_open || !line.starts_with("//"))) {
        std::string_view token = first_token(line);
        if (is_open) {
            const std::size_t end = line.find("*/");
            is_open = end == std::string_view::npos;
            token = is_open ? line : line.substr(0, end + 2);
        } else if (line.starts_with("/*")) {
            is_open = true;
            token = line.substr(0, 2);
        } else {
            text += token;
        }
        line.remove_prefix(token.size());
    }
    return is_open;
}

/// The lines of a file. A backslash before the end of a line joins the next one. Comments are
/// removed, but the ends of lines within them remain.
std::vector<LogicalLine> read_logical_lines(std::string_view bytes, PreprocessorLog& log) {
    std::vector<LogicalLine> lines;
    bool is_open = false;
    for (LineScanner scanner(bytes); scanner.next();) {
        log.line = is_open ? log.line : scanner.number();
        lines.push_back({"", scanner.number()});
        std::string line(scanner.line());
        while (line.ends_with('\\') && scanner.next()) {
            line.pop_back();
            line += scanner.line();
        }
        std::replace(line.begin(), line.end(), kPaint, ' ');
        is_open = add_without_comments(line, is_open, lines.back().text);
    }
    if (is_open) {
        log.add_fault("a comment is not closed", "\"*/\" ends it");
    }
    return lines;
}

enum class BranchState { waiting, reading, finished };

/// The lines between #if and #endif, of which at most one branch is read.
struct ConditionalGroup {
    std::uint32_t line = 0;
    BranchState state = BranchState::waiting;
};

/// A file that is being read.
struct SourceFile {
    std::vector<LogicalLine> lines;
    std::size_t next = 0;  ///< next line
    std::vector<ConditionalGroup> groups;

    [[nodiscard]] bool is_skipping() const {
        return !groups.empty() && groups.back().state != BranchState::reading;
    }
    /// The next line, if it is text.
    std::optional<std::string> next_text() {
        const bool is_text = next < lines.size() && !read_directive(lines[next].text);
        return is_text ? std::optional(std::move(lines[next++].text)) : std::nullopt;
    }
};

class Preprocessor {
  public:
    Preprocessor(InputFiles& files, Notices& notices) : files_(files), log_{notices} {}

    PreprocessedText run(const std::string& path) {
        log_.file = path;
        read_source(path, files_.read(path));
        log_.faults.throw_if_any();
        return std::move(result_);
    }

  private:
    [[nodiscard]] SourceFile& file() { return *open_.back(); }
    void read_source(const std::string& path, const std::string& bytes);
    void read_line(const std::string& line);
    void obey(const Directive& directive);
    void select_branch(const Directive& directive);
    bool evaluate(const Directive& directive);
    std::string without_defined(std::string_view expression);
    void define(std::string_view arguments);
    void include(std::string text);

    InputFiles& files_;
    PreprocessorLog log_;
    PreprocessedText result_;
    MacroTable macros_;
    std::vector<SourceFile*> open_;
};

void Preprocessor::read_source(const std::string& path, const std::string& bytes) {
    constexpr std::size_t kBytesPerFile = 65536;  // bounds the number of files
    log_.spend(kBytesPerFile + bytes.size());
    log_.file = path;
    SourceFile source{read_logical_lines(bytes, log_), 0, {}};
    const auto number = static_cast<std::uint32_t>(result_.files.size());
    result_.files.push_back(path);
    open_.push_back(&source);
    while (source.next < source.lines.size()) {
        const LogicalLine line = std::move(source.lines[source.next++]);
        log_.line = line.number;
        read_line(line.text);
        result_.text += '\n';
        result_.lines.push_back({number, line.number});
    }
    for (const ConditionalGroup& group : source.groups) {
        log_.line = group.line;
        log_.warn("the #if has no #endif");
    }
    open_.pop_back();
}

void Preprocessor::read_line(const std::string& line) {
    log_.spend(1);
    if (const std::optional<Directive> directive = read_directive(line)) {
        return obey(*directive);
    }
    if (file().is_skipping()) {
        return;
    }
    if (line.starts_with('#') && !name_at_start(trimmed(line).substr(1)).empty()) {
        log_.warn(shown(line) + " is not a directive: it is read as text");
    }
    const std::string text = expand_macros(line, macros_, log_, [&] { return file().next_text(); });
    log_.spend(text.size());
    result_.text += text;
}

/// Obeys a directive; #line and #pragma change nothing.
void Preprocessor::obey(const Directive& directive) {
    const auto [name, arguments] = directive;
    if (name.starts_with("if") || name.starts_with("el") || name == "endif") {
        select_branch(directive);
    } else if (file().is_skipping()) {
        return;
    } else if (name == "define") {
        define(arguments);
    } else if (name == "undef") {
        macros_.erase(std::string(name_at_start(arguments)));
    } else if (name == "include") {
        include(std::string(arguments));
    } else if (name == "error") {
        log_.add_fault("#error " + printable(arguments), "");
    } else if (name == "warning") {
        log_.warn("#warning " + printable(arguments));
    }
}

/// Obeys #if and the directives that end its branches.
void Preprocessor::select_branch(const Directive& directive) {
    const auto [name, arguments] = directive;
    std::vector<ConditionalGroup>& groups = file().groups;
    if (name.starts_with("if")) {
        const bool is_skipped = file().is_skipping();
        groups.push_back({log_.line, is_skipped ? BranchState::finished : BranchState::waiting});
    } else if (groups.empty()) {
        return log_.warn(fmt::format("#{} has no #if: it is ignored", name));
    } else if (name == "endif") {
        return groups.pop_back();
    }
    BranchState& state = groups.back().state;
    if (state != BranchState::waiting) {
        state = BranchState::finished;
    } else if (name == "else" || evaluate(directive)) {
        state = BranchState::reading;
    }
}

/// The condition of #if, #elif, #ifdef and #ifndef.
bool Preprocessor::evaluate(const Directive& directive) {
    const auto [name, text] = directive;
    if (name.starts_with("ifd") || name.starts_with("ifn")) {
        const std::string_view macro = name_at_start(text);
        if (macro.empty()) {
            log_.add_fault(fmt::format("#{} needs the name of a macro", name), "");
        }
        return macros_.contains(macro) == (name == "ifdef");
    }
    const ConditionValue result =
        evaluate_condition(expand_macros(without_defined(text), macros_, log_));
    if (!result.problem.empty()) {
        log_.add_fault("the condition " + shown(text) + " has no value", result.problem);
    }
    return result.value != 0;
}

/// The expression with 1 or 0 for "defined" and the next name.
std::string Preprocessor::without_defined(std::string_view expression) {
    std::string text;
    bool is_operand = false;
    while (!expression.empty()) {
        const std::string_view token = first_token(expression);
        expression.remove_prefix(token.size());
        if (token == "defined") {
            is_operand = true;
        } else if (is_operand && !name_at_start(token).empty()) {
            text += macros_.contains(token) ? '1' : '0';
            is_operand = false;
        } else {
            text += token;
        }
    }
    return text;
}

void Preprocessor::define(std::string_view arguments) {
    const std::string name(name_at_start(arguments));
    if (name.empty() || name == "defined") {
        return log_.add_fault(
            "#define " + shown(arguments) + " defines no macro", "a macro's name has letters");
    }
    std::optional<Macro> macro = read_macro(arguments.substr(name.size()));
    if (!macro) {
        return log_.add_fault(
            "the parameters of the macro " + shown(name) + " are wrong",
            "they are different names between parentheses");
    }
    const auto found = macros_.find(name);
    if (found != macros_.end() && found->second.definition != macro->definition) {
        log_.warn("the macro " + shown(name) + " is defined again");
    }
    macros_.insert_or_assign(name, *std::move(macro));
}

void Preprocessor::include(std::string text) {
    constexpr std::size_t kMaxDepth = 64;
    if (!text.starts_with('"') && !text.starts_with('<')) {
        text = trimmed(expand_macros(std::move(text), macros_, log_));
    }
    const std::size_t end = text.find(text.starts_with('<') ? '>' : '"', 1);
    if ((text[0] != '"' && text[0] != '<') || end == text.npos) {
        return log_.add_fault(
            "#include " + shown(text) + " names no file", "write #include \"file\"");
    }
    if (open_.size() >= kMaxDepth) {
        log_.fail("files are included too deeply", "a file may include itself");
    }
    const std::string name = text.substr(1, end - 1);
    const std::filesystem::path folder = std::filesystem::path(log_.file).parent_path();
    const std::string path = (folder / name).lexically_normal().string();
    if (path == "-" || path == "/dev/stdin") {
        return log_.warn("standard input can't be included");
    }
    std::string bytes;
    try {
        bytes = files_.read(path);
    } catch (const InputError& error) {
        return log_.warn("#include is ignored: " + std::string(error.what()));
    }
    const std::string including = log_.file;
    read_source(path, bytes);
    log_.file = including;
}

}  // namespace

std::string PreprocessedText::where(std::size_t line) const {
    if (lines.empty()) {
        return files.empty() ? "" : files.front() + ":1";
    }
    const SourceLine& source = lines[std::min(line, lines.size() - 1)];
    return files[source.file] + ":" + std::to_string(source.line);
}

PreprocessedText preprocess(const std::string& path, InputFiles& files, Notices& notices) {
    return Preprocessor(files, notices).run(path);
}

}  // namespace quasimc
