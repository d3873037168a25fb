#include "fuzzing.h"
#include "io/runfile/run_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    quasimc::InputFiles files("/fuzz", quasimc::fuzz::read_small_file);
    try {
        static_cast<void>(quasimc::read_run_text(text, "run.toml", files));
    } catch (const quasimc::InputError&) {  // most inputs are faulty
    }
    return 0;
}
