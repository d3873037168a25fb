#include "coupling/vlab/organ_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "scene/lint.h"
#include "text/line_scanner.h"

namespace quasimc {
/// The frame of an organ: unit vectors.
struct OrganFrame {
    Vec3 base;
    Vec3 across;   ///< heading x up
    Vec3 heading;  ///< unit
    Vec3 up;       ///< unit, at right angles to the heading

    [[nodiscard]] Vec3 point(const Vec3& p) const {
        return base + p.x * across + p.y * heading + p.z * up;
    }
};

namespace {

std::optional<OrganFrame> frame_of(const Turtle& turtle) {
    const Vec3 across = cross(turtle.heading, turtle.up);
    if (!is_finite(turtle.position) || !is_finite(across) || !(length(across) > 0)) {
        return std::nullopt;
    }
    const Vec3 x = normalized(across), y = normalized(turtle.heading);
    return OrganFrame{turtle.position, x, y, cross(x, y)};
}

/// Exchanges the sides of triangles.
void turn_over(std::vector<Triangle>& triangles) {
    for (Triangle& t : triangles) {
        std::swap(t[1], t[2]);
    }
}

/// Divides a polygon into a fan of triangles from its first corner, all on one side, as the
/// original program does. Empty if a triangle has no computable area.
std::optional<std::vector<Triangle>> make_fan(std::span<const Vec3> corners) {
    std::vector<Triangle> fan;
    Vec3 normal;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        fan.push_back({corners[0], corners[i], corners[i + 1]});
        normal += area_vector(fan.back());
        if (!is_finite(normal)) {
            return std::nullopt;
        }
    }
    for (Triangle& t : fan) {
        if (dot(area_vector(t), normal) < 0) {
            std::swap(t[1], t[2]);
        }
    }
    return fan;
}

}  // namespace

/// Makes the shape of one module.
class OrganShapes::Maker {
  public:
    Maker(const Specification& spec, Notices& notices, const Pass& pass, const Query& query)
        : spec_(spec),
          notices_(notices),
          pass_(pass),
          query_(query),
          parameters_(pass.parameters_of(query)) {}

    OrganShape make() {
        if (query_.polygons.count > 0) {
            return make_polygons();
        }
        return make_with(&Maker::rhombus);
    }
    OrganShape make_sensor() {
        return query_.polygons.count > 0 ? make_polygons() : make_with(&Maker::rectangle);
    }

  private:
    using Triangles = std::vector<Triangle>;
    using Make = Triangles (Maker::*)();

    /// One row of the table of modules.
    struct Entry {
        std::string_view name;
        std::size_t least_parameters;
        std::size_t material_parameter;  ///< from 0
        Make make;
    };

    /// @param flat_leaf  maker for P
    OrganShape make_with(Make flat_leaf) {
        const std::array<Entry, 5> entries{
            {{"P", 2, 2, flat_leaf},
             {"T", 2, 2, &Maker::isosceles},
             {"U", 4, 4, &Maker::any_triangle},
             {"I", 2, 2, &Maker::cylinder},
             {"S", 2, 0, &Maker::surface}}};
        const auto* entry = std::find_if(
            entries.begin(), entries.end(), [&](const Entry& e) { return e.name == query_.organ; });
        if (entry == entries.end()) {
            not_understood();
            return {};
        }
        if (parameters_.size() < entry->least_parameters) {
            report(
                "parameters", fmt::format(
                                  "has {}; {} are needed", counted(parameters_.size(), "parameter"),
                                  entry->least_parameters));
            return {};
        }
        const auto frame = frame_of(query_.turtle);
        if (!frame) {
            report("frame", "has no position: position, heading or up are not valid vectors");
            return {};
        }
        frame_ = *frame;
        OrganShape shape{(this->*entry->make)(), {}};
        shape.materials =
            query_.organ == "S" ? surface_materials() : materials_from(entry->material_parameter);
        return shape;
    }

    void not_understood() {
        if (query_.organ.empty()) {
            notices_.once(
                "no module follows",
                "a query without a following module has no organ and is answered 0");
            return;
        }
        const std::string graphics =
            pass_.other_graphics.empty()
                ? ""
                : fmt::format(
                      " (only polygons of the graphics are read; there were others, such as '{}')",
                      pass_.other_graphics.front());
        notices_.once(
            "module " + query_.organ, fmt::format(
                                          "module {} is unknown{}: its queries are answered 0; "
                                          "known are P, T, U, S, I, Q and J",
                                          shown(query_.organ), graphics));
    }

