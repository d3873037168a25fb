#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/number_text.h"
#include "io/meshes/formats.h"

namespace quasimc {
namespace {

/// The area of all faces, and of those whose material is in a map.
struct PartAreas {
    double all = 0, found = 0;
    std::set<std::string> materials;  ///< those found
};

PartAreas areas_of(const MeshFile& file, const std::map<std::string, std::string>& names) {
    PartAreas areas;
    for (const MeshGroup& group : file.groups) {
        for (const MeshPart& part : group.parts) {
            double sum = 0;
            for (std::size_t i = 0; i < part.faces.size(); ++i) {
                sum += area(file.triangle(part, i));
            }
            areas.all += sum;
            if (names.contains(part.material)) {
                areas.found += sum;
                areas.materials.insert(part.material);
            }
        }
    }
    return areas;
}

/// @param problem  follows "2 materials"; @param answer  ends the sentence
void warn_of_opacity(
    const MeshFile& file,
    const std::map<std::string, std::string>& names,
    std::string_view problem,
    std::string_view answer,
    Reporter& reporter) {
    if (names.empty()) {
        return;
    }
    const PartAreas areas = areas_of(file, names);
    if (areas.materials.empty()) {
        return;
    }
    std::set<std::string> words;
    for (const std::string& material : areas.materials) {
        words.insert(names.at(material));
    }
    const std::size_t count = areas.materials.size();
    reporter.warnings.push_back(
        {reporter.file, fmt::format(
                            "{} {} {} ({}): {}, {:.4g} of the area of {:.4g}",
                            counted(count, "material"), count == 1 ? "has" : "have", problem,
                            fmt::join(words, ", "), answer, areas.found, areas.all)});
}

}  // namespace

bool may_have_alpha(std::string_view image) {
    std::string name(image);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return !name.ends_with(".jpg") && !name.ends_with(".jpeg");
}

void warn_of_unread_opacity(const MeshFile& file, Reporter& reporter) {
    warn_of_opacity(
        file, file.masks, "textures that can cut out parts of a face",
        "masks are not read, and each face counts whole", reporter);
    warn_of_opacity(
        file, file.transparent, "an opacity below 1",
        "opacity is not read, and each face counts as a surface", reporter);
}

}  // namespace quasimc
