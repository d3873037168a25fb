#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/meshes/dae_library.h"
#include "io/meshes/dae_transform.h"
#include "io/meshes/file_axes.h"
#include "io/meshes/formats.h"

namespace quasimc {
namespace {

/// Goes through the nodes of the scene; each with a geometry becomes an organ.
class DaeReader {
  public:
    DaeReader(const XmlTree& tree, FormatContext& context)
        : tree_(tree),
          context_(context),
          library_(tree, context.reporter),
          placed_(file_, context.reporter) {}

    MeshFile read() {
        const Affine top = dae_axes(tree_, library_, context_);
        if (const auto scene = find_scene()) {
            open_children(*scene, {*scene, top, ""});
        }
        while (!open_.empty() && !context_.reporter.is_full()) {
            const Open above = std::move(open_.back());
            open_.pop_back();
            if (++count_ > kMostNodes) {
                context_.reporter.fault(
                    0, fmt::format("it places more than {} nodes", kMostNodes), "");
                break;
            }
            read_node(above);
        }
        add_materials();
        library_.finish();
        if (skinned_ > 0) {
            warn(fmt::format("{} shapes with a skin or a morph are left out", skinned_));
        }
        return std::move(file_);
    }

  private:
    static constexpr std::size_t kMostNodes = 1000000;

    struct UsedMaterial {
        std::string name;
        std::optional<double> reflectance;
    };

    /// A node that is still to be looked at.
    struct Open {
        std::size_t node;
        Affine transform;    ///< of what it is below
        std::string parent;  ///< the nearest name above it
    };

    /// The scene that is shown, or else the only one.
    std::optional<std::size_t> find_scene() {
        const auto shown_scene = tree_.child(0, "scene");
        const auto instance =
            shown_scene ? tree_.child(*shown_scene, "instance_visual_scene") : std::nullopt;
        if (instance) {
            return library_.target(*instance, tree_[*instance].attribute("url"), "visual_scene");
        }
        const auto first = tree_.find_in(0, "visual_scene");
        if (!first) {
            context_.reporter.fault(0, "it has no <visual_scene>", "nothing places its geometry");
        }
        return first;
    }

    /// What is in a node or scene comes next, in the order of the file.
    void open_children(std::size_t of, const Open& above) {
        constexpr std::array<std::string_view, 15> kKnown{
            "asset",
            "lookat",
            "matrix",
            "rotate",
            "scale",
            "skew",
            "node",
            "translate",
            "instance_camera",
            "extra",
            "evaluate_scene",
            "instance_controller",
            "instance_geometry",
            "instance_light",
            "instance_node"};
        library_.check_children(of, kKnown);
        const std::vector<std::size_t>& children = tree_[of].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            if (tree_[*child].name == "node") {
                open_.push_back({*child, above.transform, above.parent});
            } else if (tree_[*child].name == "instance_node") {
                if (const auto node =
                        library_.target(*child, tree_[*child].attribute("url"), "node")) {
                    open_.push_back({*node, above.transform, above.parent});
                }
            }
        }
    }

    void read_node(const Open& above) {
        const std::optional<Affine> own = dae_transform(tree_, above.node, library_);
        if (!own) {
            return;
        }
        const Affine transform = after(above.transform, *own);
        const std::string name = library_.name_of(above.node);
        MeshGroup group{name, {}, {}};
        std::string mesh;
        for (const std::size_t child : tree_[above.node].children) {
            if (tree_[child].name == "instance_controller") {
                ++skinned_;
            } else if (tree_[child].name == "instance_geometry") {
                const std::string geometry = add_geometry(child, transform, group);
                mesh = mesh.empty() ? geometry : mesh;
            }
        }
        if (!group.parts.empty()) {
            group.name = group.name.empty() ? mesh : group.name;
            add_label("parent", above.parent, group);
            add_label("mesh", mesh, group);
            file_.groups.push_back(std::move(group));
        }
        open_children(above.node, {above.node, transform, name.empty() ? above.parent : name});
    }

    /// @returns what the geometry is called
    std::string add_geometry(std::size_t instance, const Affine& transform, MeshGroup& group) {
        const auto element =
            library_.target(instance, tree_[instance].attribute("url"), "geometry");
        if (!element) {
            return "";
        }
        const DaeGeometry& geometry = library_.geometry(*element);
        for (const DaePart& part : geometry.parts) {
            placed_.add(
                part.triangles, transform, material_of(instance, part.symbol), tree_[instance].line,
                group);
        }
        return geometry.name;
    }

    /// The material that an instance binds to a symbol; the symbol if it binds none.
    std::string material_of(std::size_t instance, std::string_view symbol) {
        const auto bind = tree_.child(instance, "bind_material");
        const auto common = bind ? tree_.child(*bind, "technique_common") : std::nullopt;
        const auto materials =
            common ? tree_.children(*common, "instance_material") : std::vector<std::size_t>();
        for (const std::size_t material : materials) {
            if (tree_[material].attribute("symbol") == symbol) {
                const auto target =
                    library_.target(material, tree_[material].attribute("target"), "material");
                return target ? used_material(*target) : "";
            }
        }
        return one_line(std::string(symbol));
    }

    std::string used_material(std::size_t material) {
        const auto [known, is_new] = materials_.try_emplace(material);
        if (is_new) {
            const DaeLibrary::Appearance appearance = library_.appearance_of(material);
            const std::string name =
                names_.name_of(library_.name_of(material), appearance.reflectance, file_);
            known->second = {name, appearance.reflectance};
            if (appearance.has_mask) {
                file_.masks.emplace(name, "texture");
            }
        }
        return known->second.name;
    }

    void add_materials() {
        std::set<std::string> known;
        for (const auto& [material, used] : materials_) {
            if (used.reflectance && known.insert(used.name).second) {
                file_.materials.push_back({used.name, *used.reflectance});
            }
        }
    }

    void warn(std::string text) {
        context_.reporter.warnings.push_back({context_.reporter.file, std::move(text)});
    }

    const XmlTree& tree_;
    FormatContext& context_;
    DaeLibrary library_;
    MeshFile file_{{}, {}, "line", {}};
    PlacedTriangles placed_;
    std::vector<Open> open_;
    std::map<std::size_t, UsedMaterial> materials_;
    MaterialNames names_;
    std::size_t count_ = 0, skinned_ = 0;
};

}  // namespace

MeshFile read_dae(std::string_view bytes, FormatContext& context) {
    const XmlTree tree(bytes);
    if (tree.fault()) {
        context.reporter.fault(
            tree.fault()->line, std::string(tree.fault()->problem), "it is no XML");
        return {{}, {}, "line", {}};
    }
    if (tree.empty() || tree[0].name != "COLLADA") {
        context.reporter.fault(
            0, "it is no COLLADA file", "its outermost element is not <COLLADA>");
        return {{}, {}, "line", {}};
    }
    return DaeReader(tree, context).read();
}

}  // namespace quasimc
