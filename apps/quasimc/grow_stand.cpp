#include "grow_stand.h"

#include <filesystem>
#include <utility>
#include <vector>

#include "base/text.h"
#include "files/input_files.h"
#include "quasimc/error.h"
#include "runfile/run_file.h"
#include "text/document.h"

namespace {

void send_warnings(const std::vector<quasimc::Warning>& warnings, quasimc::Notices& notices) {
    for (const quasimc::Warning& warning : warnings) {
        notices.once(warning.where.empty() ? warning.text : warning.where + ": " + warning.text);
    }
}

/// The light of a run file on the scene of a plant.
quasimc::StandLight read_stand_light(
    const quasimc::Node& document,
    const std::string& path,
    const quasimc::Scene& scene,
    quasimc::Notices& notices) {
    quasimc::InputFiles files(quasimc::absolute_path(path).parent_path());
    quasimc::LightOfRun light = quasimc::read_light_document(document, path, files, scene);
    if (light.series) {
        throw quasimc::InputError({{path, "a growth step has no time steps", "", "remove [time]"}});
    }
    send_warnings(light.warnings, notices);
    return {std::move(light.sources), std::move(light.spec)};
}

}  // namespace

bool is_stand_file(const std::string& path) {
    return quasimc::lower_case(std::filesystem::path(path).extension().string()) == ".toml";
}

std::unique_ptr<quasimc::LightOnStand> read_stand(
    const std::string& path, int sides, quasimc::Notices& notices, const std::stop_token& stop) {
    const quasimc::Node document = quasimc::read_toml(quasimc::read_file(path), path);
    quasimc::InputFiles files(quasimc::absolute_path(path).parent_path());
    quasimc::FrameOfRun frame = quasimc::read_frame_document(document, path, files);
    send_warnings(frame.warnings, notices);
    quasimc::LightOnStand::Options options;
    options.sides = sides;
    options.control = [stop] { return quasimc::RunControl{.stop = stop}; };
    return std::make_unique<quasimc::LightOnStand>(
        std::move(frame.builder),
        [document, path, &notices](const quasimc::Scene& scene) {
            return read_stand_light(document, path, scene, notices);
        },
        std::move(options));
}
