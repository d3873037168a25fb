#include "growth/rewriting/rewriter.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {

SystemInstances::SystemInstances(const PlantProgram& program, Machine& machine)
    : program_(program), machine_(machine) {
    const LSystem& main = program.systems.front();
    instances_.push_back(std::make_unique<SystemInstance>(SystemInstance{&main, main.variables}));
}

SystemInstance& SystemInstances::of(ModuleString& string, ModuleString::Position p) {
    const std::uint32_t number = string.subsystem(p);
    if (number < instances_.size()) {
        return *instances_[number];
    }
    const float id = string.parameter(p, 0);
    const auto found = std::find_if(
        program_.systems.begin(), program_.systems.end(),
        [&](const LSystem& system) { return system.id && static_cast<float>(*system.id) == id; });
    if (found == program_.systems.end()) {
        throw InputError(
            {{fmt::format("?({}, ...)", shortest(id)), "there is no L-system of this number",
              "its number is the label after 'Lsystem:'", ""}});
    }
    constexpr std::size_t kMaxVariables = 100'000'000;
    variables_ += found->variables.size() + 1;
    if (variables_ > kMaxVariables) {
        throw InputError(
            {{fmt::format("?({}, ...)", shortest(id)), "there are too many sub-L-systems",
              fmt::format("their variables are at most {}", kMaxVariables), ""}});
    }
    string.set_subsystem(p, static_cast<std::uint32_t>(instances_.size()));
    instances_.push_back(
        std::make_unique<SystemInstance>(SystemInstance{&*found, found->variables}));
    machine_.run(found->start, instances_.back()->variables);
    return *instances_.back();
}

std::vector<std::vector<double>> SystemInstances::variables() const {
    std::vector<std::vector<double>> all;
    for (const auto& instance : instances_) {
        all.push_back(instance->variables);
    }
    return all;
}

void SystemInstances::set_variables(const std::vector<std::vector<double>>& variables) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
        instances_[i]->variables = variables[i];
    }
}

AppliedProduction first_match(
    Matcher& matcher,
    const ProductionSet& set,
    const ModuleString& text,
    ModuleString::Position p,
    const ModuleRange* origin,
    SystemInstance& instance) {
    for (const std::uint32_t index : set.candidates(text.symbol(p))) {
        const Production& production = set.productions[index];
        const auto end = matcher.match(production, text, p, origin, instance);
        if (end != ModuleString::kNone) {
            return {&production, end};
        }
    }
    return {};
}

void Rewriter::derive(ModuleString& old, ModuleString& out, std::size_t max_bytes) {
    constexpr std::size_t kMaxNesting = 100;
    max_bytes_ = max_bytes;
    out.clear();
    out.reserve(old.end());
    std::vector<SystemInstance*> outer{&instances_.main()};
    Position p = ModuleString::begin();
    while (p < old.end()) {
        check_size(out);
        const char symbol = old.symbol(p);
        if (outer.back()->system->copied[static_cast<unsigned char>(symbol)]) {
            out.append_from(old, p);
            p = old.next(p);
            continue;
        }
        if (symbol == '$' && outer.size() > 1) {
            outer.pop_back();
        }
        SystemInstance& instance = *outer.back();
        if (symbol == '?' && old.count(p) > 0) {
            if (outer.size() > kMaxNesting) {
                throw InputError(
                    {{"?(id, scale)", "sub-L-systems are nested too deeply",
                      fmt::format("the limit is {}", kMaxNesting), "end them with '$'"}});
            }
            outer.push_back(&instances_.of(old, p));
        }
        p = rewrite(old, p, instance, out);
    }
}

void Rewriter::check_size(const ModuleString& out) const {
    if (std::size_t{out.end()} * sizeof(std::uint32_t) > max_bytes_) {
        throw InputError(
            {{fmt::format("step {}", state_.globals[kStepVariable]),
              fmt::format("the string takes more than {} MiB", max_bytes_ >> 20U),
              fmt::format("it has {} modules so far", out.size()),
              "make fewer steps, or raise the limit"}});
    }
}

