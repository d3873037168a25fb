#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "meshio/formats.h"
#include "meshio/ply_header.h"
#include "meshio/ply_values.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Thrown within this file to stop reading after a fault.
struct Broken {
    std::string problem, why;
};

class PlyReader {
  public:
    PlyReader(const PlyHeader& header, std::string_view body, FormatContext& context)
        : header_(header), values_(body, header.encoding), context_(context) {}

    MeshFile read() {
        try {
            for (const PlyElement& element : header_.elements) {
                read_element(element);
            }
            warn_of_rest();
        } catch (const Broken& broken) {
            context_.reporter.fault(0, broken.problem, broken.why);
        }
        name_materials();
        crossed_.warn(context_.reporter);
        mesh_.vertices = std::move(vertices_);
        return std::move(mesh_);
    }

  private:
    /// Warns of data after the last element: faces are missing in the header, or lists are misread.
    void warn_of_rest() {
        if (const std::string rest = values_.rest();
            !rest.empty() && !context_.reporter.is_full()) {
            context_.reporter.warn(fmt::format(
                "there is more data after the last element of the header ({}), which is not read: "
                "counts in the header or lengths of lists are wrong, and faces may be missing; "
                "write the file again",
                rest));
        }
    }

    void read_element(const PlyElement& element) {
        if (element.properties.empty()) {
            return;
        }
        if (element.name == "vertex") {
            vertices_.reserve(std::min<std::uint64_t>(element.count, values_.bytes_left() / 3));
        } else if (element.name == "face") {
            reserve_faces(element);
        }
        for (std::uint64_t i = 0; i < element.count && !context_.reporter.is_full(); ++i) {
            number_ = i + 1;
            if (element.name == "vertex") {
                read_vertex(element);
            } else if (element.name == "face") {
                read_face(element);
            } else {
                skip(element);
            }
        }
        const bool has_corners = std::any_of(
            element.properties.begin(), element.properties.end(),
            [](const PlyProperty& property) { return property.role == PlyRole::corners; });
        if (element.name != "face" && has_corners && element.count > 0) {
            context_.reporter.warn(fmt::format(
                "elements {} have corners and are left out ({} in total): only 'face' is read",
                shown(element.name), element.count));
        }
    }

    double value(const PlyElement& element, PlyType type) {
        const std::optional<double> number = values_.next(type);
        if (!number) {
            throw Broken{
                fmt::format("{} {} is incomplete or not a number", element.name, number_),
                fmt::format("the header says {}", element.count)};
        }
        return *number;
    }

    void read_vertex(const PlyElement& element) {
        std::array<double, 3> p{};
        for (const PlyProperty& property : element.properties) {
            const double x = scalar_or_list(element, property);
            if (property.role >= PlyRole::x && property.role <= PlyRole::z) {
                p[static_cast<std::size_t>(property.role) - static_cast<std::size_t>(PlyRole::x)] =
                    x;
            }
        }
        vertices_.push_back({p[0], p[1], p[2]});
        if (!is_finite(vertices_.back())) {
            context_.reporter.fault(0, fmt::format("vertex {} is not finite", number_), "");
        }
    }

    /// The value of a scalar; the items of a list go to items_.
    double scalar_or_list(const PlyElement& element, const PlyProperty& property) {
        if (!property.is_list) {
            return value(element, property.type);
        }
        const double count = value(element, property.count_type);
        if (!(count >= 0) || count > static_cast<double>(kMaxCorners)) {
            throw Broken{
                fmt::format("{} {} has a list of {}", element.name, number_, count),
                fmt::format("a list has 0 to {}", kMaxCorners)};
        }
        items_.clear();
        const auto items = static_cast<std::size_t>(std::ceil(count));
        for (std::size_t i = 0; i < items; ++i) {
            items_.push_back(value(element, property.type));
        }
        return 0;
    }

    void read_face(const PlyElement& element) {
        corners_.clear();
        numbers_.clear();
        PartKey key;
        for (const PlyProperty& property : element.properties) {
            const double x = scalar_or_list(element, property);
            switch (property.role) {
                case PlyRole::corners:
                    take_corners();
                    break;
                case PlyRole::organ:
                    key.organ = whole(property, x);
                    break;
                case PlyRole::material:
                    key.material = whole(property, x);
                    break;
                default:
                    break;
            }
        }
        if (corners_.size() < 3) {
            context_.reporter.fault(
                0, fmt::format("face {} has {} corners", number_, corners_.size()), "it needs 3");
            return;
        }
        constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
        const auto line = static_cast<std::uint32_t>(std::min(number_, kMost));
        if (part_of(key).add_face(corners_, numbers_, line)) {
            crossed_.add("face", number_);
        }
    }

    void take_corners() {
        for (const double item : items_) {
            if (!(item >= 0 && item < static_cast<double>(vertices_.size())) ||
                item != std::floor(item)) {
                throw Broken{
                    fmt::format("face {} refers to vertex {}", number_, item),
                    fmt::format("there are {}, counted from 0", vertices_.size())};
            }
            numbers_.push_back(static_cast<std::uint32_t>(item));
            corners_.push_back(vertices_[numbers_.back()]);
        }
    }

