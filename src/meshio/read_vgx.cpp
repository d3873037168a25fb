#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "geometry/shapes/shapes.h"
#include "meshio/file_axes.h"
#include "meshio/formats.h"
#include "meshio/placed_triangles.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

constexpr Separators kVgxSeparators = " \t\r\v\f;,";

/// The columns of geometry; the others, and Obj, are labels.
constexpr std::array<std::string_view, 22> kVgxColumns{
    "Obj", "EchX", "EchY", "EchZ", "TransX", "TransY", "TransZ", "RotX", "RotY", "RotZ", "X1",
    "Y1",  "Z1",   "X2",   "Y2",   "Z2",     "X3",     "Y3",     "Z3",   "R",    "G",    "B"};
constexpr std::size_t kObj = 0, kScale = 1, kShift = 4, kTurn = 7, kCorners = 10, kColor = 19;

/// The kinds of objects that are read. Round ones lie along x from their base.
enum class VgxShape { triangle = 0, leaf = 11, disk = 21, sphere = 31, cylinder = 32, cone = 33 };

/// Rotation by an angle in degrees about a unit axis, counter-clockwise seen from the tip of the
/// axis (Rodrigues).
Affine rotation_about(const Vec3& k, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const double c = std::cos(angle), s = std::sin(angle);
    const Vec3 kc = (1 - c) * k;
    return {
        {Vec3{c + kc.x * k.x, kc.x * k.y - s * k.z, kc.x * k.z + s * k.y},
         Vec3{kc.y * k.x + s * k.z, c + kc.y * k.y, kc.y * k.z - s * k.x},
         Vec3{kc.z * k.x - s * k.y, kc.z * k.y + s * k.x, c + kc.z * k.z}},
        {}};
}

/// Rotation about x by `roll`, then about y by `elevation`, then about z by `azimuth`, degrees.
Affine euler_rotation(double azimuth, double elevation, double roll) {
    return after(
        after(rotation_about({0, 0, 1}, azimuth), rotation_about({0, 1, 0}, elevation)),
        rotation_about({1, 0, 0}, roll));
}

/// Content of a row.
struct VgxRow {
    std::array<double, kVgxColumns.size()> numbers{};
    Labels labels;

    [[nodiscard]] Vec3 vector(std::size_t first) const {
        return {numbers[first], numbers[first + 1], numbers[first + 2]};
    }
};

/// A shape of length, width and height 1, its base at the origin.
Mesh unit_shape(VgxShape shape) {
    constexpr int kSides = 12, kLevels = 2;
    constexpr double kThird = 1.0 / 3;
    if (shape == VgxShape::leaf) {
        const std::array<Vec3, 6> outline{
            Vec3{0, 0, 0}, Vec3{kThird, -0.5, 0},    Vec3{2 * kThird, -0.5, 0},
            Vec3{1, 0, 0}, Vec3{2 * kThird, 0.5, 0}, Vec3{kThird, 0.5, 0}};
        return make_polygon(outline);
    }
    if (shape == VgxShape::disk) {
        return make_disk({0.5, 0, 0}, {0, 0, 1}, 0.5, kSides);
    }
    if (shape == VgxShape::sphere) {
        return make_sphere({0, 0, 0}, 0.5, kLevels);
    }
    return make_cylinder({0, 0, 0}, {1, 0, 0}, 0.5, 0.5, kSides, false);
}

/// Reads the rows, one after the other.
class VgxReader {
  public:
    explicit VgxReader(Reporter& reporter) : reporter_(reporter), placed_(file_, reporter) {}

    MeshFile read(std::string_view bytes) {
        LineScanner scanner(bytes);
        if (!scanner.next() || !read_head(scanner.line())) {
            return std::move(file_);
        }
        while (scanner.next() && !reporter_.is_full()) {
            line_ = scanner.number();
            if (const auto row = read_row(scanner.line())) {
                add(*row);
            }
        }
        warn_of(
            leaves_,
            "leaves (Obj 11, 12, 13), whose outline is not in the file; hexagons as in PlantGL are "
            "used, with 2/3 of length x width");
        warn_of(
            colors_,
            "colours (R, G, B) are not from 0 to 255; their mean / 255 is used, limited to 0 ... "
            "1");
        warn_of(points_, "points (Obj 40), which have no area and are left out");
        return std::move(file_);
    }

