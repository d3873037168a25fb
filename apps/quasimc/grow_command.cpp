// The command `grow`: plants from models in cpfg's language.

#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <stop_token>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/process_time.h"
#include "commands.h"
#include "grow_environment.h"
#include "grow_flags.h"
#include "grow_outputs.h"
#include "grow_pictures.h"
#include "grow_plant.h"
#include "grow_steps.h"
#include "grow_window.h"
#include "growth/plant.h"
#include "interrupt.h"
#include "quasimc/quasimc.h"
#include "terminal.h"

namespace {

/// A plant that grows, and all that follows it.
struct Growth {
    const GrowArguments& arguments;
    const quasimc::PlantModel& model;
    quasimc::Plant& plant;
    GrowEnvironment* environment;  ///< may be null
    const GrowWriters& writers;
    StepTable& table;
    GrowPictures* pictures;  ///< may be null
    GrowWindow* window;      ///< may be null

    /// The plant after the last complete step.
    [[nodiscard]] GrownPlant current() const { return {plant, model.view(), environment}; }
    [[nodiscard]] bool has_light() const {
        return environment != nullptr && environment->has_light();
    }
};

/// Reports the light of a pass.
void on_pass(const Growth& growth) {
    if (!growth.has_light()) {
        return;
    }
    growth.table.set_light(*growth.environment);
    if (growth.pictures != nullptr) {
        growth.pictures->set_light(*growth.environment);
    }
    if (growth.window != nullptr) {
        growth.window->set_light(*growth.environment);
    }
}

/// Writes and shows the plant after a step.
void on_step(const Growth& growth) {
    GrownPlant plant = growth.current();
    if (growth.arguments.verbose) {
        fmt::print(
            stderr, "step {}: {}\n", plant.step(),
            quasimc::counted(plant.plant().string().size(), "module"));
    }
    growth.writers.write_step(plant);
    if (growth.pictures != nullptr) {
        growth.pictures->add(plant);
    }
    if (!growth.arguments.series.empty()) {
        growth.table.add(plant);
    }
    if (growth.window != nullptr) {
        growth.window->add(plant, !growth.arguments.light.empty());
    }
}

/// Ends the growth. The last step is shown after it, as it may change the string. Its light is
/// computed for the outputs alone, unless the plant has received it.
void end_growth(const Growth& growth) {
    growth.plant.finish();
    on_step(growth);
    if (growth.has_light() && growth.environment->pass_step() != growth.plant.step()) {
        growth.plant.observe(*growth.environment);
    }
    if (growth.environment != nullptr && growth.environment->pass_step() == growth.plant.step()) {
        on_pass(growth);
    }
}

/// Grows the plant to its last step, or until a stop.
void grow_to_end(const Growth& growth, const std::stop_token& stop) {
    while (!growth.plant.is_grown()) {
        on_step(growth);
        if (stop.stop_requested()) {
            return;
        }
        growth.plant.grow();
        on_pass(growth);
    }
    end_growth(growth);
}

/// @returns why it ended, if by an error
quasimc::Faults grow_plant(const Growth& growth, const std::stop_token& stop) {
    quasimc::Faults faults;
    try {
        grow_to_end(growth, stop);
    } catch (const quasimc::InputError& error) {
        // Ctrl-C ends the environment program as well.
        if (!stop.stop_requested() || growth.arguments.environment.empty()) {
            faults.add(error);
        }
    } catch (const std::bad_alloc&) {
        faults.add(
            {fmt::format("step {}", growth.plant.step() + 1), "there is not enough memory",
             fmt::format("the string before it has {} modules", growth.plant.string().size()),
             "make fewer steps"});
    } catch (const quasimc::Stopped&) {
        // The plant is that before the step, and the token says that it was stopped.
    }
    return faults;
}

/// "40 steps, 1234 modules, 321 organs, 0.12 s", and the light of the last pass.
void print_summary(const Growth& growth, GrownPlant& plant, double seconds) {
    const auto steps = static_cast<std::uint64_t>(plant.step());
    const std::string organs =
        plant.is_drawn() && plant.scene()
            ? quasimc::counted(plant.scene()->organs().size(), "organ") + ", "
            : "";
    fmt::print(
        stderr, "{}, {}, {}{:.2f} s\n", quasimc::counted(steps, "step"),
        quasimc::counted(plant.plant().string().size(), "module"), organs, seconds);
    if (!growth.has_light()) {
        return;
    }
    const quasimc::StepSnapshot light = growth.environment->light();
    const auto& bands = light.specification.bands;
    const auto absorbed = absorbed_light(*light.light);
    for (std::size_t b = 0; b < absorbed.size(); ++b) {
        const double error = absorbed[b].standard_error;
        fmt::print(
            stderr, "light of step {}, {}: organs absorb {:.6g}{}\n",
            growth.environment->pass_step(), bands[b].name, absorbed[b].mean,
            std::isfinite(error) ? ", standard error " + quasimc::error_text(error) : "");
    }
}

/// Makes the folder of a series, and adds its table to the outputs.
void prepare_series(
    const GrowArguments& arguments, const StepTable& table, std::vector<GrowOutput>& outputs) {
    if (arguments.series.empty()) {
        return;
    }
    const std::filesystem::path folder(arguments.series);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        throw quasimc::InputError(
            {{"--series", fmt::format("the folder '{}' can't be made", arguments.series),
              error.message(), ""}});
    }
    outputs.push_back(
        {{(folder / "steps.csv").string(), "--series"},
         [&table](GrownPlant& /*plant*/, const quasimc::TextSink& sink) { sink(table.text()); }});
}

