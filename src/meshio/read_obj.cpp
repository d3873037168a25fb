#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "meshio/formats.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Approximate number of vertices of a file: lines that begin with "v".
std::size_t count_vertices(std::string_view bytes) {
    std::size_t count = bytes.starts_with("v ") ? 1 : 0;
    for (std::size_t at = bytes.find("\nv "); at != std::string_view::npos;
         at = bytes.find("\nv ", at + 1)) {
        ++count;
    }
    return count;
}

/// Builds the geometry from the statements of a file.
class ObjReader {
  public:
    explicit ObjReader(FormatContext& context) : context_(context) {}

    MeshFile read(std::string_view bytes) {
        vertices_.reserve(count_vertices(bytes));
        LineScanner scanner(bytes);
        std::string joined;
        while (scanner.next() && !context_.reporter.is_full()) {
            std::string_view line = scanner.line();
            if (line.ends_with('\\')) {
                joined += line.substr(0, line.size() - 1);
                joined += ' ';
                continue;
            }
            line_ = scanner.number();
            if (joined.empty()) {
                read_statement(line);
            } else {
                joined += line;
                read_statement(joined);
                joined.clear();
            }
        }
        read_statement(joined);  // a last line with a continuation mark
        crossed_.warn(context_.reporter);
        mesh_.vertices = std::move(vertices_);
        return std::move(mesh_);
    }

  private:
    void read_statement(std::string_view line) {
        if (line.starts_with(kObjLabel)) {
            read_label(line.substr(kObjLabel.size()));
            return;
        }
        line = line.substr(0, line.find('#'));
        const std::string_view word = take_word(line);
        if (word == "v") {
            read_vertex(line);
        } else if (word == "f" || word == "fo") {
            read_face(line);
        } else if (word == "o") {
            read_name(line, object_);
            group_.clear();
            labels_.clear();
        } else if (word == "g") {
            read_name(line, group_);
        } else if (word == "usemtl") {
            read_name(line, material_);
        } else if (word == "mtllib") {
            read_library(rest_of_line(line));
        } else if (!word.empty()) {
            check_ignored(word);
        }
    }

    void read_vertex(std::string_view line) {
        std::array<double, 3> v{};
        for (double& x : v) {
            const std::string_view word = take_word(line);
            const std::optional<double> number = parse_real(word);
            if (!number || !std::isfinite(*number)) {
                fault(
                    word.empty() ? "a vertex with less than three numbers"
                                 : shown(word) + " is not a finite number");
                break;
            }
            x = *number;
        }
        vertices_.push_back({v[0], v[1], v[2]});
    }

    void read_face(std::string_view line) {
        corners_.clear();
        numbers_.clear();
        for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
            const auto number = read_corner(word.substr(0, word.find('/')));
            if (!number) {
                fault(
                    shown(word) + " is not a vertex",
                    fmt::format(
                        "there are {} vertices above it, counted from 1, or from the last as -1",
                        vertices_.size()));
                return;
            }
            numbers_.push_back(*number);
            corners_.push_back(vertices_[*number]);
        }
        if (corners_.size() < 3 || corners_.size() > kMaxCorners) {
            fault(
                fmt::format("a face with {} corners", corners_.size()),
                fmt::format("a face has 3 to {}", kMaxCorners));
            return;
        }
        if (current_part().add_face(corners_, numbers_, line_)) {
            crossed_.add("of line", line_);
        }
    }

    /// The number of a vertex, from 0.
    [[nodiscard]] std::optional<std::uint32_t> read_corner(std::string_view word) const {
        const std::optional<std::int64_t> number = parse_integer(word);
        const auto count = static_cast<std::int64_t>(vertices_.size());
        if (!number || *number == 0 || *number > count || *number < -count) {
            return std::nullopt;
        }
        const std::int64_t index = *number > 0 ? *number - 1 : count + *number;
        return static_cast<std::uint32_t>(index);
    }

    /// Reads a label of the current object: "key = value".
    void read_label(std::string_view line) {
        constexpr std::string_view kIs = " = ";
        const std::size_t middle = line.find(kIs);
        if (middle != line.npos && is_utf8(line)) {
            labels_.emplace_back(line.substr(0, middle), line.substr(middle + kIs.size()));
        }
    }

    void read_name(std::string_view line, std::string& name) {
        std::string text = rest_of_line(line);
        if (!is_utf8(text)) {
            fault("the name " + shown(text) + " is not UTF-8", "", "save the file as UTF-8");
            return;
        }
        name = std::move(text);
        part_ = nullptr;
    }

    /// The part for the current object, group and material; parts of one organ need not be
    /// contiguous.
    MeshPart& current_part() {
        if (part_ == nullptr) {
            const auto [group, is_new] =
                groups_.try_emplace({object_, group_}, mesh_.groups.size());
            if (is_new) {
                const std::string separator = object_.empty() || group_.empty() ? "" : "/";
                mesh_.groups.push_back({object_ + separator + group_, {}, {}, labels_});
            }
            part_ = &mesh_.groups[group->second].part(material_);
        }
        return *part_;
    }

    void read_library(const std::string& name) {
        try {
            const std::string path = context_.folder + name;
            Reporter reporter{path, {}, {}};
            FormatContext inner{reporter, context_.files, ""};
            const std::string bytes = context_.files.read(path);
            read_mtl(bytes, inner, mesh_);
            context_.reporter.add(reporter);
        } catch (const InputError& error) {
            // The file is often missing, and needed only for materials that the run file does not
            // define.
            warn(fmt::format(
                "the material library '{}' can't be read ({})", name, error.faults().front().why));
        }
    }

    /// Ignores statements without geometry; warns once of each other one.
    void check_ignored(std::string_view word) {
        constexpr std::array<std::string_view, 9> kHarmless{"vt", "vn", "vp",     "s",     "l",
                                                            "p",  "mg", "usemap", "maplib"};
        if (std::find(kHarmless.begin(), kHarmless.end(), word) != kHarmless.end()) {
            return;
        }
        constexpr std::array<std::string_view, 9> kSurfaces{
            "curv", "curv2", "surf", "cstype", "deg", "bmat", "step", "parm", "end"};
        if (std::find(kSurfaces.begin(), kSurfaces.end(), word) == kSurfaces.end()) {
            fault(shown(word) + " is not an OBJ statement");
        } else if (warned_.insert(std::string(word)).second) {
            warn(shown(word) + " is ignored: free-form curves and surfaces are not read");
        }
    }

    void fault(std::string problem, std::string why = {}, std::string suggestion = {}) {
        context_.reporter.fault(line_, std::move(problem), std::move(why), std::move(suggestion));
    }
    void warn(std::string text) { context_.reporter.warn(std::move(text), line_); }

    FormatContext& context_;
    MeshFile mesh_{{}, {}, "line", {}};
    std::vector<Vec3> vertices_, corners_;  // of the file; of a face
    std::vector<std::uint32_t> numbers_;    // of the corners, among the vertices
    std::string object_, group_, material_;
    Labels labels_;  // of the object
    std::map<std::pair<std::string, std::string>, std::size_t> groups_;
    MeshPart* part_ = nullptr;
    std::set<std::string> warned_;
    CrossedFaces crossed_;
    std::uint32_t line_ = 0;
};

}  // namespace

MeshFile read_obj(std::string_view bytes, FormatContext& context) {
    return ObjReader(context).read(bytes);
}

}  // namespace quasimc
