#include "fuzzing.h"
#include "io/weather/weather.h"
#include "readers.h"

void quasimc::fuzz::fuzz_weather(const std::string& bytes) {
    Reporter reporter{"file", {}, {}};
    static_cast<void>(read_epw(bytes, reporter));
    static_cast<void>(read_weather_csv(bytes, {}, reporter));
}
