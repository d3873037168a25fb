#include "fuzzing.h"
#include "io/weather/weather.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    quasimc::Reporter reporter{"file", {}, {}};
    static_cast<void>(quasimc::read_epw(text, reporter));
    static_cast<void>(quasimc::read_weather_csv(text, {}, reporter));
    return 0;
}
