#include <unordered_map>

#include <fmt/format.h>

#include "meshio/can_label.h"
#include "meshio/formats.h"
#include "meshio/number_line.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

const std::string kCanLine = "a line contains p 1 LABEL 3 and x y z of three corners";

/// Builds a group for each label from the lines of a file.
class CanReader {
  public:
    explicit CanReader(Reporter& reporter) : reporter_(reporter) {}

    MeshFile read(std::string_view bytes) {
        LineScanner scanner(bytes);
        while (scanner.next() && !reporter_.is_full()) {
            line_ = scanner.number();
            read_line(scanner.line().substr(0, scanner.line().find('#')));
        }
        crossed_.warn(reporter_);
        return std::move(mesh_);
    }

  private:
    void read_line(std::string_view line) {
        const std::string_view type = take_word(line);
        if (type.empty()) {
            return;
        }
        const auto attributes = parse_integer(take_word(line));
        const std::string_view label = take_word(line);
        if (type != "p" || !attributes || *attributes < 1 || *attributes > kMaxAttributes) {
            fault(shown(type) + " is not a polygon with a label");
            return;
        }
        const std::optional<std::int64_t> number = can_label_number(label);
        if (!number) {
            reporter_.fault(
                line_, shown(label) + " is not a label",
                "a label has up to 15 digits: species, plant (5), leaf (3), element (3)");
            return;
        }
        for (std::int64_t i = 1; i < *attributes; ++i) {
            static_cast<void>(take_word(line));
        }
        const auto corners = parse_integer(take_word(line));
        const auto numbers = numbers_of_line(line, line_, kCanLine, reporter_);
        if (!numbers) {
            return;
        }
        if (!corners || *corners < 3 || *corners > static_cast<std::int64_t>(kMaxCorners) ||
            numbers->size() != 3 * static_cast<std::size_t>(*corners)) {
            fault(
                fmt::format("{} coordinates of {} corners", numbers->size(), corners.value_or(0)));
            return;
        }
        add_polygon(*number, *numbers);
    }

    void add_polygon(std::int64_t label, const std::vector<double>& numbers) {
        corners_.clear();
        vertex_numbers_.clear();
        for (std::size_t i = 0; i < numbers.size(); i += 3) {
            vertex_numbers_.push_back(static_cast<std::uint32_t>(mesh_.vertices.size()));
            corners_.push_back(point_at(numbers, i));
            mesh_.vertices.push_back(corners_.back());
        }
        if (part_of(label).add_face(corners_, vertex_numbers_, line_)) {
            crossed_.add("of line", line_);
        }
    }

    MeshPart& part_of(std::int64_t number) {
        const auto [group, is_new] = groups_.try_emplace(number, mesh_.groups.size());
        if (is_new) {
            const CanLabel label = can_label(number);
            mesh_.groups.push_back(
                {std::to_string(number),
                 number,
                 {{label.material(), {}, {}}},
                 {{"species", std::to_string(label.species)},
                  {"plant", std::to_string(label.plant)},
                  {"leaf", std::to_string(label.leaf)},
                  {"element", std::to_string(label.element)}}});
        }
        return mesh_.groups[group->second].parts.front();
    }

    void fault(std::string problem) { reporter_.fault(line_, std::move(problem), kCanLine); }

    static constexpr std::int64_t kMaxAttributes = 64;

    Reporter& reporter_;
    MeshFile mesh_{{}, {}, "line", {}};
    std::vector<Vec3> corners_;
    std::vector<std::uint32_t> vertex_numbers_;
    std::unordered_map<std::int64_t, std::size_t> groups_;
    CrossedFaces crossed_;
    std::uint32_t line_ = 0;
};

}  // namespace

MeshFile read_can(std::string_view bytes, FormatContext& context) {
    return CanReader(context.reporter).read(bytes);
}

}  // namespace quasimc