    void report(const std::string& key, const std::string& text) {
        notices_.once(
            fmt::format("{} {}", query_.organ, key),
            query_.organ.empty()
                ? fmt::format("query {}, without a module, {}", query_.id, text)
                : fmt::format("module {} (query {}) {}", query_.organ, query_.id, text));
    }

    /// A size from the parameters; empty, with a notice, unless it is positive.
    std::optional<double> size(std::size_t index, std::string_view name) {
        const double value = parameters_[index];
        constexpr double kLargest = 1e30;
        if (value > 0 && value <= kLargest) {
            return value;
        }
        if (value != 0) {
            report(
                "size",
                fmt::format(
                    "has {} {}, which is not a size: it receives no light", name, shortest(value)));
        }
        return std::nullopt;
    }

    Triangles rhombus() {
        const auto half_width = size(0, "half width"), length = size(1, "length");
        if (!half_width || !length) {
            return {};
        }
        return make_rhombus(frame_.base, *length * frame_.heading, frame_.up, 2 * *half_width);
    }

    Triangles rectangle() {
        const auto length = size(0, "length"), width = size(1, "width");
        if (!length || !width) {
            return {};
        }
        const Vec3 side = *width * frame_.across;
        return make_parallelogram(frame_.base - 0.5 * side, side, *length * frame_.heading);
    }

    Triangles isosceles() {
        const auto half_base = size(0, "half base"), height = size(1, "height");
        if (!half_base || !height) {
            return {};
        }
        return make_triangle(
            frame_.point({-*half_base, 0, 0}), frame_.point({*half_base, 0, 0}),
            frame_.point({0, *height, 0}));
    }

    Triangles any_triangle() {
        const auto height = size(2, "height");
        const double left = parameters_[0], right = parameters_[1], degrees = parameters_[3];
        const bool is_triangle = left >= 0 && right >= 0 && left + right > 0 &&
                                 std::isfinite(left + right) && std::abs(degrees) <= 90;
        if (!is_triangle) {
            report("base", "has no base: it needs two lengths and an angle of -90 to 90 degrees");
        }
        if (!height || !is_triangle) {
            return {};
        }
        const double angle = degrees * std::numbers::pi / 180;
        const Vec3 along{std::sin(angle), std::cos(angle), 0};
        Triangles triangle = make_triangle(
            frame_.point(-left * along), frame_.point(right * along),
            frame_.point({0, *height, 0}));
        if (angle < 0) {
            turn_over(triangle);
        }
        return triangle;
    }

    Triangles cylinder() {
        const auto width = size(0, "radius"), length = size(1, "length");
        if (!spec_.cylinder_width_is_given) {
            notices_.once(
                "cylinder width",
                "I(r, l): r is the radius, as in the manual of the environments; write 'cylinder "
                "width: diameter' if your model uses the diameter");
        }
        if (!width || !length) {
            return {};
        }
        const double radius = spec_.cylinder_takes_diameter ? 0.5 * *width : *width;
        return make_cylinder(
            frame_.base, *length * frame_.heading, radius, radius, spec_.cylinder_sides, false);
    }

    /// Number of parameters of S that are scales: those before the material.
    [[nodiscard]] std::size_t scale_count() const {
        constexpr std::size_t kFirstScale = 1, kMaxScales = 3;
        std::size_t end = parameters_.size();
        if (spec_.material_parameter && *spec_.material_parameter > kFirstScale + 1) {
            end = std::min(end, *spec_.material_parameter - 1);
        }
        return std::min(end - kFirstScale, kMaxScales);
    }

    Triangles surface() {
        const double id = parameters_[0];
        if (!(id >= 0 && id < static_cast<double>(spec_.surfaces.size())) || id != std::floor(id)) {
            report(
                "surface", fmt::format(
                               "uses surface {}; the specification file has {}, counted from 0",
                               shortest(id), spec_.surfaces.size()));
            return {};
        }
        Vec3 scale;
        const std::size_t count = scale_count();
        for (std::size_t i = 0; i < count; ++i) {
            if (!size(i + 1, "scale")) {
                return {};
            }
        }
        scale.x = parameters_[1];
        scale.y = count >= 2 ? parameters_[2] : scale.x;
        scale.z = count == 3 ? parameters_[3] : count == 2 ? 1 : scale.x;
        Triangles triangles = spec_.surfaces[static_cast<std::size_t>(id)].triangles;
        for (Triangle& t : triangles) {
            for (Vec3& p : t) {
                p = frame_.point({scale.x * p.x, scale.y * p.y, scale.z * p.z});
            }
        }
        return triangles;
    }

