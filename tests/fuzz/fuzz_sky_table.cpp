#include "fuzzing.h"
#include "readers.h"
#include "weather/read_sky_table.h"

void quasimc::fuzz::fuzz_sky_table(const std::string& bytes) {
    for (const auto format : {SkyFileFormat::cells, SkyFileFormat::vlab}) {
        try {
            static_cast<void>(read_sky_table(bytes, "sky.txt", format, SkyValues::flux));
        } catch (const InputError&) {  // most inputs are faulty
        }
    }
}
