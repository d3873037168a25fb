#include <string>

#include <fmt/format.h>

#include "options/options.h"
#include "runfile/output_catalogue.h"
#include "runfile/run_file.h"

namespace quasimc {
namespace {

constexpr const char* kBeforeOptions =
    R"(# A run of QuasiMC. Every option stands here with its default; what is marked "example" has none.
# Light on a canopy: quasimc run FILE.    Just check it: quasimc check FILE.

format = 1
title = ""
up = "z"                    # or "y"
north = [0, 1, 0]           # azimuth is counted from here, clockwise seen from above
length_unit = "m"           # of all coordinates; a name for the headers
irradiance_unit = "W m-2"   # or "umol m-2 s-1"; a name for the headers
bands = ["PAR"]             # example; or [[band]] with name and unit

)";

constexpr const char* kOutputs = R"(
[output]                    # example; relative to this file
csv = "result.csv"
json = "result.json"
)";

/// Names of the other outputs.
std::string other_outputs() {
    std::string names;
    for (const OutputKey& key : output_keys()) {
        if (key.name != "csv" && key.name != "json") {
            names += fmt::format("{}{}", names.empty() ? "" : ", ", key.name);
        }
    }
    return fmt::format("# or {}: quasimc list outputs\n", names);
}

constexpr const char* kAfterOutputs = R"(
[[source]]                  # example
type = "directional"
name = "sun"
direction = [0, 0, -1]      # in which the light travels; or azimuth_deg and elevation_deg of the sun
irradiance_facing = 1       # on a plane that faces it; or irradiance_horizontal

[[source]]                  # example
type = "uniform_sky"
irradiance_horizontal = [0.5]

[site]                      # example; for sources with a time
latitude_deg = 50.1         # north positive
longitude_deg = 8.7         # east positive
elevation_m = 0
temperature_c = 12          # yearly mean, for refraction; pressure_hpa: default by elevation

[[source]]                  # example
type = "sun"
time = "2024-06-21T12:00:00+02:00"  # or azimuth_deg and elevation_deg
disk = false                # true: of its true size
irradiance_facing = 1       # or irradiance_horizontal

[[source]]                  # example
type = "sky"
model = "cie_clear"         # quasimc list skies
irradiance_horizontal = [0.2]

# [[source]]                # example of a lamp; see docs/reference/run-file.md for the others
# type = "point"
# position = [0, 0, 3]
# power = 60                # W, or photon_flux in umol s-1 for bands in umol m-2 s-1

# [time]                    # example: sun and sky of every hour of a day; needs [site]
# day = "2024-06-21"        # or from and to, or times, or weather = "file.epw"
# utc_offset_hours = 1
# sun_step_minutes = 5

[[material]]                # example
name = "leaf"
reflectance = 0.1           # one number for all bands, or one for each: [0.1, 0.45]
transmittance = 0.1
reflection_model = "lambertian"
transmission_model = "lambertian"

[[material]]                # example
name = "soil"
reflectance = 0.15

[ground]                    # example
material = "soil"
height = 0

[[organ]]                   # example; organs from files: [[geometry]]
id = 1
name = "leaf 1"
labels = { plant = "1", kind = "leaf" }
measured = true             # false: it shades, but paths traced from organs spare it
material = "leaf"
shape = "rhombus"
base = [0, 0, 0.5]
length = [0.2, 0, 0]
up = [0, 0, 1]
width = 0.05
)";

}  // namespace

std::string default_run_file() {
    return kBeforeOptions + default_run_section() + kOutputs + other_outputs() + kAfterOutputs;
}

}  // namespace quasimc
