#include "coupling/vlab/surface_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/text.h"
#include "geometry/shapes/shapes.h"
#include "quasimc/error.h"
#include "quasimc/mesh.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Content of a surface file.
struct SurfaceData {
    Vec3 contact, heading{0, 1, 0}, up{0, 0, 1};
    double size = 0;  // 0: not given
    std::array<double, 6> extents{};
    std::vector<BezierPatch> patches;
};

class SurfaceReader {
  public:
    SurfaceReader(std::string_view text, const std::string& name) : lines_(text), name_(name) {}

    SurfaceData read() {
        read_extents();
        while (next()) {
            if (!read_keyword()) {
                read_patch();
            }
        }
        if (data_.patches.empty()) {
            fail("it has no patch", "a surface needs at least one");
        }
        return std::move(data_);
    }

  private:
    [[noreturn]] void fail(std::string problem, std::string why) const {
        throw InputError(
            {{fmt::format("{}:{}", name_, lines_.number()), std::move(problem), std::move(why),
              ""}});
    }

    bool next() {
        while (lines_.next()) {
            if (!trimmed(lines_.line()).empty()) {
                return true;
            }
        }
        return false;
    }
    void need_line(std::string_view what) {
        if (!next()) {
            fail("the file is incomplete", fmt::format("{} is expected", what));
        }
    }

    double number(std::string_view word) const {
        const auto value = parse_real(word);
        if (!value || !std::isfinite(*value)) {
            fail(fmt::format("{} is not a number", shown(word)), "");
        }
        return *value;
    }

    void read_extents() {
        need_line("the extents of the surface");
        std::string_view rest = lines_.line();
        for (double& extent : data_.extents) {
            extent = number(take_word(rest));
        }
    }

    /// The numbers behind "X:", "Y:" and "Z:".
    Vec3 read_vector(std::string_view rest) const {
        std::array<double, 3> values{};
        for (double& value : values) {
            const std::size_t colon = rest.find(':');
            if (colon == std::string_view::npos) {
                fail(shown(trimmed(lines_.line())), "'X: number Y: number Z: number' is expected");
            }
            rest.remove_prefix(colon + 1);
            value = number(take_word(rest));
        }
        return {values[0], values[1], values[2]};
    }

    bool read_keyword() {
        const std::string_view line = trimmed(lines_.line());
        const auto starts = [&](std::string_view word) { return line.starts_with(word); };
        if (starts("CONTACT POINT")) {
            data_.contact = read_vector(line);
        } else if (starts("HEADING")) {
            data_.heading = read_vector(line);
        } else if (starts("UP")) {
            data_.up = read_vector(line);
        } else if (starts("SIZE")) {
            std::string_view rest = line.substr(std::min(line.find(':'), line.size() - 1) + 1);
            data_.size = number(take_word(rest));
        } else if (starts("PRECISION")) {
            skip_after_precision();
        } else if (!starts("END POINT")) {
            return false;
        }
        return true;
    }

    /// Skips the line after the precision, unless it begins with a keyword.
    void skip_after_precision() {
        LineScanner ahead = lines_;
        constexpr std::array<std::string_view, 5> kKeywords{
            "CONTACT", "END", "HEADING", "UP", "SIZE"};
        if (!ahead.next()) {
            return;
        }
        const std::string_view line = trimmed(ahead.line());
        const bool is_keyword = std::any_of(
            kKeywords.begin(), kKeywords.end(),
            [&](std::string_view word) { return line.starts_with(word); });
        if (!is_keyword) {
            lines_ = ahead;
        }
    }

    /// Reads a patch: name, colours, three lines of neighbours of which the first begins with A,
    /// sixteen points.
    void read_patch() {
        do {
            need_line("the neighbours of a patch ('AL: ... A: ... AR: ...')");
        } while (lines_.line().find_first_of("Aa") != lines_.line().find_first_not_of(" \t"));
        need_line("the neighbours of a patch");
        need_line("the neighbours of a patch");
        std::array<double, 48> values{};
        std::string_view rest;
        for (double& value : values) {
            std::string_view word = take_word(rest);
            while (word.empty()) {
                need_line("a control point of a patch");
                rest = lines_.line();
                word = take_word(rest);
            }
            value = number(word);
        }
        BezierPatch patch;
        for (std::size_t i = 0; i < patch.size(); ++i) {
            patch[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
        }
        data_.patches.push_back(patch);
    }

    LineScanner lines_;
    const std::string& name_;
    SurfaceData data_;
};

/// Sum of the area vectors of a patch's net.
Vec3 net_normal(const BezierPatch& patch) {
    return cross(patch[12] - patch[0], patch[3] - patch[0]) +
           cross(patch[3] - patch[15], patch[12] - patch[15]);
}

/// The patch with u and v exchanged, so that the other side is up.
BezierPatch turned_over(const BezierPatch& patch) {
    BezierPatch turned;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            turned[4 * i + j] = patch[4 * j + i];
        }
    }
    return turned;
}

double largest_extent(const std::array<double, 6>& e) {
    return std::max({e[1] - e[0], e[3] - e[2], e[5] - e[4]});
}

}  // namespace

std::vector<Triangle> read_surface_text(
    std::string_view text, const std::string& name, int subdivisions) {
    SurfaceData data = SurfaceReader(text, name).read();
    const double size = data.size > 0 ? data.size : largest_extent(data.extents);
    const Vec3 across = cross(data.heading, data.up);
    if (!(size > 0) || !(length(across) > 0)) {
        throw InputError(
            {{name, size > 0 ? "heading and up are parallel" : "the surface has no size", "", ""}});
    }
    const Vec3 x = normalized(across), y = normalized(data.heading), z = normalized(data.up);
    for (BezierPatch& patch : data.patches) {
        for (Vec3& p : patch) {
            const Vec3 q = (p - data.contact) / size;
            p = {dot(q, x), dot(q, y), dot(q, z)};
        }
        if (net_normal(patch).z < 0) {
            patch = turned_over(patch);
        }
    }
    constexpr double kCoarsest = 0.02;
    return make_bezier_surface(data.patches, {kCoarsest * std::pow(0.25, subdivisions)});
}

}  // namespace quasimc
