#include "fuzzing.h"
#include "io/weather/read_ies.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    quasimc::Reporter reporter{"file", {}, {}};
    static_cast<void>(quasimc::read_ies(std::string(data, data + size), reporter));
    return 0;
}
