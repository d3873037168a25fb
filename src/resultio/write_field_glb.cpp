#include <cctype>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meshio/glb_parts.h"
#include "quasimc/error.h"
#include "resultio/field_formats.h"
#include "text/little_endian.h"

namespace quasimc {
namespace {

/// Organs are identified by numbers in single precision, which are distinct up to here.
constexpr std::size_t kMaxGlbOrgans = std::size_t{1} << 24U;

/// The name of an application-specific attribute begins with '_', by custom in capital letters.
std::string attribute_name(const std::string& name, std::set<std::string>& taken) {
    std::string wish = "_";
    for (const unsigned char c : name) {
        wish += std::isalnum(c) != 0 ? static_cast<char>(std::toupper(c)) : '_';
    }
    std::string free = wish;
    for (int number = 2; !taken.insert(free).second; ++number) {
        free = fmt::format("{}_{}", wish, number);
    }
    return free;
}

/// The linear value of an sRGB colour (IEC 61966-2-1).
std::uint16_t linear(std::uint8_t screen) {
    const double c = screen / 255.0;
    const double light = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    return static_cast<std::uint16_t>(
        std::lround(light * std::numeric_limits<std::uint16_t>::max()));
}

/// Writes a scene as one mesh whose vertices have the numbers of their organs.
class FieldGlbWriter {
  public:
    explicit FieldGlbWriter(const FieldScene& shown) : shown_(shown) {}

    void write(const TextSink& sink) {
        if (shown_.scene.organs().size() > kMaxGlbOrgans) {
            throw InputError(
                {{"GLB", fmt::format("the scene has more than {} organs", kMaxGlbOrgans), "",
                  "write VTP"}});
        }
        gather();
        const Json node = {
            {"name", "light"}, {"mesh", 0}, {"translation", {origin_.x, origin_.y, origin_.z}}};
        const Json mesh = {{"name", "light"}, {"primitives", Json::array({primitive()})}};
        const Json material = {
            {"name", "light"},
            {"doubleSided", true},
            {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
        parts_.write(
            {{"extensionsUsed", R"(["KHR_materials_unlit"])"},
             {"scenes", glb_scene(1)},
             {"nodes", "[" + json_text(node) + "]"},
             {"meshes", "[" + json_text_with(mesh, "extras", extras()) + "]"},
             {"materials", "[" + json_text(material) + "]"}},
            sink);
    }

  private:
    /// All vertices, organ after organ: two organs share none.
    void gather() {
        GlbMeshes meshes(shown_.scene);
        for (const Organ& organ : shown_.scene.organs()) {
            const Mesh mesh = meshes.mesh(organ.first_triangle, organ.triangle_count);
            const auto first = static_cast<std::uint32_t>(points_.size());
            points_.insert(points_.end(), mesh.vertices.begin(), mesh.vertices.end());
            counts_.push_back(mesh.vertices.size());
            for (const Face& face : mesh.faces) {
                for (const std::uint32_t vertex : face) {
                    append_little_endian(corners_, first + vertex);
                }
            }
        }
        origin_ = middle_of(points_);
    }

    Json primitive() {
        Json attributes;
        attributes["POSITION"] = parts_.add_points(parts_.add_view(kGlbPoints), points_, origin_);
        if (!shown_.colors.empty()) {
            attributes["COLOR_0"] = add_colors();
        }
        attributes["_ORGAN"] =
            add_numbers([](std::size_t organ) { return static_cast<double>(organ); });
        for (const auto& [name, field] : named_fields()) {
            attributes[name] =
                add_numbers([&field = *field](std::size_t organ) { return field.values[organ]; });
        }
        const std::size_t corners = parts_.add_list(parts_.add_view(kGlbIndices), corners_);
        return {{"attributes", attributes}, {"indices", corners}, {"material", 0}};
    }

    [[nodiscard]] std::vector<std::pair<std::string, const OrganField*>> named_fields() const {
        std::set<std::string> taken{"_ORGAN"};
        std::vector<std::pair<std::string, const OrganField*>> named;
        for (const OrganField& field : shown_.fields) {
            named.emplace_back(attribute_name(field.name, taken), &field);
        }
        return named;
    }

    /// The number of its organ for each vertex. Unknown numbers are -1: glTF has no NaN.
    template <typename Value>
    std::size_t add_numbers(const Value& value) {
        std::string bytes;
        for (std::size_t organ = 0; organ < counts_.size(); ++organ) {
            const double number = value(organ);
            std::string one;
            append_little_endian(one, static_cast<float>(std::isfinite(number) ? number : -1));
            for (std::size_t i = 0; i < counts_[organ]; ++i) {
                bytes += one;
            }
        }
        return parts_.add_list(parts_.add_view(kGlbFloats), bytes);
    }

    std::size_t add_colors() {
        std::string bytes;
        for (std::size_t organ = 0; organ < counts_.size(); ++organ) {
            std::string one;
            for (const std::uint8_t part : shown_.colors[organ]) {
                append_little_endian(one, linear(part));
            }
            append_little_endian(one, std::numeric_limits<std::uint16_t>::max());
            for (std::size_t i = 0; i < counts_[organ]; ++i) {
                bytes += one;
            }
        }
        return parts_.add_list(parts_.add_view(kGlbColors), bytes);
    }

    /// The meaning of the numbers, as extras of the mesh: some programs ignore nested ones of
    /// nodes.
    [[nodiscard]] std::string extras() const {
        Json units = Json::object();
        for (const auto& [name, field] : named_fields()) {
            units[name] = field->unit.empty() ? "1" : field->unit;
        }
        std::string organs;
        for (const Organ& organ : shown_.scene.organs()) {
            append_json(organs, {{"id", organ.id}, {"name", organ.name}});
        }
        return json_text_with(
            {{"colors", shown_.colors_of}, {"units", units}}, "organs", "[" + organs + "]");
    }

    const FieldScene& shown_;
    GlbParts parts_;
    std::vector<Vec3> points_;
    std::vector<std::size_t> counts_;  // of the vertices of each organ
    std::string corners_;              // numbers of vertices, as bytes
    Vec3 origin_;
};

}  // namespace

void write_field_glb(const FieldScene& shown, const TextSink& sink) {
    FieldGlbWriter(shown).write(sink);
}

}  // namespace quasimc
