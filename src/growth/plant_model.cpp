#include "growth/plant_model.h"

#include <filesystem>
#include <utility>

#include "growth/language/parser.h"
#include "growth/language/preprocessor.h"
#include "growth/language/program.h"
#include "growth/view/view.h"

namespace quasimc {

PlantModel::PlantModel() : program_(std::make_unique<PlantProgram>()) {}
PlantModel::~PlantModel() = default;

std::shared_ptr<const PlantModel> PlantModel::read(
    const std::string& model,
    const std::string& view,
    Notices& notices,
    InputFiles::Reader reader) {
    std::shared_ptr<PlantModel> result(new PlantModel());
    PlantProgram& program = *result->program_;
    Faults faults;
    const auto guarded = [&](const auto& read_file_of_model) {
        try {
            read_file_of_model();
        } catch (const InputError& error) {
            faults.add(error);
        }
    };
    InputFiles sources(std::filesystem::path(), std::move(reader));
    guarded([&] { parse_model(preprocess(model, sources, notices), program, notices); });
    if (!view.empty()) {
        guarded([&] {
            program.view = read_view(preprocess(view, sources, notices), sources, notices);
        });
    }
    faults.throw_if_any();
    program.inputs = sources.files();
    return result;
}

const View& PlantModel::view() const {
    return program_->view;
}

std::int64_t PlantModel::steps() const {
    return program_->steps;
}

bool PlantModel::asks_environment() const {
    return program_->has_queries;
}

const std::vector<InputFile>& PlantModel::inputs() const {
    return program_->inputs;
}

}  // namespace quasimc
