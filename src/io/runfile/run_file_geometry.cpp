#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/runfile/run_file_sections.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 3> kOrganWords{"each", "groups", "one"};

/// What a [[geometry]] table states of the organs of its file.
struct GeometryKeys {
    std::string file, name, organs;
    Labels labels;
    std::optional<std::string> material;
    std::map<std::string, std::string> materials;
    std::optional<std::int64_t> first_id;
    std::optional<Affine> transform;
    std::vector<Affine> copies;  ///< where copies stand, after `transform`; none: once, as it is
};

std::map<std::string, std::string> read_material_map(TableReader& table) {
    std::map<std::string, std::string> result;
    const Node* node = table.any("materials");
    const auto* members = node ? node->as<Node::Table>() : nullptr;
    if (node != nullptr && members == nullptr) {
        table.fault_at(
            *node, fmt::format("materials is {}", node->type_name()),
            "it must be a table: name in the file = \"name of a [[material]]\"");
    }
    for (std::size_t i = 0; members && i < members->size(); ++i) {
        const Member& member = (*members)[i];
        if (const auto* text = member.node.as<std::string>()) {
            result[member.key] = *text;
        } else {
            table.fault_at(
                member.node, fmt::format("materials.{} is {}", member.key, member.node.type_name()),
                "it must be the name of a [[material]]");
        }
    }
    return result;
}

/// Finds the materials of the run for those of a file.
class MaterialFinder {
  public:
    MaterialFinder(
        const GeometryKeys& keys,
        std::vector<MeshMaterial> of_library,
        TableReader& table,
        RunFileContext& context,
        SceneBuilder& builder)
        : keys_(keys),
          of_library_(std::move(of_library)),
          table_(table),
          context_(context),
          builder_(builder) {}

    /// The run's name of a file's material; a fault, once, if there is none.
    std::string find(const std::string& name) {
        const auto [entry, is_new] = found_.try_emplace(name);
        if (is_new) {
            entry->second = find_new(name);
        }
        return entry->second;
    }

  private:
    std::string find_new(const std::string& name) {
        if (const auto mapped = keys_.materials.find(name); mapped != keys_.materials.end()) {
            return mapped->second;
        }
        if (!name.empty() && context_.materials.contains(name)) {
            return name;
        }
        if (keys_.material) {
            if (!name.empty()) {
                warn(fmt::format(
                    "material '{}' of {} is not in the run file; '{}' is used", name, keys_.file,
                    *keys_.material));
            }
            return *keys_.material;
        }
        for (const MeshMaterial& material : of_library_) {
            if (!name.empty() && material.name == name) {
                return add_from_library(material);
            }
        }
        if (name.empty()) {
            table_.fault(
                fmt::format("{} names no material for its triangles", keys_.file), "",
                "add material = \"...\"");
        } else {
            table_.fault(
                fmt::format("material '{}' of {} is not in the run file", name, keys_.file), "",
                fmt::format(
                    "add a [[material]] of that name, or materials = {{ \"{}\" = \"...\" }}",
                    name));
        }
        // Any other one, so that nobody is told besides that "" does not exist.
        return context_.materials.empty() ? "" : *context_.materials.begin();
    }

    std::string add_from_library(const MeshMaterial& material) {
        warn(fmt::format(
            "material '{}' of {} is not in the run file; {} gives reflectance {:.4g}, "
            "transmittance {:.4g} in every band",
            material.name, keys_.file, material.is_color ? "its diffuse colour" : "that file",
            material.reflectance, material.transmittance));
        SideOptics side;
        side.reflectance = material.reflectance;
        side.transmittance = material.transmittance;
        const std::vector<SideOptics> sides(context_.bands.size(), side);
        builder_.add_material({material.name, sides, sides}, table_.place());
        context_.materials.insert(material.name);
        return material.name;
    }

    void warn(std::string text) {
        context_.reporter->warnings.push_back({table_.place(), std::move(text)});
    }

    const GeometryKeys& keys_;
    std::vector<MeshMaterial> of_library_;
    TableReader& table_;
    RunFileContext& context_;
    SceneBuilder& builder_;
    std::map<std::string, std::string> found_;
};

/// Adds the organs of a file to the builder.
class OrganAdder {
  public:
    OrganAdder(const GeometryKeys& keys, MaterialFinder& materials, SceneBuilder& builder)
        : keys_(keys), materials_(materials), builder_(builder) {}

    void add(MeshFile file) {
        line_word_ = file.line_word;
        if (keys_.organs == "each") {
            add_each_triangle(file);
            return;
        }
        if (keys_.organs == "one" && !keys_.copies.empty()) {
            file.groups = {merged(std::move(file.groups))};
        }
        std::vector<Mesh> meshes = file.take_meshes();
        if (keys_.copies.empty()) {
            add_organs(file.groups, [&](std::size_t part) {
                return OrganPart{"", std::move(meshes[part]), {}, {}};
            });
            return;
        }
        std::vector<std::shared_ptr<const Mesh>> shared;
        shared.reserve(meshes.size());
        for (Mesh& mesh : meshes) {
            shared.push_back(std::make_shared<const Mesh>(std::move(mesh)));
        }
        for (const Affine& copy : keys_.copies) {
            ++copy_;
            add_organs(file.groups, [&](std::size_t part) {
                return OrganPart{"", {}, shared[part], copy};
            });
        }
    }

