#include "grow_environment.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "coupling/plants/environment_program.h"
#include "coupling/plants/light_in_process.h"
#include "coupling/plants/light_on_stand.h"
#include "files/input_files.h"
#include "grow_stand.h"
#include "quasimc/run.h"
#include "resultio/describe_series.h"
#include "results/units.h"
#include "terminal.h"

namespace {

/// Whether an organ of a drawn plant is of a module with this symbol.
bool is_of_module(const quasimc::Organ& organ, const std::string& symbol) {
    return !symbol.empty() && !organ.labels.empty() &&
           organ.labels.begin()->second == symbol.substr(0, 1);
}

}  // namespace

GrowEnvironment::GrowEnvironment(
    const GrowArguments& arguments,
    quasimc::Notices& notices,
    const std::stop_token& stop,
    int sides)
    : notices_(notices) {
    if (arguments.light.empty()) {
        const std::string& file = arguments.environment;
        auto program = std::make_unique<quasimc::EnvironmentProgram>(
            quasimc::read_comm_text(quasimc::read_file(file), file, notices), file, notices);
        has_started_ = program->is_connected();
        if (!has_started_) {
            print_error(file + ": the plant grows without its environment");
        }
        inner_ = std::move(program);
    } else if (is_stand_file(arguments.light)) {
        auto light = read_stand(arguments.light, sides, notices, stop);
        stand_ = light.get();
        inner_ = std::move(light);
    } else {
        add_specification(arguments.light, notices, stop);
    }
}

GrowEnvironment::~GrowEnvironment() = default;

void GrowEnvironment::add_specification(
    const std::string& file, quasimc::Notices& notices, const std::stop_token& stop) {
    const auto check = [stop] {
        if (stop.stop_requested()) {
            throw quasimc::Stopped(quasimc::StopReason::interrupted, "The light was stopped.");
        }
    };
    // The files that it names are relative to its folder.
    quasimc::InputFiles files(std::filesystem::path(file).parent_path());
    auto light = std::make_unique<quasimc::LightInProcess>(
        quasimc::read_specification_text(
            quasimc::read_file(file), file, quasimc::SpecificationKind::quasimc, files, notices),
        notices, print_error, quasimc::LightInProcess::Options{{}, check});
    inputs_ = files.files();
    light_ = light.get();
    inner_ = std::move(light);
}

quasimc::Drawing* GrowEnvironment::query(const quasimc::PlantQuery& query) {
    if (light_ != nullptr) {
        asked_.push_back({query.module.index, query.following});
    }
    return inner_->query(query);
}

std::vector<quasimc::PlantAnswer> GrowEnvironment::answers(std::int64_t step) {
    std::vector<Asked> asked = std::exchange(asked_, {});
    std::vector<quasimc::PlantAnswer> answers = inner_->answers(step);
    if (stand_ != nullptr) {
        note_stand(step);
        const auto& queried = stand_->queried();
        if (!queried.empty() && std::none_of(queried.begin(), queried.end(), [](const auto& organ) {
                return organ.has_value();
            })) {
            notices_.once(
                "no query of the plant is answered: in a stand, the module after a query must draw "
                "an organ, in the model or by its homomorphism");
        }
    } else if (!asked.empty()) {
        answered_ = std::move(asked);
        pass_step_ = step;
    }
    return answers;
}

void GrowEnvironment::note_stand(std::int64_t step) {
    auto light = std::make_shared<quasimc::StepLight>();
    if (stand_->scene()) {
        light->scene = *stand_->scene();
        light->results.push_back(*stand_->result());
        stand_step_.specification.bands = stand_->scene()->bands();
        stand_step_.lighting.sources = {stand_->light()->sources};
    }
    stand_step_.light = std::move(light);
    pass_step_ = step;
}

quasimc::StepSnapshot GrowEnvironment::light() const {
    if (stand_ != nullptr) {
        return {pass_step_, stand_step_.specification, stand_step_.lighting, stand_step_.light};
    }
    return light_->snapshot();
}

bool GrowEnvironment::has_failed() const {
    return !has_started_ || (light_ != nullptr && light_->worst() != quasimc::SessionOutcome::good);
}

std::vector<std::uint32_t> GrowEnvironment::light_of(const quasimc::Scene& drawn) const {
    std::vector<std::uint32_t> organs(drawn.organs().size(), quasimc::kNoOrgan);
    if (stand_ != nullptr) {
        for (std::size_t i = 0; i < organs.size() && stand_->scene(); ++i) {
            const std::int64_t id = stand_->id_of(drawn.organs()[i].id);
            const auto organ = stand_->scene()->names()->find_organ(id);
            organs[i] = organ ? static_cast<std::uint32_t>(*organ) : quasimc::kNoOrgan;
        }
        return organs;
    }
    const std::vector<std::uint32_t> lit = light().light->organs;
    if (lit.size() != answered_.size()) {
        return organs;
    }
    for (std::size_t i = 0; i < answered_.size(); ++i) {
        // A query has two modules, '?' and a letter; an organ's id is its module's index + 1.
        for (const std::size_t after : {std::size_t{1}, std::size_t{2}}) {
            const auto id = static_cast<std::int64_t>(answered_[i].module + after) + 1;
            const auto organ = drawn.names()->find_organ(id);
            if (organ && is_of_module(drawn.organs()[*organ], answered_[i].following)) {
                organs[*organ] = lit[i];
            }
        }
    }
    return organs;
}

std::vector<ShownValues> light_values(
    const quasimc::StepSnapshot& light, std::span<const std::uint32_t> organs) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    std::vector<ShownValues> all;
    const std::vector<quasimc::Band>& bands = light.specification.bands;
    const auto& scene = light.light->scene;
    const std::string length_unit = scene ? scene->length_unit() : "";
    for (const quasimc::QuantityEntry& entry : quasimc::quantity_table()) {
        for (std::size_t b = 0; b < bands.size(); ++b) {
            ShownValues values{
                .estimates = {},
                .name =
                    fmt::format("{}, {}", quasimc::describe_quantity(entry.name), bands[b].name),
                .unit = quasimc::unit_of(entry, bands[b], length_unit),
                .key = fmt::format("{}_{}", entry.name, bands[b].name),
                .when = ""};
            for (const std::uint32_t organ : organs) {
                values.estimates.push_back(
                    organ == quasimc::kNoOrgan
                        ? quasimc::Estimate{kUnknown, kUnknown, kUnknown, kUnknown}
                        : quasimc::reported(light.light->at(organ, entry.quantity, b)));
            }
            all.push_back(std::move(values));
        }
    }
    return all;
}
