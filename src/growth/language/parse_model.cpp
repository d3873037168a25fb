#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "base/text.h"
#include "growth/language/machine.h"
#include "growth/language/parser.h"
#include "growth/language/production_parser.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Parses the L-systems of a file.
class ModelParser {
  public:
    ModelParser(ModelText& text, PlantProgram& program, Notices& notices)
        : text_(text),
          program_(program),
          notices_(notices),
          code_(program),
          expressions_(text, names_, code_, notices),
          productions_(text, names_, code_, expressions_, program, notices) {}

    void parse() {
        skip_empty_lines();
        do {
            parse_system();
            skip_empty_lines();
        } while (!text_.at_end() && !is_lost_);
        check_systems();
        faults_.throw_if_any();
    }

  private:
    /// Reads a part of the text; after an error it goes to the next line.
    /// @returns false after an error
    template <typename Read>
    bool guarded(const Read& read) {
        constexpr std::size_t kMaxFaults = 50;
        try {
            read();
            return true;
        } catch (const SyntaxError& error) {
            faults_.add({text_.where(error.position), error.problem, error.why, error.suggestion});
            is_lost_ = ++fault_count_ >= kMaxFaults;
            text_.skip_line();
            return false;
        }
    }

    void skip_empty_lines() { text_.skip_space(); }

    void parse_system() {
        program_.systems.emplace_back();
        names_.begin_system();
        const bool is_system = guarded([&] { parse_label(); });
        if (!is_system) {
            is_lost_ = true;
            return;
        }
        bool has_axiom = false, has_end = false;
        while (!has_axiom && !has_end && !text_.at_end() && !is_lost_) {
            guarded([&] { parse_header_line(has_axiom, has_end); });
            skip_empty_lines();
        }
        if (!has_axiom && !is_lost_) {
            faults_.add(
                {text_.where(text_.position()), "the L-system has no axiom", "",
                 "write 'axiom: modules' after the other headers"});
            is_lost_ = true;
        }
        parse_productions();
    }

    void parse_label() {
        if (!text_.take_keyword("lsystem") || !take_colon()) {
            text_.fail(text_.shown_next() + " where 'Lsystem: label' is expected");
        }
        text_.skip_blanks();
        const std::size_t first = text_.position();
        text_.skip_line();
        const std::string_view rest = text_.text().substr(first, text_.position() - first);
        const std::string_view label = trimmed(rest.substr(0, rest.find('\n')));
        if (label.empty()) {
            text_.set_position(first);
            text_.fail("the L-system has no label", "", "write 'Lsystem: 1'");
        }
        system().name = label;
        system().id = parse_integer(label);
        skip_empty_lines();
    }

    bool take_colon() {
        text_.skip_blanks();
        return text_.take(":");
    }

    void need_colon() {
        if (!take_colon()) {
            text_.fail(text_.shown_next() + " where ':' is expected");
        }
    }

    void parse_header_line(bool& has_axiom, bool& has_end) {
        if (text_.take_keyword("axiom")) {
            need_colon();
            has_axiom = true;
            system().axiom = productions_.parse_axiom(system());
        } else if (text_.take_keyword("endlsystem") || text_.take_keyword("endLsystem")) {
            has_end = true;
        } else if (text_.take_keyword("ring lsystem")) {
            system().is_ring = true;
        } else if (text_.take_keyword("define")) {
            need_colon();
            expressions_.parse_definitions(system(), program_);
        } else if (!parse_number_line() && !parse_symbols_line() && !parse_block_line()) {
            text_.fail(
                text_.shown_next() + " where a header or 'axiom:' is expected",
                "headers are ring lsystem, seed:, derivation length:, ignore:, consider:, define:, "
                "Start:, StartEach:, EndEach: and End:");
        }
        need_line_end();
    }

    bool parse_number_line() {
        if (text_.take_keyword("seed")) {
            need_colon();
            static_cast<void>(constant_expression());
            system().is_stochastic = true;
        } else if (text_.take_keyword("derivation length")) {
            need_colon();
            const double length = std::trunc(constant_expression());
            constexpr double kLargest = 1e9;
            if (!(std::abs(length) <= kLargest)) {
                text_.fail(fmt::format("the derivation length {} is too large", shortest(length)));
            }
            if (program_.systems.size() == 1) {
                program_.steps = length > 0 ? static_cast<std::int64_t>(length) : 0;
            }
            names_.add_globals();
        } else {
            return false;
        }
        return true;
    }

    bool parse_symbols_line() {
        const bool ignores = text_.take_keyword("ignore");
        if (!ignores && !text_.take_keyword("consider")) {
            return false;
        }
        need_colon();
        std::bitset<256> listed;
        for (text_.skip_blanks(); !text_.at_line_end(); text_.skip_blanks()) {
            listed.set(static_cast<unsigned char>(text_.peek()));
            text_.advance();
        }
        system().ignored = ignores ? listed : ~listed;
        return true;
    }

