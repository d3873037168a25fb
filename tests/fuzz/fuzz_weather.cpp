#include "fuzzing.h"
#include "readers.h"
#include "weather/weather.h"

void quasimc::fuzz::fuzz_weather(const std::string& bytes) {
    Reporter reporter{"file", {}, {}};
    static_cast<void>(read_epw(bytes, reporter));
    static_cast<void>(read_weather_csv(bytes, {}, reporter));
}
