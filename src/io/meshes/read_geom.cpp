#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "io/line_scanner.h"
#include "io/meshes/file_axes.h"
#include "io/meshes/formats.h"
#include "io/meshes/geom_text.h"
#include "io/meshes/geom_transform.h"
#include "io/meshes/placed_triangles.h"
#include "io/numbers.h"

namespace quasimc {
namespace {

/// Goes through the shapes of a scene; each becomes an organ.
class GeomSceneReader {
  public:
    GeomSceneReader(const GeomText& text, Reporter& reporter)
        : text_(text), reporter_(reporter), placed_(file_, reporter) {}

    MeshFile read() {
        if (text_.shapes.empty()) {
            reporter_.fault(0, "it has no Shape", "geometry alone is not shown by PlantGL either");
        }
        for (const std::size_t shape : text_.shapes) {
            if (!reporter_.is_full() && count_ <= kMostPlaces) {
                read_shape(text_.objects[shape]);
            }
        }
        crossed_.warn(reporter_);
        drop_repeated_ids(file_, "shape", reporter_);
        return std::move(file_);
    }

  private:
    static constexpr std::size_t kMostPlaces = 1000000;

    /// An object that is still to be looked at, and what it is moved by.
    struct Open {
        std::size_t object;
        Affine transform;
    };

    void read_shape(const GeomObject& shape) {
        const GeomField* geometry = shape.find("Geometry");
        const GeomField* appearance = shape.find("Appearance");
        std::optional<std::size_t> first;
        if (geometry == nullptr) {
            reporter_.fault(shape.line, "the Shape has no Geometry", "");
        } else {
            first = object_of(*geometry);
        }
        const auto material = appearance == nullptr ? std::nullopt : object_of(*appearance);
        if (!first) {
            return;
        }
        MeshGroup group{one_line(std::string(shape.name)), {}, {}};
        if (group.name.empty()) {
            group.name = one_line(std::string(text_.objects[*first].name));
        }
        if (group.name.empty()) {
            group.name = fmt::format("shape {}", file_.groups.size());
        }
        group.id = whole_field(shape, "Id");
        if (const auto parent = whole_field(shape, "ParentId")) {
            group.labels.emplace_back("parent_id", std::to_string(*parent));
        }
        const std::string name = material ? material_name(*material) : "";
        place(*first, name, shape.line, group);
        if (!group.parts.empty()) {
            file_.groups.push_back(std::move(group));
        }
    }

    /// The object that a field holds or names; nothing after a fault.
    std::optional<std::size_t> object_of(const GeomField& field) {
        if (const auto* objects = std::get_if<std::vector<std::size_t>>(&field.value)) {
            return objects->front();
        }
        const auto* word = std::get_if<std::string_view>(&field.value);
        reporter_.fault(
            field.line,
            word == nullptr ? fmt::format("{} is no object", shown(field.name))
                            : fmt::format("there is no {}", shown(*word)),
            "what is named comes before");
        return std::nullopt;
    }

    std::optional<std::int64_t> whole_field(const GeomObject& object, std::string_view name) {
        const GeomField* field = object.find(name);
        if (field == nullptr) {
            return std::nullopt;
        }
        const auto* number = std::get_if<double>(&field->value);
        const auto whole = number == nullptr ? std::nullopt : whole_number(*number);
        if (!whole) {
            reporter_.fault(field->line, fmt::format("{} is no whole number", name), "");
        }
        return whole;
    }

    /// What an appearance is called; its colour is noted when it is first used.
    std::string material_name(std::size_t number) {
        if (const auto known = materials_.find(number); known != materials_.end()) {
            return known->second;
        }
        const GeomObject& material = text_.objects[number];
        std::string name = one_line(std::string(material.name));
        if (name.empty()) {
            name = fmt::format("material of line {}", material.line);
        }
        if (material.type == "Material") {
            constexpr double kUsualAmbient = 160, kWhite = 255;
            const double ambient =
                color_of(material.find("Ambient")).value_or(kUsualAmbient) / kWhite;
            const GeomField* field = material.find("Diffuse");
            const auto* diffuse = field == nullptr ? nullptr : std::get_if<double>(&field->value);
            const double share = diffuse == nullptr ? 1 : *diffuse;
            const double reflectance = std::min(1.0, std::max(0.0, ambient * share));
            name = names_.name_of(name, reflectance, file_);
            file_.materials.push_back({name, reflectance});
        }
        materials_.emplace(number, name);
        return name;
    }

    /// The mean of a colour of 0 to 255.
    static std::optional<double> color_of(const GeomField* field) {
        constexpr double kFull = 255;
        if (field == nullptr) {
            return std::nullopt;
        }
        if (const auto* grey = std::get_if<double>(&field->value)) {
            return *grey;
        }
        if (const auto* rows = std::get_if<GeomRows>(&field->value)) {
            return rows->numbers.size() < 3
                       ? std::nullopt
                       : std::optional(
                             (rows->numbers[0] + rows->numbers[1] + rows->numbers[2]) / 3);
        }
        const auto* word = std::get_if<std::string_view>(&field->value);
        const std::string_view name = word == nullptr ? "" : *word;
        if (name == "Red" || name == "Green" || name == "Blue") {
            return kFull / 3;
        }
        if (name == "Cyan" || name == "Magenta" || name == "Yellow") {
            return kFull * 2 / 3;
        }
        return name == "White"   ? std::optional(kFull)
               : name == "Black" ? std::optional(0.0)
                                 : std::nullopt;
    }

