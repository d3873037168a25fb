// A reader of geometry against anything; linked once for each format of the table.

#include "fuzzing.h"

extern const char* const kFuzzedFormat;  // in fuzz_format.cpp

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    quasimc::fuzz::read_geometry_bytes(kFuzzedFormat, data, size);
    return 0;
}
