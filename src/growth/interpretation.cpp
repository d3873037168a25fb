#include "growth/interpretation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {
namespace {

using Position = ModuleString::Position;

/// Bytes of a module in the strings of cpfg, which its queries count.
std::int64_t bytes_of_module(const ModuleString& string, Position p) {
    const auto count = static_cast<std::int64_t>(string.count(p));
    return count == 0 ? 1 : 2 + 5 * count;
}

/// The name of a module for a query: one character, or two after '~' and '@'.
struct FollowingModule {
    std::string name;
    std::vector<float> parameters;
};

FollowingModule following_module(const ModuleString& text, Position p) {
    FollowingModule following;
    if (p >= text.end()) {
        return following;
    }
    following.name = text.symbol(p);
    const bool has_two = text.symbol(p) == '~' || text.symbol(p) == '@';
    if (has_two && text.count(p) == 0 && text.next(p) < text.end()) {
        p = text.next(p);
        following.name += text.symbol(p);
    }
    for (std::size_t i = 0; i < text.count(p); ++i) {
        following.parameters.push_back(text.parameter(p, i));
    }
    return following;
}

/// The rotation from the initial frame of a turtle, as a quaternion (w, x, y, z).
std::array<double, 4> quaternion_of(const TurtleFrame& frame) {
    const Vec3 x = -frame.left, y = frame.heading, z = -frame.up;  // images of the axes
    const double w = 0.5 * std::sqrt(std::max(0.0, 1 + x.x + y.y + z.z));
    const auto part = [](double diagonal, double sign) {
        return std::copysign(0.5 * std::sqrt(std::max(0.0, 1 + diagonal)), sign);
    };
    return {
        w, part(x.x - y.y - z.z, y.z - z.y), part(y.y - x.x - z.z, z.x - x.z),
        part(z.z - x.x - y.y, x.y - y.x)};
}

}  // namespace

Interpretation::Interpretation(
    const InterpreterParts& parts,
    const InterpretationOutputs& outputs,
    Turtle::Commands commands,
    std::vector<CutState>& cuts)
    : parts_(parts),
      outputs_(outputs),
      commands_(commands),
      cuts_(cuts),
      matcher_(parts.machine),
      turtle_(parts.program.view, parts.notices, commands),
      systems_{&parts.instances.main()} {
    turtle_.set_drawing(outputs.drawing);
}

void Interpretation::run(ModuleString& string) {
    run_modules(string);
    turtle_.finish();
}

void Interpretation::run_modules(ModuleString& string) {
    const bool needs_modules = outputs_.drawing != nullptr || outputs_.environment != nullptr;
    Position p = ModuleString::begin();
    while (!needs_modules && p < string.end()) {
        p = interpret(string, p, nullptr, 0);
    }
    while (p < string.end()) {
        begin_module(string, p);
        const Position end = interpret(string, p, nullptr, 0);
        for (; p < end; p = string.next(p)) {
            ++module_.index;
            offset_ += bytes_of_module(string, p);
        }
    }
}

/// Notes the branch of a module, and that it draws from now on.
void Interpretation::begin_module(const ModuleString& string, Position p) {
    const char symbol = string.symbol(p);
    if (symbol == '[') {
        branches_.push_back(module_.branch);
        module_.branch = ++branch_count_;
    } else if (symbol == ']' && !branches_.empty()) {
        module_.branch = branches_.back();
        branches_.pop_back();
    }
    module_.order = branches_.size();
    module_.symbol = symbol;
    if (outputs_.drawing != nullptr) {
        turtle_.begin_module(module_);
    }
}

/// Interprets the modules at `p`. @returns the position after them
Position Interpretation::interpret(
    ModuleString& text, Position p, const ModuleRange* origin, int depth) {
    SystemInstance& instance = *systems_.back();
    const ProductionSet& set = instance.system->homomorphism;
    Drawing* shapes = std::exchange(shapes_of_query_, nullptr);
    if (shapes != nullptr) {
        turtle_.set_commands(Turtle::Commands::all);
        turtle_.set_drawing(shapes);
    }
    Position end = ModuleString::kNone;
    if (set.candidates(text.symbol(p)).empty()) {
        end = interpret_terminal(text, p, depth);
    } else if (depth >= set.max_depth) {
        warn_depth(set, text.symbol(p));
        end = interpret_terminal(text, p, depth);
    } else {
        const AppliedProduction applied = first_match(matcher_, set, text, p, origin, instance);
        if (applied.production == nullptr) {
            end = interpret_terminal(text, p, depth);
        } else {
            const ModuleRange itself{text, p, applied.end};
            interpret_successor(
                *applied.production, origin != nullptr ? *origin : itself, depth, instance);
            end = applied.end;
        }
    }
    if (shapes != nullptr) {
        turtle_.finish();
        turtle_.set_drawing(outputs_.drawing);
        turtle_.set_commands(commands_);
    }
    return end;
}

void Interpretation::interpret_successor(
    const Production& production, const ModuleRange& origin, int depth, SystemInstance& instance) {
    const auto level = static_cast<std::size_t>(depth);
    while (scratch_.size() <= level) {
        scratch_.emplace_back();
    }
    ModuleString& successor = scratch_[level];
    successor.clear();
    parts_.machine.run(production.after, instance.variables);
    parts_.machine.run(production.successor, instance.variables, &successor);
    for (Position p = ModuleString::begin(); p < successor.end();) {
        count_module();
        p = interpret(successor, p, &origin, depth + 1);
    }
}

