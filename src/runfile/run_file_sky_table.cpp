#include <array>
#include <cmath>

#include <fmt/format.h>

#include "runfile/run_file_source_kinds.h"
#include "weather/read_sky_table.h"

namespace quasimc {

std::optional<StatedShape> read_table_shape(TableReader& table, const RunFileContext& context) {
    constexpr std::array<std::string_view, 2> kFormats{"cells", "vlab"};
    constexpr std::array<std::string_view, 2> kValues{"radiance", "flux"};
    const auto file = table.required("file", table.text("file"));
    const auto format = table.any("format") != nullptr ? table.choice("format", kFormats)
                                                       : std::optional<std::string>("cells");
    const auto values = table.any("values") != nullptr ? table.choice("values", kValues)
                                                       : std::optional<std::string>("radiance");
    if (!file || !format || !values) {
        return std::nullopt;
    }
    try {
        SkyTable sky = read_sky_table(
            context.files->read(*file), *file,
            *format == "vlab" ? SkyFileFormat::vlab : SkyFileFormat::cells,
            *values == "flux" ? SkyValues::flux : SkyValues::radiance);
        const Vec3 north = context.orientation.towards(0, 0);
        sky.first_azimuth = std::atan2(north.y, north.x);
        const std::string words = fmt::format(
            "sky of {} ({} x {} cells, values: {})", *file, sky.azimuths, sky.elevations, *values);
        return StatedShape{table_shape(std::move(sky)), words};
    } catch (const InputError& error) {
        table.reporter().faults.add(error);
        return std::nullopt;
    }
}

}  // namespace quasimc
