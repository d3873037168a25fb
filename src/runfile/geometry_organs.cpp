#include "runfile/geometry_organs.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace quasimc {
namespace {

/// Merges groups into one with one part per material, as few large meshes are faster to copy.
MeshGroup merged(std::vector<MeshGroup> groups) {
    MeshGroup all;
    for (MeshGroup& group : groups) {
        for (MeshPart& part : group.parts) {
            const auto known = std::find_if(
                all.parts.begin(), all.parts.end(),
                [&](const MeshPart& other) { return other.material == part.material; });
            if (known == all.parts.end()) {
                all.parts.push_back(std::move(part));
                continue;
            }
            known->faces.insert(known->faces.end(), part.faces.begin(), part.faces.end());
            known->lines.insert(known->lines.end(), part.lines.begin(), part.lines.end());
        }
    }
    return all;
}

/// The meshes of the parts of a file: shared by its copies, or for one organ.
struct PartMeshes {
    std::vector<Mesh> own;
    std::vector<std::shared_ptr<const Mesh>> shared;
};

PartMeshes take_part_meshes(MeshFile& file, bool is_shared) {
    PartMeshes meshes{.own = file.take_meshes(), .shared = {}};
    for (std::size_t i = 0; is_shared && i < meshes.own.size(); ++i) {
        meshes.shared.push_back(std::make_shared<const Mesh>(std::move(meshes.own[i])));
    }
    return meshes;
}

/// Adds organs to a builder and counts them.
class OrganAdder {
  public:
    OrganAdder(const GeometryKeys& keys, SceneBuilder& builder) : keys_(keys), builder_(builder) {}

    void add_triangles(const FileOfTable& file, const FileCopy& copy) {
        for (const MeshGroup& group : file.mesh.groups) {
            for (const MeshPart& part : group.parts) {
                add_part(file, group.labels, part, copy);
            }
        }
    }

    /// Adds an organ for each group, or one for all.
    void add_groups(const FileOfTable& file, const FileCopy& copy, PartMeshes& meshes) {
        std::size_t number = 0;
        const auto add_parts = [&](const MeshGroup& group, OrganSpec& organ) {
            for (const MeshPart& part : group.parts) {
                OrganPart& added = organ.parts.emplace_back();
                added.material = file.materials.at(part.material);
                if (keys_.has_copies) {
                    added.shared = meshes.shared[number];
                    added.transform = copy.transform;
                } else {
                    added.triangles = std::move(meshes.own[number]);
                }
                ++number;
            }
        };
        if (keys_.organs == "one") {
            OrganSpec organ = make_organ({}, copy, copy.name);
            organ.where = file.name;
            for (const MeshGroup& group : file.mesh.groups) {
                add_parts(group, organ);
            }
            builder_.add_organ(std::move(organ));
            return;
        }
        for (const MeshGroup& group : file.mesh.groups) {
            const std::string separator = copy.name.empty() || group.name.empty() ? "" : " ";
            OrganSpec organ = make_organ(group.id, copy, copy.name + separator + group.name);
            organ.where = where(file, group.parts.front().lines.front());
            add_labels(group.labels, organ);
            add_parts(group, organ);
            builder_.add_organ(std::move(organ));
        }
    }

  private:
    void add_part(
        const FileOfTable& file, const Labels& labels, const MeshPart& part, const FileCopy& copy) {
        const std::string material = file.materials.at(part.material);
        for (std::size_t i = 0; i < part.faces.size(); ++i) {
            OrganSpec organ = make_organ(
                {}, copy, copy.name.empty() ? "" : fmt::format("{} {}", copy.name, count_ + 1));
            add_labels(labels, organ);
            organ.where = where(file, part.lines[i]);
            std::vector<Triangle> triangle{file.mesh.triangle(part, i)};
            if (keys_.has_copies) {
                move_triangles(copy.transform, triangle);
            }
            organ.parts.push_back({material, triangle});
            builder_.add_organ(std::move(organ));
        }
    }

    /// An organ without parts, with the id in the file, unless the run file numbers organs or there
    /// are copies.
    [[nodiscard]] OrganSpec make_organ(
        std::optional<std::int64_t> id, const FileCopy& copy, std::string name) {
        OrganSpec organ;
        organ.id = keys_.first_id     ? std::optional(*keys_.first_id + count_)
                   : keys_.has_copies ? std::nullopt
                                      : id;
        organ.name = std::move(name);
        organ.labels = copy.labels;
        organ.measured = keys_.measured;
        ++count_;
        return organ;
    }

    /// Adds the labels of the file, except those that the run file gives.
    static void add_labels(const Labels& labels, OrganSpec& organ) {
        const std::size_t given = organ.labels.size();
        for (const auto& label : labels) {
            const auto end = organ.labels.begin() + static_cast<std::ptrdiff_t>(given);
            const auto is_same = [&](const auto& own) { return own.first == label.first; };
            if (std::none_of(organ.labels.begin(), end, is_same)) {
                organ.labels.push_back(label);
            }
        }
    }

    static std::string where(const FileOfTable& file, std::uint32_t line) {
        return file.mesh.line_word == "line"
                   ? fmt::format("{}:{}", file.name, line)
                   : fmt::format("{}: {} {}", file.name, file.mesh.line_word, line);
    }

    const GeometryKeys& keys_;
    SceneBuilder& builder_;
    std::int64_t count_ = 0;
};

}  // namespace

void add_geometry(const GeometryKeys& keys, std::vector<FileOfTable> files, SceneBuilder& builder) {
    OrganAdder adder(keys, builder);
    std::vector<PartMeshes> meshes(files.size());
    for (std::size_t f = 0; keys.organs != "each" && f < files.size(); ++f) {
        if (keys.organs == "one" && keys.has_copies) {
            files[f].mesh.groups = {merged(std::move(files[f].mesh.groups))};
        }
        meshes[f] = take_part_meshes(files[f].mesh, keys.has_copies);
    }
    for (const FileCopy& copy : keys.copies) {
        if (keys.organs == "each") {
            adder.add_triangles(files[copy.file], copy);
        } else {
            adder.add_groups(files[copy.file], copy, meshes[copy.file]);
        }
    }
}

}  // namespace quasimc