    bool parse_block_line() {
        CodeIndex* block = text_.take_keyword("startEach") || text_.take_keyword("start each")
                               ? &system().start_each
                           : text_.take_keyword("endEach") || text_.take_keyword("end each")
                               ? &system().end_each
                           : text_.take_keyword("start") ? &system().start
                           : text_.take_keyword("end")   ? &system().end
                                                         : nullptr;
        if (block == nullptr) {
            return false;
        }
        need_colon();
        const CodeIndex begin = code_.here();
        expressions_.parse_block(system());
        code_.add(Op::end);
        *block = begin;
        return true;
    }

    double constant_expression() {
        const CodeIndex begin = code_.here();
        expressions_.parse_expression(system(), ExpressionParser::Newlines::end_lines);
        code_.add(Op::end);
        return evaluate_constant(program_, begin, system(), notices_);
    }

    void need_line_end() {
        text_.skip_blanks();
        if (!text_.at_line_end()) {
            text_.fail(text_.shown_next() + " where the end of the line is expected");
        }
    }

    void parse_productions() {
        ProductionSet* set = &system().productions;
        for (skip_empty_lines(); !is_lost_; skip_empty_lines()) {
            if (text_.at_end()) {
                faults_.add(
                    {text_.where(text_.position()), "the L-system does not end", "",
                     "write 'endlsystem' after the last production"});
                return;
            }
            if (text_.take_keyword("endlsystem") || text_.take_keyword("endLsystem")) {
                return;
            }
            guarded([&] { parse_production_line(set); });
        }
    }

    void parse_production_line(ProductionSet*& set) {
        if (text_.take_keyword("decomposition")) {
            set = &system().decomposition;
            parse_section_line(*set);
        } else if (text_.take_keyword("homomorphism")) {
            set = &system().homomorphism;
            parse_section_line(*set);
        } else if (text_.take_keyword("maximum depth")) {
            need_colon();
            parse_depth(*set);
        } else if (text_.starts_with("seed:") || text_.starts_with("Seed:")) {
            text_.advance(4);
            need_colon();
            set->seed = constant_expression();
        } else if (text_.starts_with("axiom:") || text_.starts_with("Axiom:")) {
            text_.fail("a second axiom", "an L-system has one");
        } else if (is_header()) {
            text_.fail("a header after the axiom", "headers are before it", "move the line up");
        } else {
            productions_.parse_production(*set, system());
            return;
        }
        need_line_end();
    }

    /// Whether a line begins with a word of the headers and a colon.
    bool is_header() {
        const std::size_t start = text_.position();
        bool is_found = false;
        for (const char* word :
             {"ignore", "consider", "derivation length", "define", "start", "startEach", "endEach",
              "end"}) {
            is_found = is_found || (text_.take_keyword(word) && text_.peek() == ':');
            text_.set_position(start);
        }
        return is_found;
    }

    void parse_section_line(ProductionSet& set) {
        text_.skip_blanks();
        text_.take(":");
        text_.skip_blanks();
        if (text_.take_keyword("no warnings")) {
            set.warns = false;
        } else {
            text_.take_keyword("warnings");
        }
    }

    void parse_depth(ProductionSet& set) {
        constexpr double kDeepest = 1000;
        const double depth = std::trunc(constant_expression());
        if (!(depth >= 1 && depth <= kDeepest)) {
            text_.fail(
                fmt::format("the maximum depth is not from 1 to {}", shortest(kDeepest)),
                "each level is a recursion");
        }
        set.max_depth = static_cast<int>(depth);
    }

    /// Notes the symbols without productions, except those of cuts and sub-L-systems.
    static void find_copied_symbols(LSystem& system) {
        if (system.is_stochastic || !system.decomposition.productions.empty()) {
            return;
        }
        for (std::size_t i = 0; i < system.copied.size(); ++i) {
            const char symbol = static_cast<char>(i);
            system.copied[i] = system.productions.candidates(symbol).empty() && symbol != '%' &&
                               symbol != '?' && symbol != '$';
        }
    }

    void check_systems() {
        for (LSystem& system : program_.systems) {
            find_copied_symbols(system);
        }
        for (std::size_t i = 0; i < program_.systems.size(); ++i) {
            for (std::size_t j = i + 1; j < program_.systems.size(); ++j) {
                const auto &a = program_.systems[i].id, &b = program_.systems[j].id;
                if (a && a == b) {
                    notices_.once(fmt::format(
                        "two L-systems have the number {}: ?({}, s) uses the first", *a, *a));
                }
            }
        }
    }

    LSystem& system() { return program_.systems.back(); }

    ModelText& text_;
    PlantProgram& program_;
    Notices& notices_;
    ModelNames names_;
    CodeWriter code_;
    ExpressionParser expressions_;
    ProductionParser productions_;
    Faults faults_;
    std::size_t fault_count_ = 0;
    bool is_lost_ = false;
};

}  // namespace

void parse_model(const PreprocessedText& source, PlantProgram& program, Notices& notices) {
    ModelText text(source);
    ModelParser(text, program, notices).parse();
    program.where.reserve(source.lines.size());
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
        program.where.push_back(source.where(i));
    }
}

}  // namespace quasimc
