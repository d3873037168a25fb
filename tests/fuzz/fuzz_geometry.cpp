// A reader of geometry against anything; compiled once for each format of the table.

#include "fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    quasimc::fuzz::read_geometry_bytes(QUASIMC_FUZZ_FORMAT, data, size);
    return 0;
}
