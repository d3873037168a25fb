#include "growth/plant.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "growth/interpretation.h"
#include "growth/language/machine.h"
#include "growth/language/program.h"
#include "growth/rewriting/rewriter.h"

namespace quasimc {
namespace {

using Position = ModuleString::Position;

/// Whether a module is a cut %(p), whose branch will be kept.
bool is_new_kept_cut(const ModuleString& string, Position p) {
    return string.symbol(p) == '%' && string.count(p) == 1;
}

/// A string whose branches after cuts %(p) are at its end, as %(p, k) and the branch.
/// @param first  number k of the first
ModuleString with_branches_at_end(const ModuleString& string, std::size_t first) {
    ModuleString kept, branches;
    for (Position p = string.begin(); p < string.end();) {
        if (!is_new_kept_cut(string, p)) {
            kept.append_from(string, p);
            p = string.next(p);
            continue;
        }
        const std::array<double, 2> parameters{
            string.parameter(p, 0), static_cast<double>(first++)};
        branches.append('%', parameters);
        const Position end = branch_end(string, string.next(p));
        for (p = string.next(p); p < end; p = string.next(p)) {
            branches.append_from(string, p);
        }
    }
    kept.append_all(branches);
    return kept;
}

}  // namespace

class Plant::Impl {
  public:
    Impl(
        std::shared_ptr<const PlantModel> model,
        PlantEnvironment* environment,
        Notices& notices,
        GrowthOptions options)
        : model_(std::move(model)),
          program_(model_->program()),
          environment_(environment),
          notices_(notices),
          options_(std::move(options)),
          machine_(program_, state_, notices),
          instances_(program_, machine_),
          rewriter_(state_, machine_, instances_, notices) {
        state_.print = options_.print;
        if (options_.seed) {
            state_.choice = StochasticRandom::seeded(*options_.seed);
        }
        state_.files = ModelFiles(options_.folder, options_.limits.open_files);
        state_.max_rounds = options_.limits.loop_rounds;
        state_.length = options_.steps >= 0 ? options_.steps : program_.steps;
        set_globals();
        run_block(main().start);
        machine_.run(main().axiom, instances_.main().variables, &string_);
    }

    [[nodiscard]] std::int64_t step() const { return step_; }
    [[nodiscard]] const ModuleString& string() const { return string_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }

    [[nodiscard]] bool is_grown() const { return state_.stops || step_ >= state_.length; }

    bool grow() {
        if (is_grown()) {
            return false;
        }
        if (program_.asks_environment) {
            pass();
        }
        ++step_;
        set_globals();
        try {
            run_block(main().start_each);
            rewriter_.derive(string_, next_, options_.limits.string_bytes);
            run_block(main().end_each);
            if (is_grown()) {
                run_block(main().end);
            }
        } catch (...) {
            --step_;
            set_globals();
            throw;
        }
        std::swap(string_, next_);
        return true;
    }

    void finish() {
        if (program_.view.passes_before_display && program_.asks_environment) {
            pass();
        }
        interpret(string_, {}, Turtle::Commands::all);
    }

    void observe(PlantEnvironment& environment) {
        ModuleString string = string_;
        without_effects([&] {
            query(string, &environment);
            static_cast<void>(environment.answers(step_));
        });
    }

    ModuleString homomorphic_image() {
        ModuleString image;
        without_effects([&] { interpret(string_, {.image = &image}, Turtle::Commands::all); });
        return image;
    }

    void draw(Drawing& drawing) {
        without_effects([&] { interpret(string_, {.drawing = &drawing}, Turtle::Commands::all); });
    }

  private:
    /// Does `work`, after which variables and random numbers are as before. Nothing is printed.
    template <typename Work>
    void without_effects(const Work& work) {
        const PlantRandom random = state_.random, of_homomorphism = homomorphism_random_;
        const std::vector<CutState> cuts = cuts_;
        const auto variables = instances_.variables();
        const auto restore = [&] {
            state_.is_silent = false;
            state_.random = random;
            homomorphism_random_ = of_homomorphism;
            cuts_ = cuts;
            instances_.set_variables(variables);
        };
        state_.is_silent = true;
        try {
            work();
        } catch (...) {
            restore();
            throw;
        }
        restore();
    }

    [[nodiscard]] const LSystem& main() const { return program_.systems.front(); }