    SideMaterials surface_materials() {
        constexpr std::size_t kFirstFree = 3;  // the first two are id and scale
        if (spec_.material_parameter && *spec_.material_parameter < kFirstFree) {
            report(
                "material parameter",
                fmt::format(
                    "uses the leaf material: 'material parameter: {}' is its id or its scale",
                    *spec_.material_parameter));
            return spec_.sides_of(0, std::nullopt);
        }
        return spec_.material_parameter ? materials_from(*spec_.material_parameter - 1)
                                        : spec_.sides_of(0, std::nullopt);
    }

    SideMaterials materials_from(std::size_t index) {
        const auto upper = material_at(index), lower = material_at(index + 1);
        return spec_.sides_of(upper.value_or(0), lower);
    }

    std::optional<std::size_t> material_at(std::size_t index) {
        if (index >= parameters_.size() || std::isnan(parameters_[index])) {
            return std::nullopt;
        }
        // A length that came with polygons may be no material at all.
        const bool is_surely_material = query_.polygons.count == 0 || spec_.material_parameter;
        if (is_surely_material && parameters_[index] != std::floor(parameters_[index])) {
            report(
                "fraction", fmt::format(
                                "uses material {}; text after the point is ignored",
                                shortest(parameters_[index])));
        }
        const std::size_t first = spec_.first_material();
        const double number = std::floor(parameters_[index]) - static_cast<double>(first);
        if (number >= 0 && number < static_cast<double>(spec_.materials.size())) {
            return static_cast<std::size_t>(number);
        }
        report(
            "material",
            fmt::format(
                "uses material {}, but there are {} to {}; the leaf material is used",
                shortest(parameters_[index]), first, first + spec_.materials.size() - 1));
        return std::nullopt;
    }

    OrganShape make_polygons() {
        OrganShape shape;
        for (std::uint32_t i = 0; i < query_.polygons.count; ++i) {
            const std::uint32_t polygon = query_.polygons.first + i;
            const ListPart part = pass_.polygons[polygon];
            line_ = pass_.polygon_lines[polygon];
            add_polygon(std::span(pass_.vertices).subspan(part.first, part.count), shape.triangles);
        }
        // Without the directive any parameter may be a material, or a length.
        const std::size_t index = spec_.material_parameter.value_or(1) - 1;
        const bool names_material =
            spec_.material_parameter ||
            (!parameters_.empty() &&
             parameters_.front() <
                 static_cast<double>(spec_.first_material() + spec_.materials.size()));
        shape.materials = names_material ? materials_from(index) : spec_.sides_of(0, std::nullopt);
        return shape;
    }

    /// Reports a problem of the current polygon.
    void report_polygon(const std::string& key, const std::string& text) {
        const std::string where = line_ == 0 ? "" : fmt::format(" (line {} of its message)", line_);
        report(key, fmt::format("has a polygon{} {}", where, text));
    }

    void add_polygon(std::span<const Vec3> corners, Triangles& triangles) {
        if (corners.size() < 3) {
            report_polygon("polygon", "of " + counted(corners.size(), "corner"));
            return;
        }
        if (!std::all_of(corners.begin(), corners.end(), is_finite)) {
            report_polygon("polygon", "with an invalid corner");
            return;
        }
        Triangles polygon = cut(corners);
        if (std::all_of(polygon.begin(), polygon.end(), is_degenerate)) {
            report_polygon("area", "without area: it receives no light");
        }
        Vec3 normal;
        for (const Triangle& t : polygon) {
            normal += area_vector(t);
        }
        if (dot(normal, query_.turtle.up) < 0) {
            turn_over(polygon);
        }
        triangles.insert(triangles.end(), polygon.begin(), polygon.end());
    }

    /// The triangles of a polygon. The projected sides of a bent leaf may cross.
    Triangles cut(std::span<const Vec3> corners) {
        try {
            return make_polygon(corners);
        } catch (const InputError& error) {
            const std::optional<Triangles> fan = make_fan(corners);
            report_polygon(
                "polygon",
                fmt::format(
                    "that is {}: {}", fan ? "divided into a fan from its first corner" : "left out",
                    error.what()));
            return fan.value_or(Triangles{});
        }
    }

    const Specification& spec_;
    Notices& notices_;
    const Pass& pass_;
    const Query& query_;
    std::span<const double> parameters_;
    OrganFrame frame_;
    std::uint32_t line_ = 0;  // of a polygon in its message; 0: there is none
};

OrganShape OrganShapes::make(const Pass& pass, const Query& query) {
    return Maker(spec_, notices_, pass, query).make();
}

OrganShape OrganShapes::make_sensor(const Pass& pass, const Query& query) {
    return Maker(spec_, notices_, pass, query).make_sensor();
}

}  // namespace quasimc
