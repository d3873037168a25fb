#include "meshio/xml_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

constexpr unsigned int kParts = pugi::parse_default | pugi::parse_declaration;

/// Whether a text that is not UTF-8 declares Latin-1, and has no byte that differs in Windows-1252.
bool is_latin1(const pugi::xml_document& document, std::string_view bytes) {
    constexpr std::array<std::string_view, 5> kNames{
        "iso-8859-1", "iso_8859-1", "latin1", "latin-1", "windows-1252"};
    const std::string name = lower_case(document.first_child().attribute("encoding").value());
    return document.first_child().type() == pugi::node_declaration &&
           std::find(kNames.begin(), kNames.end(), name) != kNames.end() && !is_utf8(bytes) &&
           std::none_of(
               bytes.begin(), bytes.end(), [](unsigned char c) { return c >= 0x80 && c < 0xA0; });
}

}  // namespace

MeshPart XmlMesh::part(
    const std::vector<Vec3>& placed,
    std::string material,
    std::uint32_t line,
    MeshFile& file,
    CrossedFaces& crossed) const {
    const auto first = static_cast<std::uint32_t>(file.vertices.size());
    file.vertices.insert(file.vertices.end(), placed.begin(), placed.end());
    MeshPart part{std::move(material), {}, {}};
    for (const std::vector<std::uint32_t>& face : faces) {
        std::vector<Vec3> corners;
        std::vector<std::uint32_t> vertices;
        for (const std::uint32_t point : face) {
            corners.push_back(placed[point]);
            vertices.push_back(first + point);
        }
        if (part.add_face(corners, vertices, line)) {
            crossed.add("of line", line);
        }
    }
    return part;
}

XmlFile::XmlFile(std::string_view bytes, Reporter& reporter) : reporter_(reporter) {
    // The parser stops at a zero byte.
    const std::size_t zero = bytes.find('\0');
    pugi::xml_parse_result parsed =
        document_.load_buffer(bytes.data(), bytes.size(), kParts, pugi::encoding_utf8);
    const bool is_recoded = is_latin1(document_, bytes);
    std::ptrdiff_t at = 0;
    for (const char c : bytes) {
        if (c == '\n') {
            line_ends_.push_back(at);
        }
        at += is_recoded && static_cast<unsigned char>(c) >= 0x80 ? 2 : 1;
    }
    if (is_recoded) {
        parsed = document_.load_buffer(bytes.data(), bytes.size(), kParts, pugi::encoding_latin1);
    }
    if (zero != std::string_view::npos) {
        reporter_.fault(
            line_at(static_cast<std::ptrdiff_t>(zero)), "a byte is 0", "it is not XML",
            "save the file as UTF-8");
    } else if (!parsed) {
        reporter_.fault(line_at(parsed.offset), parsed.description(), "it is not XML");
    } else if (const pugi::xml_node second = root().next_sibling()) {
        fault(second, "a second root element", "it is not XML");
    }
    if (!reporter_.faults.empty()) {
        document_.reset();
    }
}

std::uint32_t XmlFile::line_at(std::ptrdiff_t offset) const {
    const auto found = std::lower_bound(line_ends_.begin(), line_ends_.end(), offset);
    return static_cast<std::uint32_t>(found - line_ends_.begin()) + 1;
}

std::uint32_t XmlFile::line(pugi::xml_node element) const {
    return line_at(element.offset_debug());
}

void XmlFile::fault(
    pugi::xml_node element, std::string problem, std::string why, std::string suggestion) const {
    reporter_.fault(line(element), std::move(problem), std::move(why), std::move(suggestion));
}

std::optional<std::vector<double>> XmlFile::numbers(pugi::xml_node element) const {
    constexpr Separators kSeparators = " \t\r\n\v\f";
    const std::string text = xml_text(element);
    std::vector<double> all;
    std::string_view rest = text;
    for (auto word = take_word(rest, kSeparators); !word.empty();
         word = take_word(rest, kSeparators)) {
        const std::optional<double> number = parse_real(word);
        if (!number || !std::isfinite(*number)) {
            fault(element, shown(word) + " is not a finite number");
            return std::nullopt;
        }
        all.push_back(*number);
    }
    return all;
}

XmlMesh XmlFile::mesh(pugi::xml_node element) const {
    XmlMesh mesh;
    const pugi::xml_node points = element.child("points");
    const auto coordinates = numbers(points);
    if (!coordinates) {
        return mesh;
    }
    if (coordinates->size() % 3 != 0) {
        fault(
            points, fmt::format("<points> has {} numbers", coordinates->size()),
            "a point is x y z");
        return mesh;
    }
    for (std::size_t i = 0; i < coordinates->size(); i += 3) {
        mesh.points.push_back({(*coordinates)[i], (*coordinates)[i + 1], (*coordinates)[i + 2]});
    }
    for (const pugi::xml_node child : element.child("faces").children("face")) {
        if (auto corners = face(child, mesh.points.size()); corners && !reporter_.is_full()) {
            mesh.faces.push_back(std::move(*corners));
        }
    }
    return mesh;
}

std::optional<std::vector<std::uint32_t>> XmlFile::face(
    pugi::xml_node element, std::size_t points) const {
    std::vector<std::uint32_t> corners;
    const auto values = numbers(element);
    if (!values) {
        return std::nullopt;
    }
    for (const double number : *values) {
        if (!(number >= 0 && number < static_cast<double>(points)) ||
            number != std::floor(number)) {
            fault(
                element, fmt::format("a face refers to point {}", number),
                fmt::format("its mesh has {}, counted from 0", points));
            return std::nullopt;
        }
        corners.push_back(static_cast<std::uint32_t>(number));
    }
    if (corners.size() < 3 || corners.size() > kMaxCorners) {
        fault(element, fmt::format("a face with {} corners", corners.size()));
        return std::nullopt;
    }
    return corners;
}

std::string xml_text(pugi::xml_node element) {
    std::string text;
    for (const pugi::xml_node piece : element.children()) {
        text += piece.value();  // "" for an element
    }
    return std::string(trimmed(text));
}

}  // namespace quasimc
