#include "scene/scene_checks.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "scene/overlap/coplanar.h"
#include "scene/overlap/overlap_search.h"
#include "scene/scene_draft.h"

namespace quasimc {
namespace {

constexpr std::size_t kMaxOrganFaults = 1000;

std::string text_of(const Vec3& p) {
    return fmt::format("({}, {}, {})", shortest(p.x), shortest(p.y), shortest(p.z));
}

bool is_usable(const Vec3& p) {
    const auto small = [](double x) { return std::abs(x) <= kLargestCoordinate; };
    return small(p.x) && small(p.y) && small(p.z);
}

/// Whether all corners of a triangle are finite and not too large.
bool is_usable(const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [](const Vec3& p) { return is_usable(p); });
}

/// The fault of an organ's first unusable corner; empty if there is none.
std::optional<Fault> corner_fault(
    const SceneDraft& draft, std::size_t organ, const Orientation& orientation) {
    std::size_t number = 0, bad = 0, first_bad = 0;
    Triangle worst{};
    for (const DraftPart& part : draft.parts_of(organ)) {
        for (std::size_t i = 0; i < draft.size_of(part); ++i) {
            ++number;
            const Triangle t = draft.triangle(part, i);
            if (!is_usable(t) && ++bad == 1) {
                worst = t;
                first_bad = number;
            }
        }
    }
    if (bad == 0) {
        return std::nullopt;
    }
    const auto corner =
        std::find_if_not(worst.begin(), worst.end(), [](const Vec3& p) { return is_usable(p); });
    std::string problem = fmt::format(
        "corner {} of triangle {} is {}", corner - worst.begin() + 1, first_bad,
        text_of(orientation.outward(*corner)));
    if (bad > 1) {
        problem += fmt::format(", and {} with this error", counted(bad - 1, "more triangle"));
    }
    return Fault{
        "", problem, fmt::format("coordinates must be finite and at most {}", kLargestCoordinate),
        ""};
}

void check_axis_of_cell(char axis, double low, double size, double extent, Faults& faults) {
    const std::string where = fmt::format("cell along {}", axis);
    if (!std::isfinite(low) || std::abs(low) > kLargestCoordinate) {
        faults.add(
            {where, fmt::format("the low border is {}", shortest(low)), "borders must be finite",
             ""});
    }
    if (!(size > 0) || !(size <= kLargestCoordinate)) {
        faults.add(
            {where, fmt::format("the size is {}", shortest(size)), "periods must be positive",
             "remove the axis if the scene is not periodic along it"});
        return;
    }
    constexpr double kSmallestPart = 1e-6;
    if (size < kSmallestPart * extent) {
        faults.add(
            {where,
             fmt::format(
                 "the size {} is less than a millionth of the scene, {}", shortest(size),
                 shortest(extent)),
             "", "give cell and organs in the same unit of length"});
    }
}

/// Approximate sum over the triangles of the number of cells that each extends over. Each triangle
/// of an instance counts as one.
double images_in(const Cell& cell, const SceneDraft& draft) {
    double images = 0;
    for (std::size_t i = 0; i < draft.mesh.size(); ++i) {
        const Triangle t = draft.mesh[i];
        const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
        const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
        images += (cell.along_x ? 1 + (high_x - low_x) / cell.size_x : 1) *
                  (cell.along_y ? 1 + (high_y - low_y) / cell.size_y : 1);
    }
    for (const Instance& copy : draft.copies) {
        images += static_cast<double>(copy.mesh->size());
    }
    return images;
}

/// Horizontal surfaces, whose periodic copies overlap.
class FlatSurfaces {
  public:
    explicit FlatSurfaces(double scene_size) : scene_size_(scene_size) {}

