#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/notices.h"
#include "growth/plant.h"
#include "growth/turtle/plain_geometry.h"
#include "quasimc/error.h"
#include "support/temporary_folder.h"

namespace quasimc::test {

/// The outcome of a model: its last string, and the texts that came with it. Paths in the texts
/// are relative to the folder of the model.
struct Grown {
    std::string text;      ///< the string, without line breaks
    std::string image;     ///< with the homomorphism
    std::string geometry;  ///< lines of PlainGeometry
    std::string printed;   ///< by printf
    std::vector<std::string> notices, faults;
    std::int64_t steps = 0;
};

/// Which texts of a grown plant are wanted besides its string.
enum class GrownParts { string_only, all };

/// Removes the name of a folder from a text.
inline std::string without_folder(std::string text, const std::string& folder) {
    for (auto at = text.find(folder + "/"); at != std::string::npos; at = text.find(folder + "/")) {
        text.erase(at, folder.size() + 1);
    }
    return text;
}

/// Grows the model `model.l` of a folder, with `plant.v`.
inline Grown grow_in(
    const TemporaryFolder& folder,
    PlantEnvironment* environment = nullptr,
    GrownParts parts = GrownParts::string_only,
    GrowthOptions options = {}) {
    Grown grown;
    const std::string root = folder.path().string();
    Notices notices(
        [&](const std::string& text) { grown.notices.push_back(without_folder(text, root)); });
    options.folder = root;
    options.print = [&](std::string_view text) { grown.printed += text; };
    try {
        const auto model = PlantModel::read(
            (folder.path() / "model.l").string(), (folder.path() / "plant.v").string(), notices);
        Plant plant(model, environment, notices, options);
        while (plant.grow()) {
        }
        plant.finish();
        grown.text = plant.string().text();
        grown.steps = plant.step();
        if (parts == GrownParts::all) {
            grown.image = plant.homomorphic_image().text();
            PlainGeometry geometry(model->view());
            plant.draw(geometry);
            grown.geometry = geometry.text();
        }
    } catch (const InputError& error) {
        for (const Fault& fault : error.faults()) {
            grown.faults.push_back(without_folder(fault.text(), root));
        }
    }
    return grown;
}

/// Grows a model, from its text and that of its view file, in a folder of its own.
inline Grown grow(
    const std::string& model,
    const std::string& view = "",
    PlantEnvironment* environment = nullptr,
    GrowthOptions options = {}) {
    const TemporaryFolder folder;
    folder.write("model.l", model);
    folder.write("plant.v", view);
    return grow_in(folder, environment, GrownParts::all, std::move(options));
}

/// A model of one L-system. @param productions  lines, with the sections after them
inline std::string lsystem(
    int steps, std::string_view axiom, std::string_view productions, std::string_view header = "") {
    return fmt::format(
        "Lsystem: 1\nderivation length: {}\n{}\naxiom: {}\n{}\nendlsystem\n", steps, header, axiom,
        productions);
}

/// The string after one step.
inline std::string after_step(std::string_view axiom, std::string_view productions) {
    return grow(lsystem(1, axiom, productions)).text;
}

/// The values of expressions, separated by commas.
inline std::string values(const std::string& expressions) {
    const Grown grown = grow(lsystem(0, "A(" + expressions + ")", "\n"));
    if (!grown.faults.empty()) {
        return grown.faults.front();
    }
    return grown.text.substr(2, grown.text.size() - 3);
}

}  // namespace quasimc::test
