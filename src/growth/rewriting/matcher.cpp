#include "growth/rewriting/matcher.h"

namespace quasimc {
namespace {

using Position = ModuleString::Position;

bool agrees_with(const PatternModule& pattern, const ModuleString& string, Position p) {
    return string.symbol(p) == pattern.symbol && string.count(p) == pattern.variables.size();
}

bool is_kept_cut(const ModuleString& string, Position p) {
    return string.symbol(p) == '%' && string.count(p) > 0;
}

/// The position after the branch that begins at a '['.
Position after_branch(const ModuleString& string, Position p) {
    const Position partner = string.partner(p);
    return partner == ModuleString::kNone ? string.end() : string.next(partner);
}

/// The ']' of the branch that holds `p`; the end of the string if there is none.
Position closing_bracket(const ModuleString& string, Position p) {
    while (p < string.end() && string.symbol(p) != ']') {
        p = string.symbol(p) == '[' ? after_branch(string, p) : string.next(p);
    }
    return p;
}

bool is_ignored(const LSystem& system, char symbol) {
    return system.ignored[static_cast<unsigned char>(symbol)];
}

/// Binds parameters. Of equal names the first parameter counts.
inline void bind_parameters(
    const PatternModule& pattern, const ModuleString& string, Position p, double* variables) {
    for (std::size_t i = pattern.variables.size(); i-- > 0;) {
        variables[pattern.variables[i]] = static_cast<double>(string.parameter(p, i));
    }
}

/// A walk over the modules of a context.
struct ContextWalk {
    const ModuleString& string;
    const LSystem& system;
    Position p;
    bool has_wrapped = false;

    /// Goes to the other end of a ring. @returns false if there is none
    bool wrap(Position to) {
        const bool may_wrap = system.is_ring && !has_wrapped && !string.empty();
        has_wrapped = true;
        p = to;
        return may_wrap;
    }
    /// Goes from `p` on to a module of a right context. @param wanted  symbol
    bool find_right(char wanted) {
        for (;;) {
            if ((p >= string.end() && !wrap(ModuleString::begin())) || is_kept_cut(string, p)) {
                return false;
            }
            const char symbol = string.symbol(p);
            if (is_ignored(system, symbol)) {
                p = string.next(p);
            } else if (symbol == '[' && wanted != '[') {
                p = after_branch(string, p);
            } else {
                return true;
            }
        }
    }
    /// Goes from before `p` back to a module of a left context.
    bool find_left() {
        for (;;) {
            p = string.previous(p);
            if (p == ModuleString::kNone) {
                if (!wrap(string.end())) {
                    return false;
                }
                continue;
            }
            const char symbol = string.symbol(p);
            const bool is_end = symbol == ']' && string.partner(p) == ModuleString::kNone;
            if (is_end || is_kept_cut(string, p)) {
                return false;
            }
            if (symbol == ']') {
                p = string.partner(p);
            } else if (symbol != '[' && !is_ignored(system, symbol)) {
                return true;
            }
        }
    }
};

}  // namespace

Position branch_end(const ModuleString& string, Position p) {
    std::size_t open = 0;
    while (p < string.end()) {
        const char symbol = string.symbol(p);
        if (symbol == ']' || is_kept_cut(string, p) || (symbol == '$' && open == 0)) {
            return p;
        }
        if (symbol == '$') {
            --open;
        } else if (symbol == '?' && string.count(p) > 0) {
            ++open;
        }
        p = symbol == '[' ? after_branch(string, p) : string.next(p);
    }
    return p;
}

Position Matcher::match(
    const Production& production,
    const ModuleString& text,
    Position p,
    const ModuleRange* origin,
    SystemInstance& instance) {
    Position end = p;
    for (const PatternModule& pattern : production.predecessor) {
        if (end >= text.end() || !agrees_with(pattern, text, end)) {
            return ModuleString::kNone;
        }
        end = text.next(end);
    }
    const ModuleRange itself{text, p, end};
    const ModuleRange& around = origin != nullptr ? *origin : itself;
    if ((!production.right.empty() && !find_right(production, around, *instance.system)) ||
        (!production.left.empty() && !find_left(production, around, *instance.system))) {
        return ModuleString::kNone;
    }
    double* variables = instance.variables.data();
    Position module = p;
    for (const PatternModule& pattern : production.predecessor) {
        bind_parameters(pattern, text, module, variables);
        module = text.next(module);
    }
    for (std::size_t i = 0; i < production.right.size(); ++i) {
        bind_parameters(production.right[i], around.string, right_[i], variables);
    }
    for (std::size_t i = production.left.size(); i-- > 0;) {
        bind_parameters(production.left[i], around.string, left_[i], variables);
    }
    machine_.run(production.before, instance.variables);
    return production.condition == kNoCode ||
                   machine_.evaluate(production.condition, instance.variables) != 0
               ? end
               : ModuleString::kNone;
}

/// Searches the right context: modules that follow, without ignored ones and side branches.
bool Matcher::find_right(
    const Production& production, const ModuleRange& origin, const LSystem& system) {
    ContextWalk walk{origin.string, system, origin.end};
    right_.clear();
    for (const PatternModule& pattern : production.right) {
        if (pattern.symbol == '=') {
            walk.p = closing_bracket(walk.string, walk.p);
            right_.push_back(walk.p);
            continue;
        }
        if (!walk.find_right(pattern.symbol) || !agrees_with(pattern, walk.string, walk.p)) {
            return false;
        }
        right_.push_back(walk.p);
        walk.p = walk.string.next(walk.p);
    }
    return true;
}

/// Searches the left context: modules on the path to the root, the nearest first.
bool Matcher::find_left(
    const Production& production, const ModuleRange& origin, const LSystem& system) {
    ContextWalk walk{origin.string, system, origin.first};
    left_.resize(production.left.size());
    for (std::size_t i = production.left.size(); i-- > 0;) {
        if (!walk.find_left() || !agrees_with(production.left[i], walk.string, walk.p)) {
            return false;
        }
        left_[i] = walk.p;
    }
    return true;
}

}  // namespace quasimc