  private:
    bool read_head(std::string_view line) {
        std::set<std::size_t> found;
        std::set<std::string_view> names;
        for (auto word = take_word(line, kVgxSeparators); !word.empty();
             word = take_word(line, kVgxSeparators)) {
            const auto* known = std::find(kVgxColumns.begin(), kVgxColumns.end(), word);
            const auto column = static_cast<std::size_t>(known - kVgxColumns.begin());
            found.insert(column);
            if (!names.insert(word).second) {
                reporter_.fault(1, fmt::format("column {} is given twice", shown(word)), "");
                return false;
            }
            columns_.emplace_back(column, one_line(std::string(word)));
        }
        has_color_ =
            found.contains(kColor) && found.contains(kColor + 1) && found.contains(kColor + 2);
        has_triangles_ = is_complete(found, kCorners, kColor);
        has_shapes_ = is_complete(found, kScale, kCorners);
        if (!found.contains(kObj) || !(has_triangles_ || has_shapes_)) {
            reporter_.fault(
                1, "the first line does not contain the columns of a .vgx file",
                "Obj, and EchX EchY EchZ TransX TransY TransZ RotX RotY RotZ or X1 ... Z3");
            return false;
        }
        return true;
    }

    static bool is_complete(
        const std::set<std::size_t>& found, std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            if (!found.contains(i)) {
                return false;
            }
        }
        return true;
    }

    /// Reads a row; empty for an empty line and after a fault.
    std::optional<VgxRow> read_row(std::string_view line) {
        VgxRow row;
        std::size_t count = 0;
        for (auto word = take_word(line, kVgxSeparators); !word.empty();
             word = take_word(line, kVgxSeparators), ++count) {
            if (count >= columns_.size()) {
                continue;
            }
            const auto& [column, name] = columns_[count];
            const auto number = parse_real(word);
            if (!number || !std::isfinite(*number)) {
                reporter_.fault(
                    line_, fmt::format("{} is {}", name, shown(word)),
                    "it must be a finite number");
                return std::nullopt;
            }
            if (column < kVgxColumns.size()) {
                row.numbers[column] = *number;
            }
            if (column == kObj || column == kVgxColumns.size()) {
                row.labels.emplace_back(name, std::string(word));
            }
        }
        if (count != 0 && count != columns_.size()) {
            reporter_.fault(
                line_, fmt::format("{} numbers", count),
                fmt::format("the first line has {} columns", columns_.size()));
        }
        return count == columns_.size() ? std::optional(std::move(row)) : std::nullopt;
    }

    void add(const VgxRow& row) {
        constexpr double kPoint = 40;
        const double kind = row.numbers[kObj];
        if (kind == kPoint) {
            note(points_);
            return;
        }
        const auto shape = shape_of(kind);
        const bool is_triangle = shape == VgxShape::triangle;
        if (!shape || !(is_triangle ? has_triangles_ : has_shapes_)) {
            reporter_.fault(
                line_, fmt::format("Obj {} is not read", kind),
                shape ? "the columns of its position are missing"
                      : "only 0, 11 to 13, 21, 31, 32 and 33 are",
                shape ? "" : "let PlantGL make triangles of it: Scene('in.vgx').save('out.obj')");
            return;
        }
        is_triangle ? add_triangle(row) : add_shape(row, *shape);
    }

    static std::optional<VgxShape> shape_of(double kind) {
        constexpr double kLeaf = 11, kLastLeaf = 13;
        const double first = kind == kLeaf + 1 || kind == kLastLeaf ? kLeaf : kind;
        for (const VgxShape shape :
             {VgxShape::triangle, VgxShape::leaf, VgxShape::disk, VgxShape::sphere,
              VgxShape::cylinder, VgxShape::cone}) {
            if (first == static_cast<double>(shape)) {
                return shape;
            }
        }
        return std::nullopt;
    }

    /// Adds a triangle; consecutive ones with equal colour and labels form one organ.
    void add_triangle(const VgxRow& row) {
        const std::string material = material_of(row);
        const bool goes_on = !file_.groups.empty() && in_triangles_ &&
                             file_.groups.back().labels == row.labels &&
                             file_.groups.back().parts.front().material == material;
        if (!goes_on) {
            file_.groups.push_back({"", {}, {MeshPart{material, {}, {}}}, row.labels});
        }
        in_triangles_ = true;
        MeshPart& part = file_.groups.back().parts.front();
        const auto first = static_cast<std::uint32_t>(file_.vertices.size());
        for (std::size_t corner = 0; corner < 3; ++corner) {
            file_.vertices.push_back(row.vector(kCorners + 3 * corner));
        }
        part.faces.push_back({first, first + 1, first + 2});
        part.lines.push_back(line_);
    }

    void add_shape(const VgxRow& row, VgxShape shape) {
        in_triangles_ = false;
        const Vec3 scale = row.vector(kScale);
        const bool is_flat = shape == VgxShape::leaf || shape == VgxShape::disk;
        const bool may_be_thin = is_flat || shape == VgxShape::cone;
        if (!(scale.x > 0 && scale.y > 0 && (may_be_thin ? scale.z >= 0 : scale.z > 0))) {
            reporter_.fault(
                line_, fmt::format("EchX {}, EchY {}, EchZ {}", scale.x, scale.y, scale.z),
                "lengths must be positive");
            return;
        }
        if (shape == VgxShape::leaf) {
            note(leaves_);
        }
        const bool is_cone = shape == VgxShape::cone;
        const Vec3 size = is_cone ? Vec3{1, 1, 1} : Vec3{scale.x, scale.y, is_flat ? 1 : scale.z};
        const Affine sized{{Vec3{size.x, 0, 0}, Vec3{0, size.y, 0}, Vec3{0, 0, size.z}}, {}};
        const Vec3 turn = row.vector(kTurn);
        Affine placed = after(euler_rotation(turn.z, turn.y, turn.x), sized);
        placed.shift = row.vector(kShift);
        MeshGroup group{"", {}, {}, row.labels};
        placed_.add(
            is_cone ? cone(scale) : triangles_of(shape), placed, material_of(row), line_, group);
        if (!group.parts.empty()) {
            file_.groups.push_back(std::move(group));
        }
    }

    /// A truncated cone with widths EchY and EchZ.
    static Mesh cone(const Vec3& scale) {
        constexpr int kSides = 12;
        return make_cylinder({0, 0, 0}, {scale.x, 0, 0}, scale.y / 2, scale.z / 2, kSides, false);
    }

    const Mesh& triangles_of(VgxShape shape) {
        const auto [found, is_new] = shapes_.try_emplace(shape);
        if (is_new) {
            found->second = unit_shape(shape);
        }
        return found->second;
    }

    /// The material of a colour; "" without columns of colours.
    std::string material_of(const VgxRow& row) {
        if (!has_color_) {
            return "";
        }
        constexpr double kFull = 255;
        const Vec3 color = row.vector(kColor);
        const std::array<double, 3> key{color.x, color.y, color.z};
        std::string& name = materials_[key];
        if (name.empty()) {
            name = fmt::format("color {} {} {}", color.x, color.y, color.z);
            const double mean = (color.x + color.y + color.z) / 3 / kFull;
            file_.materials.push_back({name, std::min(1.0, std::max(0.0, mean))});
            const auto [low, high] = std::minmax({color.x, color.y, color.z});
            if (low < 0 || high > kFull) {
                note(colors_);
            }
        }
        return name;
    }

    /// Number of lines of a kind, and the first one.
    struct Notes {
        std::size_t count = 0;
        std::uint32_t first = 0;
    };

    void note(Notes& notes) const { notes.first = notes.count++ == 0 ? line_ : notes.first; }

    void warn_of(const Notes& notes, std::string_view what) {
        if (notes.count > 0) {
            reporter_.warn(fmt::format("{} {}", notes.count, what), notes.first);
        }
    }

    Reporter& reporter_;
    MeshFile file_{{}, {}, "line", {}};
    PlacedTriangles placed_;
    // Index in the table (or its end), and name.
    std::vector<std::pair<std::size_t, std::string>> columns_;
    std::map<VgxShape, Mesh> shapes_;
    std::map<std::array<double, 3>, std::string> materials_;
    Notes leaves_, points_, colors_;
    std::uint32_t line_ = 0;
    bool has_color_ = false, has_triangles_ = false, has_shapes_ = false, in_triangles_ = false;
};

}  // namespace

MeshFile read_vgx(std::string_view bytes, FormatContext& context) {
    return VgxReader(context.reporter).read(bytes);
}

}  // namespace quasimc