/// The files that were read.
std::vector<quasimc::InputFile> inputs_of(
    const GrowArguments& arguments,
    const quasimc::PlantModel& model,
    const GrowEnvironment* environment) {
    std::vector<quasimc::InputFile> inputs = model.inputs();
    for (const std::string& path : {arguments.light, arguments.environment}) {
        if (!path.empty()) {
            inputs.push_back({path, path, "", 0, false});
        }
    }
    if (environment != nullptr) {
        inputs.insert(inputs.end(), environment->inputs().begin(), environment->inputs().end());
    }
    return inputs;
}

/// The environment that the flags name; null without one.
std::unique_ptr<GrowEnvironment> make_environment(
    const GrowArguments& arguments,
    const quasimc::PlantModel& model,
    quasimc::Notices& notices,
    const std::stop_token& stop) {
    if (!arguments.light.empty() || !arguments.environment.empty()) {
        return std::make_unique<GrowEnvironment>(
            arguments, notices, stop, model.view().contour_sides);
    }
    if (model.asks_environment()) {
        notices.once(arguments.model + ": queries have no answers: give --light or -e");
    }
    return nullptr;
}

/// The title of pictures and of the page.
std::string name_of(const GrowArguments& arguments) {
    return std::filesystem::path(arguments.model).filename().string();
}

std::unique_ptr<GrowPictures> make_pictures(
    const GrowArguments& arguments, const std::vector<quasimc::InputFile>& inputs) {
    if (!is_picture_name(arguments.output)) {
        return nullptr;
    }
    return std::make_unique<GrowPictures>(
        arguments.output, name_of(arguments), arguments.picture, inputs);
}

std::unique_ptr<GrowWindow> open_window(const GrowArguments& arguments) {
    if (!arguments.view) {
        return nullptr;
    }
    auto window =
        std::make_unique<GrowWindow>(static_cast<int>(arguments.port), name_of(arguments));
    fmt::print(stderr, "view: {}\n", window->address());
    return window;
}

quasimc::Faults write_pictures(const GrowPictures& pictures) {
    quasimc::Faults faults;
    try {
        pictures.write();
    } catch (const quasimc::InputError& error) {
        faults.add(error);
    }
    return faults;
}

/// Writes the files of the end, prints the summary, and throws the errors.
void finish_growth(
    const Growth& growth, GrowWriters& writers, quasimc::Faults faults, double seconds) {
    GrownPlant plant = growth.current();
    faults.add(writers.finish(plant));
    if (growth.pictures != nullptr) {
        faults.add(write_pictures(*growth.pictures));
    }
    if (!growth.arguments.quiet) {
        print_summary(growth, plant, seconds);
    }
    faults.throw_if_any();
}

Exit grow(const GrowArguments& arguments) {
    const quasimc::Stopwatch watch;
    std::atomic<bool> is_grown = false;
    const InterruptWatch interrupt([&arguments, &is_grown] {
        if (!arguments.quiet && !is_grown) {
            std::fputs("\nstopping after this step; Ctrl-C again ends at once\n", stderr);
        }
    });
    quasimc::Notices notices([&arguments](const std::string& text) {
        if (!arguments.quiet) {
            print_warning(text);
        }
    });
    std::vector<GrowOutput> outputs = grow_outputs(arguments);
    const auto model = quasimc::PlantModel::read(arguments.model, arguments.view_file, notices);
    StepTable table;
    prepare_series(arguments, table, outputs);
    check_numbered(outputs, arguments.steps >= 0 ? arguments.steps : model->steps());
    const auto environment = make_environment(arguments, *model, notices, interrupt.token());
    const std::vector<quasimc::InputFile> inputs = inputs_of(arguments, *model, environment.get());
    GrowWriters writers(std::move(outputs), inputs);
    const auto pictures = make_pictures(arguments, inputs);
    const auto window = open_window(arguments);
    const auto print = [](std::string_view text) {
        std::fwrite(text.data(), 1, text.size(), stderr);
    };
    quasimc::GrowthOptions options{.steps = arguments.steps, .print = print};
    options.limits.string_bytes = arguments.string_limit << 20U;
    if (arguments.seed) {
        options.seed = static_cast<std::uint16_t>(*arguments.seed);
    }
    quasimc::Plant plant(model, environment.get(), notices, std::move(options));
    const Growth growth{arguments, *model, plant,          environment.get(),
                        writers,   table,  pictures.get(), window.get()};
    quasimc::Faults faults = grow_plant(growth, interrupt.token());
    is_grown = true;
    const bool is_stopped = interrupt.token().stop_requested();
    if (window) {
        window->end(
            is_stopped       ? "The growth was stopped."
            : faults.empty() ? "The plant has grown."
                             : "The growth ended with an error.");
    }
    finish_growth(growth, writers, std::move(faults), watch.seconds());
    if (window && !is_stopped) {
        fmt::print(stderr, "The page stays until Ctrl-C.\n");
        interrupt.wait_for_first();
    }
    const bool has_failed = environment && environment->has_failed();
    return is_stopped ? Exit::interrupted : has_failed ? Exit::input_error : Exit::done;
}

}  // namespace

Command grow_command() {
    const auto arguments = std::make_shared<GrowArguments>();
    return {
        "grow",
        "grow a plant by an L-system in cpfg's language",
        flags_of_grow(*arguments),
        [arguments] { return grow(with_default_files(*arguments)); },
        [arguments] { check_usage(*arguments); },
        cpfg_flags()};
}