    void add(const Triangle& t) {
        const Bounds bounds = bounds_of(t);
        const double rise = bounds.size().z;
        const double tolerance = coplanar_tolerance(size_of(bounds), scene_size_);
        const double part =
            tolerance / std::max(rise, tolerance);  // fraction of its copies in one plane
        constexpr double kMinPart = 0.01;
        if (part > kMinPart) {
            area_ += part * std::abs(area_vector(t).z) / 2;
            bounds_.include(bounds);
        }
    }
    /// Mean number of layers that they form in the cell, for any position along an open axis.
    [[nodiscard]] double layers_in(const Cell& cell) const {
        const double x = cell.along_x ? cell.size_x : bounds_.size().x;
        const double y = cell.along_y ? cell.size_y : bounds_.size().y;
        return area_ > 0 ? area_ / (x * y) : 0;
    }

  private:
    double scene_size_;
    double area_ = 0;
    Bounds bounds_;
};

/// Layers of horizontal surfaces in the cell; 0 in scenes so large that surfaces are not compared.
double flat_layers_in(const Cell& cell, const SceneDraft& draft, double scene_size) {
    std::size_t triangles = draft.mesh.size();
    for (const Instance& copy : draft.copies) {
        triangles += copy.mesh->size();
    }
    if (triangles > kMaxToCompare) {
        return 0;
    }
    FlatSurfaces flat(scene_size);
    for (std::size_t i = 0; i < draft.mesh.size(); ++i) {
        flat.add(draft.mesh[i]);
    }
    for (const Instance& copy : draft.copies) {
        for (std::size_t i = 0; i < copy.mesh->size(); ++i) {
            flat.add(copy.triangle(i));
        }
    }
    return flat.layers_in(cell);
}

/// Whether all coordinates are finite and not too large, so that organs need no check one by one.
bool is_usable(const SceneDraft& draft, const std::vector<Bounds>& copies) {
    const auto is_small = [](const Bounds& b) { return is_usable(b.low) && is_usable(b.high); };
    // Bounds ignore NaN.
    const auto has_usable_mesh = [](const Instance& copy) {
        return std::all_of(
            copy.mesh->vertices.begin(), copy.mesh->vertices.end(),
            [](const Vec3& p) { return is_usable(p); });
    };
    std::unordered_set<const Mesh*> known;
    for (const Instance& copy : draft.copies) {
        if (known.insert(copy.mesh.get()).second && !has_usable_mesh(copy)) {
            return false;
        }
        if (!is_usable(copy.transform.shift) ||
            !std::all_of(
                copy.transform.rows.begin(), copy.transform.rows.end(),
                [](const Vec3& row) { return is_usable(row); })) {
            return false;
        }
    }
    return std::all_of(
               draft.mesh.vertices.begin(), draft.mesh.vertices.end(),
               [](const Vec3& p) { return is_usable(p); }) &&
           std::all_of(copies.begin(), copies.end(), is_small);
}

/// Widens bounds by the faces of a part in the draft's own mesh.
void add_faces(const SceneDraft& draft, const DraftPart& part, Bounds& bounds) {
    for (std::size_t k = 0; k < part.face_count; ++k) {
        for (const Vec3& corner : draft.mesh[part.first_face + k]) {
            bounds.add(corner);
        }
    }
}

}  // namespace

std::string location_of(const SceneDraft& draft, std::size_t organ) {
    const Organ& which = draft.organs[organ];
    const std::string_view where = draft.location_of(organ);
    return where.empty() ? fmt::format("organ '{}' (id {})", which.name, which.id)
                         : fmt::format("{}: organ '{}'", where, which.name);
}

std::string location_of(const MaterialSpec& material, const std::string& where) {
    const std::string which = fmt::format("material '{}'", material.name);
    return where.empty() ? which : where + ": " + which;
}

void OrganFaults::add(const SceneDraft& draft, std::size_t organ, Fault fault) {
    if (++count_ <= kMaxOrganFaults) {
        fault.where = location_of(draft, organ);
        faults_.add(std::move(fault));
    }
}

void OrganFaults::finish() {
    if (count_ > kMaxOrganFaults) {
        faults_.add({"organs", counted(count_ - kMaxOrganFaults, "more error"), "", ""});
    }
}