Rewriter::Position Rewriter::rewrite(
    const ModuleString& old, Position p, SystemInstance& instance, ModuleString& out) {
    const AppliedProduction applied =
        instance.system->is_stochastic
            ? choose_at_random(old, p, instance)
            : first_match(matcher_, instance.system->productions, old, p, nullptr, instance);
    if (applied.production != nullptr) {
        apply(*applied.production, {old, p, applied.end}, 0, instance, out);
        return applied.end;
    }
    const Position next = old.next(p);
    const ProductionSet& decomposition = instance.system->decomposition;
    const bool is_cut = old.symbol(p) == '%' && old.count(p) == 0;
    if (decomposition.candidates(old.symbol(p)).empty()) {
        if (is_cut) {
            return branch_end(old, next);
        }
        out.append_from(old, p);
        return next;
    }
    const ModuleRange module{old, p, next};
    const AppliedProduction decomposed =
        first_match(matcher_, decomposition, old, p, &module, instance);
    if (decomposed.production == nullptr && is_cut) {
        return branch_end(old, next);
    }
    return replace_module(decomposed, module, module, 1, instance, out);
}

/// Chooses among all productions that apply, in proportion to their weights. A random number is
/// drawn for every module.
AppliedProduction Rewriter::choose_at_random(
    const ModuleString& old, Position p, SystemInstance& instance) {
    const ProductionSet& set = instance.system->productions;
    candidates_.clear();
    double total = 0;
    for (const std::uint32_t index : set.candidates(old.symbol(p))) {
        const Production& production = set.productions[index];
        const Position end = matcher_.match(production, old, p, nullptr, instance);
        if (end == ModuleString::kNone) {
            continue;
        }
        const double weight = production.probability == kNoCode
                                  ? 1
                                  : machine_.evaluate(production.probability, instance.variables);
        candidates_.push_back({{&production, end}, weight});
        total += weight;
    }
    double rest = total * state_.choice.next();
    for (const Candidate& candidate : candidates_) {
        rest -= candidate.weight;
        if (rest <= 0) {
            return candidate.applied;
        }
    }
    return {};
}

void Rewriter::apply(
    const Production& production,
    const ModuleRange& origin,
    int depth,
    SystemInstance& instance,
    ModuleString& out) {
    machine_.run(production.after, instance.variables);
    if (instance.system->decomposition.productions.empty()) {
        machine_.run(production.successor, instance.variables, &out);
        return;
    }
    ModuleString& successor = scratch(static_cast<std::size_t>(depth));
    machine_.run(production.successor, instance.variables, &successor);
    decompose(successor, origin, depth + 1, instance, out);
}

ModuleString& Rewriter::scratch(std::size_t depth) {
    while (scratch_.size() <= depth) {
        scratch_.emplace_back();
    }
    scratch_[depth].clear();
    return scratch_[depth];
}

void Rewriter::decompose(
    const ModuleString& text,
    const ModuleRange& origin,
    int depth,
    SystemInstance& instance,
    ModuleString& out) {
    for (Position p = ModuleString::begin(); p < text.end();) {
        p = decompose_module({text, p, text.next(p)}, origin, depth, instance, out);
    }
}

Rewriter::Position Rewriter::decompose_module(
    const ModuleRange& module,
    const ModuleRange& origin,
    int depth,
    SystemInstance& instance,
    ModuleString& out) {
    check_size(out);
    const ProductionSet& set = instance.system->decomposition;
    const auto& [text, p, next] = module;
    if (depth > set.max_depth) {
        if (set.warns && !set.candidates(text.symbol(p)).empty()) {
            notices_.once(
                "decomposition depth",
                fmt::format(
                    "decomposition: the maximum depth {} is reached; modules remain as they are",
                    set.max_depth));
        }
        out.append_from(text, p);
        return next;
    }
    return replace_module(
        first_match(matcher_, set, text, p, &origin, instance), module, origin, depth, instance,
        out);
}

Rewriter::Position Rewriter::replace_module(
    const AppliedProduction& applied,
    const ModuleRange& module,
    const ModuleRange& origin,
    int depth,
    SystemInstance& instance,
    ModuleString& out) {
    if (applied.production == nullptr) {
        out.append_from(module.string, module.first);
        return module.end;
    }
    apply(*applied.production, origin, depth, instance, out);
    return applied.end;
}

}  // namespace quasimc
