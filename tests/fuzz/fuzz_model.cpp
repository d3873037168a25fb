// A model, its view file, and the content of all files that they name, separated by zero bytes:
// read, grown a few steps and drawn.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "growth/plant.h"
#include "growth/turtle/mesh_drawing.h"
#include "quasimc/error.h"
#include "readers.h"

namespace quasimc::fuzz {
namespace {

/// Answers each query with two numbers.
class FuzzedEnvironment : public PlantEnvironment {
  public:
    Drawing* query(const PlantQuery& query) override {
        answers_.push_back({query.id, {1.0F, std::nullopt, 0.5F}});
        return nullptr;
    }
    std::vector<PlantAnswer> answers(std::int64_t /*step*/) override {
        return std::exchange(answers_, {});
    }

  private:
    std::vector<PlantAnswer> answers_;
};

void grow(const std::shared_ptr<const PlantModel>& model, Notices& notices) {
    constexpr std::int64_t kMaxSteps = 3;
    FuzzedEnvironment environment;
    GrowthOptions options;
    options.steps = std::min(model->steps(), kMaxSteps);
    options.limits = {.string_bytes = 1U << 16U, .loop_rounds = 1000, .open_files = 0};
    options.print = [](std::string_view) {};
    Plant plant(model, &environment, notices, options);
    while (plant.grow()) {
    }
    plant.finish();
    static_cast<void>(plant.string().lines());
    static_cast<void>(plant.homomorphic_image().text());
    MeshDrawing drawing(3);
    plant.draw(drawing);
}

}  // namespace

void fuzz_model(const std::string& bytes) {
    std::istringstream stream(bytes);
    std::array<std::string, 3> parts;
    for (std::string& part : parts) {
        std::getline(stream, part, '\0');
    }
    const auto read = [&](const std::filesystem::path& path) {
        return parts[path.filename() == "a.l" ? 0 : path.filename() == "a.v" ? 1 : 2];
    };
    Notices silent([](const std::string&) {});
    try {
        grow(PlantModel::read("/fuzz/a.l", "/fuzz/a.v", silent, read), silent);
    } catch (const InputError&) {  // most inputs are faulty
    }
}

}  // namespace quasimc::fuzz
