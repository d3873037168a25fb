#pragma once

// Data for the page in the browser (docs/develop/decisions/viewer-server.md).

#include <span>
#include <string>
#include <vector>

#include "light/models/source.h"
#include "quasimc/result.h"
#include "runfile/run_file.h"
#include "scene/scene.h"
#include "text/json.h"
#include "window/window_organs.h"

namespace quasimc {

/// The sources of a time, z up: lists "suns" of unit vectors towards them and towards other
/// parallel light, and "lamps" of their positions about `middle`; "sky": its radiance,
/// all bands together, in cells of 10 degrees: nine rings from the horizon up, each of 36 cells
/// from the x axis towards y. Each cell is a base64 digit: 63 times the square root of its radiance
/// relative to the brightest one.
/// Empty without a sky.
[[nodiscard]] Json json_lights(const Sources& sources, const Vec3& middle);

/// A kind of number that the page in the browser shows of every organ.
struct WindowColumn {
    /// Keys of its values in a result: a quantity and a band, "ratios" and a ratio,
    /// "sunlit_fraction".
    std::vector<std::string> path;
    std::string quantity, name, band, unit, sum_unit;
};

/// Light absorbed per area first, the sunlit fraction and ratios last.
[[nodiscard]] std::vector<WindowColumn> window_columns(
    const std::vector<Band>& bands,
    const std::string& length_unit,
    const std::vector<std::string>& ratios);

/// Members of the outermost object: program, unit, axes, periods, site, organs and columns. Sensors
/// are the last organs; their number and positions are members of their own.
[[nodiscard]] Json json_window_scene(
    const Scene& scene, const WindowOrgans& organs, const std::vector<WindowColumn>& columns);

/// Means, standard errors, low and high ends of the organs, single precision.
[[nodiscard]] std::string window_values(const std::vector<Estimate>& organs);

// Parts of a result without its organs, as JSON objects, for the page of a run in progress.

/// The run: files, settings, sources, warnings.
[[nodiscard]] std::string window_run_head(const RunFile& run);
/// The light at a time: method, rays, energy, groups.
[[nodiscard]] std::string window_light_head(const RunFile& run, const Result& result);
/// The light at a time of a run without run file. @param bands  bands of the result
[[nodiscard]] std::string window_light_head(
    std::span<const Band> bands, const std::string& length_unit, const Result& result);

}  // namespace quasimc