    /// Adds what is in an object to a group.
    void place(
        std::size_t first, const std::string& material, std::uint32_t line, MeshGroup& group) {
        std::vector<Open> open{{first, Affine()}};
        while (!open.empty() && !reporter_.is_full()) {
            const Open place = open.back();
            open.pop_back();
            if (++count_ > kMostPlaces) {
                reporter_.fault(0, fmt::format("it places more than {} objects", kMostPlaces), "");
                return;
            }
            const GeomObject& object = text_.objects[place.object];
            if (object.type == "TriangleSet" || object.type == "QuadSet" ||
                object.type == "FaceSet") {
                placed_.add(triangles_of(place.object), place.transform, material, line, group);
            } else if (object.type == "Group") {
                open_list(object, place.transform, open);
            } else if (const auto own = geom_transform(object, reporter_)) {
                const GeomField* inner = object.find("Geometry");
                const auto next = inner == nullptr ? std::nullopt : object_of(*inner);
                if (inner == nullptr) {
                    reporter_.fault(
                        object.line, fmt::format("{} has no Geometry", object.type), "");
                } else if (next) {
                    open.push_back({*next, after(place.transform, *own)});
                }
            }
        }
    }

    void open_list(const GeomObject& group, const Affine& transform, std::vector<Open>& open) {
        const GeomField* list = group.find("GeometryList");
        const auto* objects =
            list == nullptr ? nullptr : std::get_if<std::vector<std::size_t>>(&list->value);
        if (objects == nullptr) {
            reporter_.fault(group.line, "Group has no GeometryList", "");
            return;
        }
        for (auto object = objects->rbegin(); object != objects->rend(); ++object) {
            open.push_back({*object, transform});
        }
    }

    /// The triangles of a set of faces, made when it is first placed.
    const LocalTriangles& triangles_of(std::size_t number) {
        const auto [found, is_new] = shapes_.try_emplace(number);
        if (is_new) {
            read_faces(text_.objects[number], found->second);
        }
        return found->second;
    }

    void read_faces(const GeomObject& object, LocalTriangles& triangles) {
        const GeomField* points = object.find("PointList");
        const GeomField* indices = object.find("IndexList");
        const auto* xyz = points == nullptr ? nullptr : std::get_if<GeomRows>(&points->value);
        const auto* faces = indices == nullptr ? nullptr : std::get_if<GeomRows>(&indices->value);
        if (xyz == nullptr || faces == nullptr || xyz->numbers.size() != 3 * xyz->size()) {
            reporter_.fault(
                object.line, fmt::format("{} needs a PointList and an IndexList", object.type),
                "points are <x,y,z>, faces [i,j,k]");
            return;
        }
        for (std::size_t i = 0; i < xyz->numbers.size(); i += 3) {
            triangles.points.push_back({xyz->numbers[i], xyz->numbers[i + 1], xyz->numbers[i + 2]});
        }
        const GeomField* order = object.find("CCW");
        const auto* word =
            order == nullptr ? nullptr : std::get_if<std::string_view>(&order->value);
        const bool is_clockwise = word != nullptr && *word == "False";
        for (std::size_t row = 0; row < faces->size(); ++row) {
            if (!add_face(*faces, row, is_clockwise, triangles)) {
                reporter_.fault(
                    indices->line, fmt::format("face {} of the {}", row, object.type),
                    fmt::format(
                        "it needs 3 to {} of the {} points, counted from 0", kMostCorners,
                        triangles.points.size()));
                return;
            }
        }
    }

    bool add_face(
        const GeomRows& faces, std::size_t row, bool is_clockwise, LocalTriangles& triangles) {
        corners_.clear();
        points_.clear();
        const auto count = static_cast<double>(triangles.points.size());
        for (std::size_t i = faces.begin_of(row); i < faces.ends[row]; ++i) {
            const double number = faces.numbers[i];
            if (!(number >= 0 && number < count) || number != std::floor(number)) {
                return false;
            }
            corners_.push_back(static_cast<std::uint32_t>(number));
        }
        if (corners_.size() < 3 || corners_.size() > kMostCorners) {
            return false;
        }
        if (is_clockwise) {
            std::reverse(corners_.begin(), corners_.end());
        }
        for (const std::uint32_t corner : corners_) {
            points_.push_back(triangles.points[corner]);
        }
        if (add_polygon(points_, corners_, triangles)) {
            crossed_.add("face", row);
        }
        return true;
    }

    const GeomText& text_;
    Reporter& reporter_;
    MeshFile file_{{}, {}, "line", {}};
    PlacedTriangles placed_;
    std::map<std::size_t, LocalTriangles> shapes_;  // those placed so far
    std::map<std::size_t, std::string> materials_;  // names of those used
    MaterialNames names_;
    std::vector<std::uint32_t> corners_;
    std::vector<Vec3> points_;
    CrossedFaces crossed_;
    std::size_t count_ = 0;
};

}  // namespace

MeshFile read_geom(std::string_view bytes, FormatContext& context) {
    const std::optional<GeomText> text = read_geom_text(bytes, context.reporter);
    if (!text) {
        return {{}, {}, "line", {}};
    }
    return GeomSceneReader(*text, context.reporter).read();
}

}  // namespace quasimc
