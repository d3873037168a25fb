#include "meshio/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "meshio/formats.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

constexpr std::array<std::pair<std::string_view, PlyEncoding>, 3> kEncodings{{
    {"ascii", PlyEncoding::ascii},
    {"binary_little_endian", PlyEncoding::little_endian},
    {"binary_big_endian", PlyEncoding::big_endian},
}};

template <typename Table>
auto look_up(const Table& table, std::string_view name) {
    const auto found = std::find_if(
        table.begin(), table.end(), [name](const auto& row) { return row.first == name; });
    return found == table.end() ? std::nullopt : std::optional(found->second);
}

PlyRole role_of(const std::string& element, const PlyProperty& property) {
    const std::string& name = property.name;
    if (element == "vertex" && !property.is_list) {
        return name == "x"   ? PlyRole::x
               : name == "y" ? PlyRole::y
               : name == "z" ? PlyRole::z
                             : PlyRole::none;
    }
    if (property.is_list) {
        const bool is_corners = name == "vertex_indices" || name == "vertex_index";
        return is_corners ? PlyRole::corners : PlyRole::none;
    }
    if (element == "face") {
        return name == "organ"      ? PlyRole::organ
               : name == "material" ? PlyRole::material
                                    : PlyRole::none;
    }
    return PlyRole::none;
}

/// Reads the lines of a header; one faulty line makes the header invalid.
class HeaderReader {
  public:
    /// Reads a line; returns its fault, or "".
    std::string read(std::string_view line) {
        const std::string_view word = take_word(line);
        if (word == "format") {
            return read_format(line);
        }
        if (word == "element") {
            return read_element(line);
        }
        if (word == "property") {
            return read_property(line);
        }
        if (word == "comment") {
            read_comment(line);
            return "";
        }
        const bool is_harmless = word.empty() || word == "obj_info";
        return is_harmless ? "" : shown(word) + " is not a line of a PLY header";
    }

    /// Returns a fault of the complete header, or "".
    [[nodiscard]] std::string check() const {
        constexpr std::array kNeeded{
            std::pair{"vertex", PlyRole::x}, std::pair{"vertex", PlyRole::y},
            std::pair{"vertex", PlyRole::z}, std::pair{"face", PlyRole::corners}};
        for (const auto& [element, role] : kNeeded) {
            if (!has(element, role)) {
                return fmt::format(
                    "its header has no {} with {}", element,
                    role == PlyRole::corners ? "vertex_indices" : "x, y and z");
            }
        }
        for (const PlyElement& element : header.elements) {
            if (element.name == "vertex") {
                break;
            }
            if (element.name == "face") {
                return "faces come before vertices";
            }
        }
        return has_format ? "" : "its header has no format";
    }

    PlyHeader header;
    bool has_format = false;

  private:
    void read_comment(std::string_view line) {
        const std::string_view word = take_word(line);
        if (word == "TextureFile") {
            header.has_texture = header.has_texture || may_have_alpha(rest_of_line(line));
        }
        const auto number = parse_integer(take_word(line));
        if (word == "material" && number && take_word(line) == "=" && is_utf8(line)) {
            header.materials.emplace(*number, rest_of_line(line));
        }
    }

    std::string read_format(std::string_view line) {
        const std::string_view name = take_word(line);
        const auto encoding = look_up(kEncodings, name);
        if (!encoding || take_word(line) != "1.0") {
            return shown(name) +
                   " is not a known format: ascii, binary_little_endian or binary_big_endian, 1.0";
        }
        header.encoding = *encoding;
        has_format = true;
        return "";
    }

    std::string read_element(std::string_view line) {
        PlyElement element;
        element.name = take_word(line);
        const std::string_view word = take_word(line);
        const std::optional<std::int64_t> count = parse_integer(word);
        if (!count || *count < 0) {
            return shown(word) + " is not a number of elements";
        }
        element.count = static_cast<std::uint64_t>(*count);
        if (element.name == "vertex" && has("vertex", PlyRole::x)) {
            return "element 'vertex' is given twice";
        }
        header.elements.push_back(std::move(element));
        return "";
    }

    std::string read_property(std::string_view line) {
        if (header.elements.empty()) {
            return "a property comes before any element";
        }
        PlyElement& element = header.elements.back();
        PlyProperty property;
        std::string_view type = take_word(line);
        if (type == "list") {
            property.is_list = true;
            const std::string_view count_type = take_word(line);
            const auto found = look_up(kTypes, count_type);
            if (!found) {
                return shown(count_type) + " is not a PLY type";
            }
            property.count_type = *found;
            type = take_word(line);
        }
        const auto found = look_up(kTypes, type);
        if (!found) {
            return shown(type) + " is not a PLY type";
        }
        property.type = *found;
        property.name = take_word(line);
        property.role = role_of(element.name, property);
        const bool is_known = std::any_of(
            element.properties.begin(), element.properties.end(), [&](const PlyProperty& other) {
                return property.role != PlyRole::none && other.role == property.role;
            });
        if (is_known) {
            return fmt::format(
                "{} has property {} twice", shown(element.name), shown(property.name));
        }
        element.properties.push_back(std::move(property));
        return "";
    }

    [[nodiscard]] bool has(std::string_view name, PlyRole role) const {
        return std::any_of(
            header.elements.begin(), header.elements.end(), [&](const PlyElement& element) {
                return element.name == name &&
                       std::any_of(
                           element.properties.begin(), element.properties.end(),
                           [role](const PlyProperty& property) { return property.role == role; });
            });
    }
};

}  // namespace

std::optional<PlyHeader> read_ply_header(std::string_view bytes, Reporter& reporter) {
    LineScanner scanner(bytes);
    std::string_view first = scanner.next() ? scanner.line() : std::string_view();
    if (take_word(first) != "ply") {
        reporter.fault(1, "the first line is not 'ply'", "");
        return std::nullopt;
    }
    HeaderReader reader;
    while (scanner.next()) {
        std::string_view line = scanner.line();
        if (take_word(line) == "end_header") {
            const std::string lack = reader.check();
            if (!lack.empty()) {
                reporter.fault(scanner.number(), lack, "");
                return std::nullopt;
            }
            reader.header.body = scanner.rest();
            return std::move(reader.header);
        }
        if (const std::string problem = reader.read(scanner.line()); !problem.empty()) {
            reporter.fault(scanner.number(), problem, "");
            return std::nullopt;
        }
    }
    reporter.fault(scanner.number(), "the header has no end", "the line end_header is missing");
    return std::nullopt;
}

}  // namespace quasimc
