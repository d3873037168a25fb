#include "fuzzing.h"
#include "io/results/read_result.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    try {
        static_cast<void>(quasimc::read_result_text(
            text, "result.json", "/fuzz", {.read = quasimc::fuzz::read_small_file}));
    } catch (const quasimc::InputError&) {  // most inputs are faulty
    }
    return 0;
}
