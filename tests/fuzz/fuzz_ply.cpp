#include "fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    quasimc::fuzz::read_geometry_bytes("ply", data, size);
    return 0;
}
