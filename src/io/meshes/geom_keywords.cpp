#include "io/meshes/geom_keywords.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "io/line_scanner.h"

namespace quasimc {
namespace {

bool is_name_start(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ':';
}

bool is_name_part(char c) {
    return is_name_start(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Also what is no number but an expression, to be refused as a whole.
bool is_of_number(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '+' || c == '-' ||
           c == '*' || c == '/' || c == '_';
}

std::size_t length_while(std::string_view text, bool (*is_part)(char)) {
    return static_cast<std::size_t>(
        std::find_if_not(text.begin(), text.end(), is_part) - text.begin());
}

}  // namespace

GeomWords::GeomWords(std::string_view text) : rest_(without_bom(text)) {}

void GeomWords::pass_blanks() {
    constexpr std::string_view kGeomBlanks = " \t\r\n\v\f";
    while (!rest_.empty()) {
        std::size_t count = std::min(rest_.find_first_not_of(kGeomBlanks), rest_.size());
        if (rest_.starts_with("(#")) {
            const std::size_t end = rest_.find("#)", 2);
            count = end == std::string_view::npos ? rest_.size() : end + 2;
        } else if (rest_.starts_with('#')) {
            count = std::min(rest_.find('\n'), rest_.size());
        }
        if (count == 0) {
            return;
        }
        const std::string_view passed = rest_.substr(0, count);
        line_ += static_cast<std::uint32_t>(std::count(passed.begin(), passed.end(), '\n'));
        rest_.remove_prefix(count);
    }
}

void GeomWords::take(std::size_t count, Kind kind) {
    word_ = rest_.substr(0, count);
    rest_.remove_prefix(count);
    kind_ = kind;
}

void GeomWords::next() {
    pass_blanks();
    if (rest_.empty()) {
        word_ = {};
        kind_ = Kind::end;
    } else if (const char first = rest_.front(); is_name_start(first)) {
        take(length_while(rest_, is_name_part), first == ':' ? Kind::mark : Kind::name);
    } else if (first == '"') {
        const std::size_t end = std::min(rest_.find_first_of("\"\n", 1), rest_.size() - 1);
        take(end + 1, Kind::text);
        word_ = word_.substr(1, word_.size() >= 2 ? word_.size() - 2 : 0);
    } else if (is_of_number(first)) {
        take(length_while(rest_, is_of_number), Kind::number);
    } else {
        take(1, Kind::mark);
    }
}

bool is_geom_type(std::string_view word) {
    static constexpr std::array<std::string_view, 49> kTypes{
        "AmapSymbol",
        "AsymmetricHull",
        "AxisRotated",
        "BezierCurve",
        "BezierCurve2D",
        "BezierPatch",
        "Box",
        "Cone",
        "Cylinder",
        "Disc",
        "ElevationGrid",
        "EulerRotated",
        "ExtrudedHull",
        "Extrusion",
        "FaceSet",
        "Font",
        "Frustum",
        "Group",
        "IFS",
        "ImageTexture",
        "Inline",
        "Material",
        "MonoSpectral",
        "MultiSpectral",
        "NurbsCurve",
        "NurbsCurve2D",
        "NurbsPatch",
        "Oriented",
        "Paraboloid",
        "PointSet",
        "PointSet2D",
        "Polyline",
        "Polyline2D",
        "QuadSet",
        "Revolution",
        "Scaled",
        "ScreenProjected",
        "Shape",
        "Sphere",
        "Swung",
        "Tapered",
        "Text",
        "Texture2D",
        "Transfo",
        "Translated",
        "TriangleSet",
        "BaseOrientation",
        "AxisRotation",
        "EulerRotation"};
    return std::find(kTypes.begin(), kTypes.end(), word) != kTypes.end();
}

std::span<const std::string_view> geom_fields(std::string_view type) {
    using Words = std::span<const std::string_view>;
    static constexpr std::array<std::string_view, 4> kShape{
        "Geometry", "Appearance", "Id", "ParentId"};
    static constexpr std::array<std::string_view, 6> kMaterial{
        "Ambient", "Diffuse", "Specular", "Emission", "Shininess", "Transparency"};
    static constexpr std::array<std::string_view, 13> kFaces{
        "PointList", "IndexList",      "NormalList",     "NormalIndexList", "NormalPerVertex",
        "ColorList", "ColorIndexList", "ColorPerVertex", "TexCoordList",    "TexCoordIndexList",
        "CCW",       "Solid",          "Skeleton"};
    static constexpr std::array<std::string_view, 2> kTranslated{"Translation", "Geometry"};
    static constexpr std::array<std::string_view, 2> kScaled{"Scale", "Geometry"};
    static constexpr std::array<std::string_view, 3> kAxisRotated{"Axis", "Angle", "Geometry"};
    static constexpr std::array<std::string_view, 4> kEulerRotated{
        "Azimuth", "Elevation", "Roll", "Geometry"};
    static constexpr std::array<std::string_view, 3> kOriented{"Primary", "Secondary", "Geometry"};
    static constexpr std::array<std::string_view, 2> kGroup{"GeometryList", "Skeleton"};
    static constexpr std::array<std::pair<std::string_view, Words>, 11> kAll{
        {{"Shape", kShape},
         {"Material", kMaterial},
         {"TriangleSet", kFaces},
         {"QuadSet", kFaces},
         {"FaceSet", kFaces},
         {"Translated", kTranslated},
         {"Scaled", kScaled},
         {"AxisRotated", kAxisRotated},
         {"EulerRotated", kEulerRotated},
         {"Oriented", kOriented},
         {"Group", kGroup}}};
    const auto* const found = std::find_if(
        kAll.begin(), kAll.end(), [type](const auto& row) { return row.first == type; });
    return found == kAll.end() ? Words() : found->second;
}

}  // namespace quasimc