void check_bands(const std::vector<Band>& bands, Faults& faults) {
    if (bands.empty()) {
        faults.add({"bands", "there is none", "light is computed by band", "name one"});
    }
    for (std::size_t i = 0; i < bands.size(); ++i) {
        const std::string& name = bands[i].name;
        if (name.empty()) {
            faults.add({"bands", fmt::format("band {} has no name", i + 1), "", ""});
            continue;
        }
        if (!is_utf8(name)) {
            faults.add({"bands", fmt::format("the name '{}' is not UTF-8", name), "", ""});
        }
        const auto same = [&](const Band& band) { return band.name == name; };
        if (std::any_of(bands.begin(), bands.begin() + static_cast<std::ptrdiff_t>(i), same)) {
            faults.add(
                {"bands", fmt::format("band '{}' is named twice", name), "names must be unique",
                 ""});
        }
    }
}

void check_north(const Orientation& orientation, Faults& faults) {
    const Vec3 north = orientation.inward(orientation.north());
    const double size = length(north);
    if (!is_finite(north) || !(size > 0) || !std::isfinite(size)) {
        faults.add(
            {"north", fmt::format("{} is not a direction", text_of(orientation.north())), "", ""});
    } else if (north.z != 0) {
        faults.add(
            {"north", fmt::format("{} is not horizontal", text_of(orientation.north())),
             fmt::format("{} is up", orientation.up() == UpAxis::z ? "z" : "y"), ""});
    }
}

void check_cell(const Cell& cell, const Bounds& organs, Faults& faults) {
    const Vec3 extent = organs.empty() ? Vec3{} : organs.size();
    if (cell.along_x) {
        check_axis_of_cell('x', cell.low_x, cell.size_x, extent.x, faults);
    }
    if (cell.along_y) {
        check_axis_of_cell('y', cell.low_y, cell.size_y, extent.y, faults);
    }
}

void check_images(const Cell& cell, const SceneDraft& draft, const Bounds& organs, Faults& faults) {
    constexpr double kMaxImages = 1e8, kMaxLayers = 1000;
    constexpr const char* kSameUnit = "give cell and organs in the same unit of length";
    if (!cell.periodic()) {
        return;
    }
    const double images = images_in(cell, draft);
    if (images > kMaxImages) {
        faults.add(
            {"cell", fmt::format("the triangles extend over {:.0f} cells in total", images),
             "their copies in each are intersected", kSameUnit});
        return;
    }
    const double layers = flat_layers_in(cell, draft, size_of(organs));
    if (layers > kMaxLayers) {
        faults.add(
            {"cell",
             fmt::format(
                 "horizontal surfaces are {:.0f} times as large as the cell, and as many periodic "
                 "copies overlap",
                 layers),
             "organs may be a few times as large as the cell at most", kSameUnit});
    }
}

void turn_inward(SceneDraft& draft, const Orientation& orientation) {
    for (Vec3& p : draft.mesh.vertices) {
        p = orientation.inward(p);
    }
    for (Instance& copy : draft.copies) {
        Affine& a = copy.transform;
        if (orientation.up() == UpAxis::y) {
            a.rows = {a.rows[2], a.rows[0], a.rows[1]};
        }
        a.shift = orientation.inward(a.shift);
    }
}

Bounds check_triangles(
    const SceneDraft& draft,
    std::size_t first,
    const Orientation& orientation,
    OrganFaults& faults) {
    const std::vector<Bounds> copies = instance_bounds(draft.copies);
    const bool all_usable = is_usable(draft, copies);
    Bounds bounds;
    for (std::size_t i = first; i < draft.organs.size(); ++i) {
        const std::span<const DraftPart> parts = draft.parts_of(i);
        const bool is_empty = std::all_of(parts.begin(), parts.end(), [&](const DraftPart& part) {
            return draft.size_of(part) == 0;
        });
        if (is_empty) {
            faults.add(draft, i, {"", "it has no triangles", "light is computed on triangles", ""});
        }
        if (!all_usable) {
            if (const auto fault = corner_fault(draft, i, orientation)) {
                faults.add(draft, i, *fault);
                continue;
            }
        }
        for (const DraftPart& part : parts) {
            if (part.copy != DraftPart::kNoCopy) {
                bounds.include(copies[part.copy]);
            }
            add_faces(draft, part, bounds);
        }
    }
    return bounds;
}

}  // namespace quasimc