    void set_globals() {
        state_.globals[kStepVariable] = static_cast<double>(step_);
        state_.globals[kLengthVariable] = static_cast<double>(state_.length);
    }

    /// The limit of a homomorphism, whose modules take at least a word each.
    [[nodiscard]] std::uint64_t max_modules() const {
        return options_.limits.string_bytes / sizeof(std::uint32_t);
    }

    void run_block(CodeIndex block) { machine_.run(block, instances_.main().variables); }

    std::vector<Interpretation::QueryPosition> interpret(
        ModuleString& string, const InterpretationOutputs& outputs, Turtle::Commands commands) {
        Interpretation interpretation(
            {program_, state_, machine_, instances_, notices_, max_modules()}, outputs, commands,
            cuts_);
        const std::optional<double>& seed = main().homomorphism.seed;
        if (seed && outputs.image == nullptr) {
            homomorphism_random_.srand(*seed);
        }
        if (seed) {
            std::swap(state_.random, homomorphism_random_);
        }
        interpretation.run(string);
        if (seed) {
            std::swap(state_.random, homomorphism_random_);
        }
        bounds_ = interpretation.turtle().bounds();
        return interpretation.queries();
    }

    /// Sends the queries of a string.
    std::vector<Interpretation::QueryPosition> query(
        ModuleString& string, PlantEnvironment* environment) {
        Drawing* drawing = environment != nullptr ? environment->drawing() : nullptr;
        return interpret(
            string, {.drawing = drawing, .environment = environment, .is_pass = true},
            drawing != nullptr ? Turtle::Commands::all : Turtle::Commands::moves);
    }

    /// An environment pass over the current string.
    void pass() {
        const std::size_t cuts = cuts_.size();
        const auto queries = query(string_, environment_);
        if (environment_ != nullptr) {
            apply_answers(environment_->answers(step_), queries);
        }
        if (cuts_.size() > cuts) {
            string_ = with_branches_at_end(string_, cuts);
        }
    }

    void apply_answers(
        const std::vector<PlantAnswer>& answers,
        const std::vector<Interpretation::QueryPosition>& queries) {
        for (const PlantAnswer& answer : answers) {
            const auto found = std::lower_bound(
                queries.begin(), queries.end(), answer.id,
                [](const auto& query, std::int64_t id) { return query.id < id; });
            if (found == queries.end() || found->id != answer.id) {
                continue;  // of a query in a homomorphism
            }
            const std::size_t count = string_.count(found->position);
            if (answer.values.size() > count) {
                notices_.once(
                    "too many values",
                    fmt::format(
                        "the environment answers {} values to a query of {} parameters; the others "
                        "are dropped",
                        answer.values.size(), count));
            }
            for (std::size_t i = 0; i < std::min(count, answer.values.size()); ++i) {
                if (answer.values[i]) {
                    string_.set_parameter(found->position, i, *answer.values[i]);
                }
            }
        }
    }

    std::shared_ptr<const PlantModel> model_;
    const PlantProgram& program_;
    PlantEnvironment* environment_;
    Notices& notices_;
    GrowthOptions options_;
    MachineState state_;
    Machine machine_;
    SystemInstances instances_;
    Rewriter rewriter_;
    std::int64_t step_ = 0;
    ModuleString string_, next_;
    PlantRandom homomorphism_random_;  // if the homomorphism has a seed
    std::vector<CutState> cuts_;
    Bounds bounds_;
};

Plant::Plant(
    std::shared_ptr<const PlantModel> model,
    PlantEnvironment* environment,
    Notices& notices,
    GrowthOptions options)
    : impl_(std::make_unique<Impl>(std::move(model), environment, notices, std::move(options))) {}
Plant::~Plant() = default;

std::int64_t Plant::step() const {
    return impl_->step();
}

bool Plant::is_grown() const {
    return impl_->is_grown();
}

bool Plant::grow() {
    return impl_->grow();
}

void Plant::finish() {
    impl_->finish();
}

void Plant::observe(PlantEnvironment& environment) {
    impl_->observe(environment);
}

const ModuleString& Plant::string() const {
    return impl_->string();
}

ModuleString Plant::homomorphic_image() {
    return impl_->homomorphic_image();
}

void Plant::draw(Drawing& drawing) {
    impl_->draw(drawing);
}

const Bounds& Plant::bounds() const {
    return impl_->bounds();
}

}  // namespace quasimc