Position Interpretation::interpret_terminal(ModuleString& text, Position p, int depth) {
    Position end = ModuleString::kNone;
    switch (text.symbol(p)) {
        case '?':
            end = interpret_question(text, p, depth);
            break;
        case '%':
            end = interpret_cut(text, p, depth);
            break;
        case '$':
            if (systems_.size() > 1) {
                systems_.pop_back();
                turtle_.leave_subsystem();
            } else {
                parts_.notices.once("an unmatched '$' is ignored");
            }
            end = text.next(p);
            break;
        case 's':
            fill_old_position(text, p);
            end = text.next(p);
            break;
        default:
            end = turtle_.execute(text, p);
    }
    if (outputs_.image != nullptr) {
        for (Position q = p; q < end; q = text.next(q)) {
            outputs_.image->append_from(text, q);
        }
    }
    return end;
}

/// Queries, positions and sub-L-systems.
Position Interpretation::interpret_question(ModuleString& text, Position p, int depth) {
    constexpr std::size_t kMaxNesting = 100;
    const Position next = text.next(p);
    if (text.count(p) > 0) {
        if (systems_.size() <= kMaxNesting) {
            systems_.push_back(&parts_.instances.of(text, p));
            turtle_.enter_subsystem(text.count(p) > 1 ? text.parameter(p, 1) : 1);
        }
        return next;
    }
    if (next >= text.end()) {
        return next;
    }
    const char kind = text.symbol(next);
    if (kind == 'E') {
        query(text, next, depth);
    } else if (kind == 'P' || kind == 'H' || kind == 'L' || kind == 'U' || kind == 'Q') {
        fill(text, next, kind);
    } else {
        parts_.notices.once(fmt::format("the query ?{} is unknown and skipped", kind));
    }
    return text.next(next);
}

/// A cut is not drawn past, if the view file says so; %(p, k) continues from the turtle of its cut.
Position Interpretation::interpret_cut(ModuleString& text, Position p, int depth) {
    const Position next = text.next(p);
    if (text.count(p) >= 2) {
        const auto number = static_cast<double>(text.parameter(p, 1));
        if (number >= 0 && number < static_cast<double>(cuts_.size())) {
            turtle_.set_state(*cuts_[static_cast<std::size_t>(number)].turtle);
        }
        return next;
    }
    if (text.count(p) == 1 && depth == 0 && outputs_.is_pass) {
        cuts_.push_back({turtle_.state()});
    }
    return parts_.program.view.interprets_past_cut ? next : branch_end(text, next);
}

void Interpretation::query(ModuleString& text, Position e, int depth) {
    if (outputs_.environment == nullptr) {
        return;
    }
    PlantQuery query;
    query.id = 1;
    query.is_answered = depth == 0;
    if (depth == 0) {
        const std::int64_t here = offset_ + 2;  // after '?' and 'E'
        first_query_ = first_query_ < 0 ? here : first_query_;
        query.id = here - first_query_;
        queries_.push_back({query.id, e});
    }
    std::array<float, ModuleString::kMaxParameters> parameters{};
    for (std::size_t i = 0; i < text.count(e); ++i) {
        parameters[i] = text.parameter(e, i);
    }
    const FollowingModule following = following_module(text, text.next(e));
    query.parameters = std::span(parameters.data(), text.count(e));
    query.following = following.name;
    query.following_parameters = following.parameters;
    query.frame = turtle_.frame();
    query.line_width = turtle_.line_width();
    query.scale = turtle_.scale();
    query.module = module_;
    shapes_of_query_ = outputs_.environment->query(query);
    if (text.next(e) >= text.end()) {
        shapes_of_query_ = nullptr;
    }
}

/// Stores values of the turtle in the parameters of a module.
void Interpretation::fill(ModuleString& text, Position p, char kind) const {
    const TurtleFrame& frame = turtle_.frame();
    const Vec3& v = kind == 'P'   ? frame.position
                    : kind == 'H' ? frame.heading
                    : kind == 'L' ? frame.left
                                  : frame.up;
    std::array<double, 4> values{v.x, v.y, v.z, 0};
    std::size_t count = 3;
    if (kind == 'Q') {
        values = quaternion_of(frame);
        count = 4;
    }
    for (std::size_t i = 0; i < std::min(count, text.count(p)); ++i) {
        text.set_parameter(p, i, static_cast<float>(values[i]));
    }
}

/// In environment passes, s(x, y) and s(x, y, z) are an old form of ?P.
void Interpretation::fill_old_position(ModuleString& text, Position p) const {
    const std::size_t count = text.count(p);
    if (outputs_.is_pass && (count == 2 || count == 3)) {
        fill(text, p, 'P');
    }
}

void Interpretation::count_module() {
    if (++modules_ > parts_.max_modules) {
        throw InputError(
            {{"homomorphism", fmt::format("it makes more than {} modules", parts_.max_modules),
              "its recursion may have no end", "reduce 'maximum depth', or raise the limit"}});
    }
}

void Interpretation::warn_depth(const ProductionSet& set, char symbol) {
    if (set.warns && set.max_depth > 1) {
        parts_.notices.once(
            "homomorphism depth",
            fmt::format(
                "homomorphism: the maximum depth {} is reached (module '{}'); modules remain as "
                "they are",
                set.max_depth, symbol));
    }
}

}  // namespace quasimc