  private:
    /// One group with one part for each material: few large meshes are better to copy than many
    /// small ones.
    static MeshGroup merged(std::vector<MeshGroup> groups) {
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

    void add_each_triangle(const MeshFile& file) {
        const std::vector<Affine> once(1);
        for (const Affine& copy : keys_.copies.empty() ? once : keys_.copies) {
            for (const MeshGroup& group : file.groups) {
                for (const MeshPart& part : group.parts) {
                    add_triangles(file, group.labels, part, copy);
                }
            }
        }
    }

    void add_triangles(
        const MeshFile& file, const Labels& labels, const MeshPart& part, const Affine& copy) {
        const std::string material = materials_.find(part.material);
        for (std::size_t i = 0; i < part.faces.size(); ++i) {
            ++count_;
            OrganSpec organ =
                make_organ({}, keys_.name.empty() ? "" : fmt::format("{} {}", keys_.name, count_));
            add_labels(labels, organ);
            organ.place = place(part.lines[i]);
            std::vector<Triangle> triangle{file.triangle(part, i)};
            if (!keys_.copies.empty()) {
                move_triangles(copy, triangle);
            }
            organ.parts.push_back({material, triangle});
            builder_.add_organ(std::move(organ));
        }
    }

    /// @param make_part  makes the part of that number, counted through all groups
    template <typename MakePart>
    void add_organs(const std::vector<MeshGroup>& groups, const MakePart& make_part) {
        std::size_t number = 0;
        const auto add_parts = [&](const MeshGroup& group, OrganSpec& organ) {
            for (const MeshPart& part : group.parts) {
                organ.parts.push_back(make_part(number++));
                organ.parts.back().material = materials_.find(part.material);
            }
        };
        if (keys_.organs == "one") {
            ++count_;
            OrganSpec organ = make_organ({}, name_of(""));
            organ.place = keys_.file;
            for (const MeshGroup& group : groups) {
                add_parts(group, organ);
            }
            builder_.add_organ(std::move(organ));
            return;
        }
        for (const MeshGroup& group : groups) {
            ++count_;
            OrganSpec organ = make_organ(group.id, name_of(group.name));
            organ.place = place(group.parts.front().lines.front());
            add_labels(group.labels, organ);
            add_parts(group, organ);
            builder_.add_organ(std::move(organ));
        }
    }

    /// The stated name, the number of the copy if there are several, and the name in the file.
    [[nodiscard]] std::string name_of(const std::string& group) const {
        std::string name = keys_.name;
        if (!keys_.copies.empty()) {
            name = fmt::format("{} {}", name.empty() ? "copy" : name, copy_);
        }
        return name + (name.empty() || group.empty() ? "" : " ") + group;
    }

    /// An organ without parts; its id is the file's, unless the run file numbers them or there are
    /// copies.
    [[nodiscard]] OrganSpec make_organ(std::optional<std::int64_t> id, std::string name) const {
        OrganSpec organ;
        organ.id = keys_.first_id         ? std::optional(*keys_.first_id + count_ - 1)
                   : keys_.copies.empty() ? id
                                          : std::nullopt;
        organ.name = std::move(name);
        organ.labels = keys_.labels;
        return organ;
    }

    /// The labels of the file, but for those that the run file states.
    void add_labels(const Labels& labels, OrganSpec& organ) const {
        for (const auto& label : labels) {
            const auto is_same = [&](const auto& stated) { return stated.first == label.first; };
            if (std::none_of(keys_.labels.begin(), keys_.labels.end(), is_same)) {
                organ.labels.push_back(label);
            }
        }
    }

    [[nodiscard]] std::string place(std::uint32_t line) const {
        return line_word_ == "line" ? fmt::format("{}:{}", keys_.file, line)
                                    : fmt::format("{}: {} {}", keys_.file, line_word_, line);
    }

    const GeometryKeys& keys_;
    std::string_view line_word_;
    MaterialFinder& materials_;
    SceneBuilder& builder_;
    std::int64_t count_ = 0, copy_ = 0;
};

void read_one(const Node& node, RunFileContext& context, SceneBuilder& builder) {
    constexpr Range kFirstId{-1e15, 1e15};
    TableReader table(node, "geometry", *context.reporter);
    GeometryKeys keys;
    keys.name = table.text("name").value_or("");
    keys.labels = read_labels(table);
    keys.material = table.text("material");
    keys.materials = read_material_map(table);
    keys.first_id = table.integer("first_id", kFirstId);
    keys.transform = read_transform(table);
    keys.copies = read_copies(table, context.orientation).value_or(std::vector<Affine>());
    const std::optional<std::string> organs = table.choice("organs", kOrganWords);
    std::optional<NamedMesh> named = read_named_mesh(table, context);
    table.finish();
    if (!named || table.failed()) {
        return;
    }
    keys.file = named->file;
    keys.organs = organs.value_or(std::string(named->format->organs));
    if (keys.transform) {
        move_points(*keys.transform, named->mesh.vertices);
    }
    MaterialFinder materials(keys, std::move(named->mesh.materials), table, context, builder);
    OrganAdder(keys, materials, builder).add(std::move(named->mesh));
}

}  // namespace

void read_geometry(TableReader& top, RunFileContext& context, SceneBuilder& builder) {
    for (const Node* node : top.tables("geometry")) {
        read_one(*node, context, builder);
    }
}

}  // namespace quasimc
