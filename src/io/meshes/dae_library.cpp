#include "io/meshes/dae_library.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/numbers.h"
#include "io/xml_scanner.h"

namespace quasimc {

DaeLibrary::DaeLibrary(const XmlTree& tree, Reporter& reporter) : tree_(tree), reporter_(reporter) {
    for (std::size_t i = 0; i < tree.size(); ++i) {
        if (const std::string_view id = tree[i].attribute("id"); !id.empty()) {
            if (!ids_.emplace(id, i).second && ++repeated_ids_ == 1) {
                first_repeated_ = fmt::format("{} in line {}", shown(id), tree[i].line);
            }
        }
        const std::string_view name = tree[i].name;
        const bool is_image =
            name == "ref" || (name == "init_from" && tree[tree[i].parent].name == "image");
        has_alpha_ = has_alpha_ || (is_image && may_have_alpha(trimmed(tree[i].text)));
    }
}

void DaeLibrary::fault(
    std::size_t element, std::string problem, std::string why, std::string what) {
    reporter_.fault(tree_[element].line, std::move(problem), std::move(why), std::move(what));
}

std::optional<std::size_t> DaeLibrary::target(
    std::size_t of, std::string_view reference, std::string_view name) {
    if (!reference.starts_with('#')) {
        fault(
            of, fmt::format("<{}> names {}", tree_[of].name, shown(reference)),
            "only what is in the same file is read, by #id", "export everything into one file");
        return std::nullopt;
    }
    const auto found = ids_.find(reference.substr(1));
    if (found == ids_.end() || tree_[found->second].name != name) {
        fault(
            of, fmt::format("<{}> names {}", tree_[of].name, shown(reference)),
            fmt::format("there is no <{}> with that id", name));
        return std::nullopt;
    }
    return found->second;
}

std::string DaeLibrary::name_of(std::size_t element) const {
    const std::string_view name = tree_[element].attribute("name");
    return one_line(xml_text(name.empty() ? tree_[element].attribute("id") : name));
}

DaeLibrary::Appearance DaeLibrary::appearance_of(std::size_t material) {
    const auto instance = tree_.child(material, "instance_effect");
    const auto effect =
        instance ? target(*instance, tree_[*instance].attribute("url"), "effect") : std::nullopt;
    const auto diffuse = effect ? tree_.find_in(*effect, "diffuse") : std::nullopt;
    const auto color = diffuse ? tree_.child(*diffuse, "color") : std::nullopt;
    const auto transparent = effect ? tree_.find_in(*effect, "transparent") : std::nullopt;
    Appearance appearance;
    const bool has_texture = (diffuse && tree_.child(*diffuse, "texture")) ||
                             (transparent && tree_.child(*transparent, "texture"));
    appearance.has_mask = has_texture && has_alpha_;
    const auto rgb = color ? numbers(*color) : std::nullopt;
    if (rgb && rgb->size() >= 3) {
        appearance.reflectance = ((*rgb)[0] + (*rgb)[1] + (*rgb)[2]) / 3;
    }
    return appearance;
}

std::optional<std::vector<double>> DaeLibrary::numbers(
    std::size_t element, std::optional<std::size_t> count) {
    std::vector<double> values;
    std::string_view text = tree_[element].text;
    for (std::string_view word = take_word(text, kDaeBlanks); !word.empty();
         word = take_word(text, kDaeBlanks)) {
        const std::optional<double> value = parse_real(word);
        if (!value || !std::isfinite(*value)) {
            fault(
                element,
                fmt::format("<{}>: {} is not a finite number", tree_[element].name, shown(word)));
            return std::nullopt;
        }
        values.push_back(*value);
    }
    if (count && values.size() != *count) {
        fault(
            element, fmt::format("<{}> holds {} numbers", tree_[element].name, values.size()),
            fmt::format("it takes {}", *count));
        return std::nullopt;
    }
    return values;
}

const DaeGeometry& DaeLibrary::geometry(std::size_t element) {
    const auto [found, is_new] = geometries_.try_emplace(element);
    if (is_new) {
        found->second.name = name_of(element);
        if (const auto mesh = tree_.child(element, "mesh")) {
            read_mesh(*mesh, found->second);
        } else {
            fault(
                element, fmt::format("the geometry '{}' is no <mesh>", found->second.name),
                "splines and convex hulls of other geometries are not read",
                "export it as triangles");
        }
    }
    return found->second;
}

void DaeLibrary::read_mesh(std::size_t mesh, DaeGeometry& geometry) {
    constexpr std::array<std::string_view, 5> kFaces{
        "triangles", "polylist", "polygons", "trifans", "tristrips"};
    constexpr std::array<std::string_view, 10> kKnown{
        "triangles", "polylist",   "polygons", "trifans",  "tristrips",
        "lines",     "linestrips", "source",   "vertices", "extra"};
    check_children(mesh, kKnown);
    for (const std::size_t child : tree_[mesh].children) {
        const std::string_view name = tree_[child].name;
        if (std::find(kFaces.begin(), kFaces.end(), name) != kFaces.end()) {
            read_primitive(child, geometry);
        } else if (name == "lines" || name == "linestrips") {
            ++left_out_;
        }
    }
}

void DaeLibrary::read_primitive(std::size_t primitive, DaeGeometry& geometry) {
    const std::optional<Corners> corners = read_inputs(primitive);
    auto points = corners ? read_points(*corners->positions) : std::nullopt;
    if (!points) {
        return;
    }
    DaePart part{tree_[primitive].attribute("material"), {std::move(*points), {}}};
    std::size_t all = 0;
    for (const std::size_t list : tree_.children(primitive, "p")) {
        if (const auto numbers = read_corners(list, *corners, part.triangles.points.size())) {
            add_faces(primitive, list, *numbers, part);
            all += numbers->size();
        }
    }
    check_faces(primitive, all);
    if (tree_.child(primitive, "ph")) {
        fault(
            primitive, "<polygons> has faces with holes", "these are not read",
            "export it as triangles");
    }
    geometry.parts.push_back(std::move(part));
}

std::optional<DaeLibrary::Corners> DaeLibrary::read_inputs(std::size_t primitive) {
    constexpr std::int64_t kMostInputs = 64;
    Corners corners;
    for (const std::size_t input : tree_.children(primitive, "input")) {
        const auto offset = parse_integer(tree_[input].attribute("offset"));
        if (!offset || *offset < 0 || *offset >= kMostInputs) {
            fault(input, "<input> without an offset", "it is a number from 0 to 63");
            return std::nullopt;
        }
        const auto place = static_cast<std::size_t>(*offset);
        corners.stride = std::max(corners.stride, place + 1);
        if (tree_[input].attribute("semantic") == "VERTEX") {
            corners.offset = place;
            const auto vertices = target(input, tree_[input].attribute("source"), "vertices");
            corners.positions = vertices ? positions_of(*vertices) : std::nullopt;
            if (!corners.positions) {
                return std::nullopt;
            }
        }
    }
    if (!corners.positions) {
        fault(primitive, fmt::format("<{}> has no <input> of VERTEX", tree_[primitive].name));
        return std::nullopt;
    }
    return corners;
}

std::optional<std::size_t> DaeLibrary::positions_of(std::size_t vertices) {
    for (const std::size_t input : tree_.children(vertices, "input")) {
        if (tree_[input].attribute("semantic") == "POSITION") {
            return target(input, tree_[input].attribute("source"), "source");
        }
    }
    fault(vertices, "<vertices> has no <input> of POSITION");
    return std::nullopt;
}

std::optional<std::vector<Vec3>> DaeLibrary::read_points(std::size_t source) {
    constexpr std::size_t kAxes = 3;
    const auto array = tree_.child(source, "float_array");
    const auto accessor = tree_.find_in(source, "accessor");
    const auto stride =
        accessor ? parse_integer(tree_[*accessor].attribute("stride")).value_or(1) : kAxes;
    const std::string_view offset = accessor ? tree_[*accessor].attribute("offset") : "";
    const auto first = offset.empty() ? 0 : parse_integer(offset).value_or(-1);
    if (!array || stride < static_cast<std::int64_t>(kAxes) || first < 0) {
        fault(
            source, "<source> is no list of points",
            "it needs a <float_array> and an <accessor> with a stride of at least 3");
        return std::nullopt;
    }
    const auto values = numbers(*array);
    if (!values) {
        return std::nullopt;
    }
    check_count(*array, values->size());
    std::vector<Vec3> points;
    const auto step = static_cast<std::size_t>(stride);
    for (auto at = static_cast<std::size_t>(first);
         at < values->size() && values->size() - at >= kAxes;
         at += std::min(step, values->size() - at)) {
        points.push_back({(*values)[at], (*values)[at + 1], (*values)[at + 2]});
    }
    if (accessor) {
        // It may cover a part of an array that several share.
        constexpr bool kIsPart = true;
        check_count(*accessor, points.size(), kIsPart);
    }
    return points;
}

std::optional<std::vector<std::uint32_t>> DaeLibrary::read_corners(
    std::size_t list, const Corners& corners, std::size_t points) {
    std::vector<std::uint32_t> numbers;
    std::size_t count = 0;
    std::string_view text = tree_[list].text;
    for (std::string_view word = take_word(text, kDaeBlanks); !word.empty();
         word = take_word(text, kDaeBlanks), ++count) {
        if (count % corners.stride != corners.offset) {
            continue;
        }
        const std::optional<std::int64_t> number = parse_integer(word);
        if (!number || *number < 0 || static_cast<std::uint64_t>(*number) >= points) {
            fault(
                list, fmt::format("a face names point {}", shown(word)),
                fmt::format("there are {}, counted from 0", points));
            return std::nullopt;
        }
        numbers.push_back(static_cast<std::uint32_t>(*number));
    }
    if (count % corners.stride != 0) {
        fault(
            list, fmt::format("<p> holds {} numbers", count),
            fmt::format("each corner takes {}", corners.stride));
        return std::nullopt;
    }
    return numbers;
}

void DaeLibrary::add_faces(
    std::size_t primitive,
    std::size_t list,
    const std::vector<std::uint32_t>& corners,
    DaePart& part) {
    const std::string_view kind = tree_[primitive].name;
    if (kind == "polygons") {
        add_face(list, corners, part.triangles);
    } else if (kind == "polylist") {
        const auto counts = tree_.child(primitive, "vcount");
        const auto sizes = counts ? numbers(*counts) : std::nullopt;
        std::size_t at = 0;
        for (const double size : sizes.value_or(std::vector<double>())) {
            const std::size_t left = corners.size() - at;
            if (!(size >= 0) || size > static_cast<double>(left) || size != std::floor(size)) {
                fault(*counts, fmt::format("<vcount> has {}", size), "<p> has too few corners");
                return;
            }
            add_face(
                list, std::span(corners).subspan(at, static_cast<std::size_t>(size)),
                part.triangles);
            at += static_cast<std::size_t>(size);
        }
        if (at != corners.size()) {
            fault(list, "<p> has more corners than <vcount> tells");
        }
    } else if (kind == "triangles" && corners.size() % 3 != 0) {
        fault(list, fmt::format("<p> has {} corners", corners.size()), "triangles have three each");
    } else {
        const CornerOrder order = kind == "trifans"     ? CornerOrder::fan
                                  : kind == "tristrips" ? CornerOrder::strip
                                                        : CornerOrder::triangles;
        const std::vector<Face> faces = faces_of(order, corners);
        part.triangles.faces.insert(part.triangles.faces.end(), faces.begin(), faces.end());
    }
}

void DaeLibrary::add_face(
    std::size_t list, std::span<const std::uint32_t> corners, LocalTriangles& triangles) {
    if (corners.size() < 3 || corners.size() > kMostCorners) {
        fault(
            list, fmt::format("a face of {} corners", corners.size()),
            fmt::format("it has 3 to {}", kMostCorners));
        return;
    }
    std::vector<Vec3> points;
    for (const std::uint32_t corner : corners) {
        points.push_back(triangles.points[corner]);
    }
    if (add_polygon(points, corners, triangles)) {
        crossed_.add("of line", tree_[list].line);
    }
}

}  // namespace quasimc