    [[nodiscard]] std::int64_t whole(const PlyProperty& property, double x) const {
        constexpr double kLargest = 9e15;
        if (x != std::floor(x) || std::abs(x) > kLargest) {
            throw Broken{
                fmt::format("face {}: {} is {}", number_, property.name, x),
                "it must be an integer"};
        }
        return static_cast<std::int64_t>(x);
    }

    void skip(const PlyElement& element) {
        for (const PlyProperty& property : element.properties) {
            scalar_or_list(element, property);
        }
    }

    /// Identifies the part of a face.
    struct PartKey {
        std::optional<std::int64_t> organ = {}, material = {};
        // NOLINTNEXTLINE(modernize-use-nullptr)  it takes the order for a comparison with 0
        friend auto operator<=>(const PartKey&, const PartKey&) = default;
    };

    /// The part of a face, usually that of the previous face.
    MeshPart& part_of(const PartKey& key) {
        if (last_part_ == nullptr || !(key == last_key_)) {
            last_part_ = &find_part(key);
            last_key_ = key;
        }
        return *last_part_;
    }

    /// Finds a part by the number of its material; materials get their names when all are known.
    MeshPart& find_part(const PartKey& key) {
        const auto [group, is_new_group] = groups_.try_emplace(key.organ, mesh_.groups.size());
        if (is_new_group) {
            mesh_.groups.push_back({"", key.organ, {}});
        }
        std::vector<MeshPart>& parts = mesh_.groups[group->second].parts;
        const auto [part, is_new] = parts_.try_emplace(key, parts.size());
        if (is_new) {
            parts.push_back({key.material ? std::to_string(*key.material) : "", {}, {}});
        }
        return parts[part->second];
    }

    /// The unambiguous names of materials in the header, by the digits of their numbers: numbers
    /// that share a name keep their digits, and so do all numeric names if one is another
    /// material's number.
    [[nodiscard]] std::map<std::string, std::string> clear_names() const {
        std::map<std::string, std::size_t> uses;
        for (const auto& [number, name] : header_.materials) {
            ++uses[name];
        }
        std::map<std::string, std::string> names;
        for (const auto& [number, name] : header_.materials) {
            if (!name.empty() && uses[name] == 1) {
                names.emplace(std::to_string(number), name);
            }
        }
        std::set<std::string> unnamed;
        for (const auto& [key, index] : parts_) {
            if (key.material && !names.contains(std::to_string(*key.material))) {
                unnamed.insert(std::to_string(*key.material));
            }
        }
        const bool has_clash = std::any_of(names.begin(), names.end(), [&](const auto& each) {
            return unnamed.contains(each.second);
        });
        if (has_clash) {
            std::erase_if(
                names, [](const auto& each) { return parse_integer(each.second).has_value(); });
        }
        return names;
    }

    /// Names the materials; a run file may also use their numbers, or a name that several share.
    void name_materials() {
        const std::map<std::string, std::string> names = clear_names();
        for (const auto& [key, index] : parts_) {
            MeshPart& part = mesh_.groups[groups_.at(key.organ)].parts[index];
            const auto given =
                key.material ? header_.materials.find(*key.material) : header_.materials.end();
            if (const auto named = names.find(part.material); named != names.end()) {
                mesh_.aliases.emplace(named->second, part.material);
                part.material = named->second;
            } else if (
                given != header_.materials.end() && !given->second.empty() &&
                !parse_integer(given->second)) {
                mesh_.aliases.emplace(part.material, given->second);
            }
            if (header_.has_texture) {
                mesh_.masks.emplace(part.material, "TextureFile");
            }
        }
    }

    /// Reserves memory for a file with all faces in one part.
    void reserve_faces(const PlyElement& element) {
        const bool is_one = std::none_of(
            element.properties.begin(), element.properties.end(), [](const PlyProperty& property) {
                return property.role == PlyRole::organ || property.role == PlyRole::material;
            });
        if (is_one && element.count > 0) {
            constexpr std::uint64_t kMinBytes = 4;
            MeshPart& part = part_of({});
            part.faces.reserve(
                std::min<std::uint64_t>(element.count, values_.bytes_left() / kMinBytes));
            part.lines.reserve(part.faces.capacity());
        }
    }

    const PlyHeader& header_;
    PlyValues values_;
    FormatContext& context_;
    MeshFile mesh_{{}, {}, "face", {}};
    std::vector<Vec3> vertices_, corners_;  // of the file; of a face
    std::vector<std::uint32_t> numbers_;    // of the corners, among the vertices
    std::vector<double> items_;
    CrossedFaces crossed_;
    std::map<std::optional<std::int64_t>, std::size_t> groups_;
    std::map<PartKey, std::size_t> parts_;  // indices in their groups
    PartKey last_key_;
    MeshPart* last_part_ = nullptr;
    std::uint64_t number_ = 0;
};

}  // namespace

MeshFile read_ply(std::string_view bytes, FormatContext& context) {
    const std::optional<PlyHeader> header = read_ply_header(bytes, context.reporter);
    if (!header) {
        return {{}, {}, "face", {}};
    }
    return PlyReader(*header, header->body, context).read();
}

}  // namespace quasimc
