#include "fuzzing.h"
#include "io/weather/read_sky_table.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    for (const auto format : {quasimc::SkyFileFormat::cells, quasimc::SkyFileFormat::vlab}) {
        try {
            static_cast<void>(
                quasimc::read_sky_table(text, "sky.txt", format, quasimc::SkyValues::flux));
        } catch (const quasimc::InputError&) {  // most inputs are faulty
        }
    }
    return 0;
}
