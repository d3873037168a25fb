#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/notices.h"
#include "coupling/vlab/arguments.h"
#include "coupling/vlab/directive.h"
#include "files/input_files.h"
#include "geometry/shapes/shapes.h"
#include "light/models/sky_table.h"
#include "optics/material.h"
#include "quasimc/result.h"
#include "quasimc/run_spec.h"
#include "scene/scene.h"

namespace quasimc {

/// The letters of "return type".
enum class ReturnType {
    flux,     ///< F: light absorbed by the organ
    density,  ///< D: absorbed per one-sided area
    upper,    ///< U: falling on the upper side, per area
    lower,    ///< L: falling on the lower side, per area
    hits,     ///< H: falling on both sides per area, as a fraction of what the sources send
};

/// Value of "quantities" for one slot of an answer.
struct ReturnQuantity {
    std::optional<Quantity> quantity;  ///< empty: the sunlit fraction of the area
    bool is_error = false;             ///< its standard error instead
};

/// Parallel light as given in the file: the direction of travel, y up.
struct LightDirective {
    Vec3 travel;
    double weight = 1;
};

enum class Weather { clear, overcast };

/// Valid turbidities: 1 is air without dust or water, 64 thick fog.
inline constexpr Range kTurbidities{1, 64};
/// Smallest turbidity in use: above it the luminance of the zenith grows with the height of the
/// sun, as under a clear sky.
inline constexpr double kClearestSky = 1.4;

/// The light of the sky, and of the sun, at a site over a part of a day.
struct SkyOfDay {
    double latitude_deg = 0;
    double longitude_deg = 0;  ///< east positive
    Weather weather = Weather::clear;
    double turbidity = 2.45;
    double from_hour = 0, until_hour = 24;  ///< standard time of the zone
    double day = 172;                       ///< number of the day in the year, from 1
    bool with_sun = true;                   ///< whether a clear sky has its sun
    friend bool operator==(const SkyOfDay&, const SkyOfDay&) = default;
};

/// A surface of the surface list in the frame of an organ: x along heading x up, y along heading, z
/// along up.
struct SurfaceDirective {
    std::vector<Triangle> triangles;
};

/// The table of variances.
struct VarianceFile {
    std::string name;  ///< empty: made from the sampling method
};

struct GroundDirective {
    double height = 0;
    std::size_t material = 0;
};

/// The cell of a periodic canopy: the axes x and z of the file.
struct CellDirective {
    double size_x = 0, size_z = 0;
    double low_x = 0, low_z = 0;
};

/// Material indices of an organ's sides.
struct SideMaterials {
    std::size_t upper = 0, lower = 0;
    friend bool operator==(const SideMaterials&, const SideMaterials&) = default;
    friend bool operator<(const SideMaterials& a, const SideMaterials& b) {
        return std::pair(a.upper, a.lower) < std::pair(b.upper, b.lower);
    }
};

/// Checked content of a specification file, with defaults for missing directives.
struct Specification {
    SpecificationKind kind = SpecificationKind::quasimc;
    int verbose = 1;

    std::vector<Band> bands{{"660", "1"}};
    std::vector<double> irradiance{1};  ///< per band, of all sources together
    std::vector<ReturnType> returns{ReturnType::flux};
    std::vector<ReturnQuantity> quantities;  ///< instead of `returns`, if any

    RunSpec run;
    std::optional<double> ray_density;  ///< paths per unit of the domain's area, instead of a count
    bool one_ray_per_spectrum = true;
    /// If set, organs with queries are sensors, which light passes; otherwise they are part of the
    /// scene.
    std::optional<double> sensor_half_angle_deg;

    /// Catalogue name of the scattering model of all materials that are no mirrors by their
    /// exponents.
    std::string light_model = "lambertian";
    /// [material][band]; the first is the leaf's.
    std::vector<std::vector<SideOptics>> materials{{{0.25, 0.25}}};
    std::optional<std::size_t> leaf_lower;  ///< material of the lower side of leaves
    /// Number of the parameter of surfaces and polygons that names the material, from 1.
    std::optional<std::size_t> material_parameter;

    std::vector<LightDirective> lights;  ///< any light switches the sky off
    std::optional<SkyOfDay> sky;
    std::optional<SkyTable> sky_table;  ///< z up
    bool has_uniform_sky = false;

    std::vector<SurfaceDirective> surfaces;
    int cylinder_sides = 12;
    bool cylinder_takes_diameter = false;
    bool cylinder_width_is_given = false;
    std::optional<CellDirective> cell;
    std::optional<GroundDirective> ground;

    std::optional<VarianceFile> variance_file;
    std::optional<std::string> picture_file;  ///< without the number of the step
    std::optional<int> view_port;  ///< port of the page in the browser, 0: any; empty: no page

    [[nodiscard]] std::size_t band_count() const { return bands.size(); }
    /// The number by which organs name the first material.
    [[nodiscard]] std::size_t first_material() const {
        return kind == SpecificationKind::montecarlo ? 1 : 0;
    }
    /// Whether a query has an answer: one that requests light and, with MonteCarlo, one that only
    /// shades, unless there are sensors. @param asks  from the first parameter of the query
    [[nodiscard]] bool is_answered(bool asks) const {
        return asks || (kind == SpecificationKind::montecarlo && !sensor_half_angle_deg);
    }
    /// The materials of an organ that names the upper one, or both.
    [[nodiscard]] SideMaterials sides_of(
        std::size_t upper, std::optional<std::size_t> lower) const {
        return {upper, lower.value_or(upper == 0 ? leaf_lower.value_or(0) : upper)};
    }
};

/// The power of two nearest to a count, for the point sets that need one.
[[nodiscard]] std::uint64_t nearest_power_of_two(std::uint64_t count);

/// Reads the text of a specification file: directives "name: values", names without regard to case;
/// lines that begin with // are comments.
/// @param name   of the file, for messages
/// @param files  reads what the text names: surfaces, skies, lights
/// @throws InputError  with all faults: unknown directives, values out of range, incomplete blocks
///                     of materials
[[nodiscard]] Specification read_specification_text(
    std::string_view text,
    const std::string& name,
    SpecificationKind kind,
    InputFiles& files,
    Notices& notices);

/// Reads a specification file; the files it names are relative to the working folder.
[[nodiscard]] Specification read_specification(
    const std::string& path, SpecificationKind kind, Notices& notices);

}  // namespace quasimc
