
#include <fmt/format.h>

#include "meshio/formats.h"
#include "meshio/number_line.h"
#include "text/little_endian.h"

namespace quasimc {
namespace {

constexpr std::size_t kStlHeader = 80, kStlStart = kStlHeader + 4, kStlTriangle = 50;

/// Whether the size of the file agrees with the number of triangles in its header.
bool is_binary_stl(std::string_view bytes) {
    return bytes.size() >= kStlStart &&
           (bytes.size() - kStlStart) / kStlTriangle ==
               little_endian_at<std::uint32_t>(bytes, kStlHeader) &&
           (bytes.size() - kStlStart) % kStlTriangle == 0;
}

MeshFile read_binary_stl(std::string_view bytes, Reporter& reporter) {
    Mesh mesh;
    MeshPart part;
    const std::uint32_t count = little_endian_at<std::uint32_t>(bytes, kStlHeader);
    mesh.faces.reserve(count);
    for (std::uint32_t i = 0; i < count && !reporter.is_full(); ++i) {
        const std::size_t first = kStlStart + kStlTriangle * i + 3 * sizeof(float);
        Triangle triangle;
        bool is_finite = true;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto coordinate = [&](std::size_t axis) {
                const std::size_t number = 3 * corner + axis;
                return little_endian_at<float>(bytes, first + number * sizeof(float));
            };
            triangle[corner] = {coordinate(0), coordinate(1), coordinate(2)};
            is_finite = is_finite && std::isfinite(length(triangle[corner]));
        }
        if (is_finite) {
            mesh.push_back(triangle);
            part.lines.push_back(i + 1);
        } else {
            reporter.faults.add(
                {fmt::format("{}: triangle {}", reporter.file, i + 1), "a corner is not finite", "",
                 ""});
        }
    }
    part.faces = std::move(mesh.faces);
    return {{{"", {}, {std::move(part)}}}, {}, "triangle", std::move(mesh.vertices)};
}

/// Builds solids from the lines of a text.
class StlReader {
  public:
    explicit StlReader(Reporter& reporter) : reporter_(reporter) {}

    MeshFile read(std::string_view bytes) {
        LineScanner scanner(bytes);
        while (scanner.next() && !reporter_.is_full()) {
            line_ = scanner.number();
            read_statement(scanner.line());
        }
        if (is_open_ || !corners_.empty()) {
            fault("the file ends within a loop");
        } else if (is_in_solid_) {
            reporter_.warn(
                "the file ends without endsolid: it may be incomplete; write it again", line_);
        }
        finish_group();
        file_.vertices = std::move(mesh_.vertices);
        return std::move(file_);
    }

  private:
    void read_statement(std::string_view line) {
        const std::string_view word = take_word(line);
        if (word == "solid") {
            finish_group();
            read_name(line);
            is_in_solid_ = true;
        } else if (word == "vertex") {
            const auto numbers = numbers_of_line(line, line_, "a vertex is x y z", reporter_);
            if (numbers && numbers->size() == 3) {
                corners_.push_back(point_at(*numbers, 0));
            } else if (numbers) {
                fault(fmt::format("a vertex with {} numbers", numbers->size()));
            }
        } else if (word == "outer") {
            if (!corners_.empty()) {
                fault("a loop begins before the previous one ends (endloop)");
            }
            corners_.clear();
            is_open_ = true;
        } else if (word == "endloop") {
            finish_loop();
        } else if (word == "endsolid") {
            is_in_solid_ = false;
        } else if (!word.empty() && word != "facet" && word != "endfacet") {
            fault(shown(word) + " is not an STL statement");
        }
    }

    void read_name(std::string_view line) {
        name_ = rest_of_line(line);
        if (!is_utf8(name_)) {
            fault("the name " + shown(name_) + " is not UTF-8");
            name_.clear();
        }
    }

    void finish_loop() {
        if (corners_.size() != 3) {
            fault(fmt::format("a loop with {} vertices", corners_.size()));
        } else {
            mesh_.push_back({corners_[0], corners_[1], corners_[2]});
            lines_.push_back(line_);
        }
        corners_.clear();
        is_open_ = false;
    }

    void finish_group() {
        if (!mesh_.faces.empty()) {
            file_.groups.push_back({name_, {}, {{"", std::move(mesh_.faces), std::move(lines_)}}});
        }
        mesh_.faces.clear();
        lines_.clear();
    }

    void fault(std::string problem) {
        reporter_.fault(line_, std::move(problem), "a facet must have one loop of three vertices");
    }

    Reporter& reporter_;
    MeshFile file_{{}, {}, "line", {}};
    Mesh mesh_;  ///< all vertices; the triangles of the current solid
    std::vector<std::uint32_t> lines_;
    std::vector<Vec3> corners_;
    std::string name_;
    bool is_open_ = false, is_in_solid_ = false;
    std::uint32_t line_ = 0;
};

}  // namespace

MeshFile read_stl(std::string_view bytes, FormatContext& context) {
    Reporter& reporter = context.reporter;
    if (is_binary_stl(bytes)) {
        return read_binary_stl(bytes, reporter);
    }
    if (bytes.find('\0') != std::string_view::npos) {
        reporter.faults.add(
            {reporter.file, "is not an STL file",
             "a binary one has 50 bytes for each triangle counted at byte 81", ""});
        return {{}, {}, "line", {}};
    }
    return StlReader(reporter).read(bytes);
}

}  // namespace quasimc
