// A model and its view file, separated by a zero byte: read, grown a few steps and drawn. Every
// other file that they name is the view file.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
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
    const std::size_t zero = std::min(bytes.find('\0'), bytes.size());
    const std::string model = bytes.substr(0, zero);
    const std::string view = bytes.substr(std::min(zero + 1, bytes.size()));
    const auto read = [&](const std::filesystem::path& path) {
        return path.filename() == "a.l" ? model : view;
    };
    Notices silent([](const std::string&) {});
    try {
        grow(PlantModel::read("/fuzz/a.l", "/fuzz/a.v", silent, read), silent);
    } catch (const InputError&) {  // most inputs are faulty
    }
}

}  // namespace quasimc::fuzz
