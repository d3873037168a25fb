#include "fuzzing.h"
#include "io/runfile/run_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    const quasimc::InputFiles files("/fuzz", quasimc::fuzz::read_small_file);
    try {
        static_cast<void>(quasimc::read_sweep_document(
            quasimc::read_toml(text, "run.toml"), "run.toml", [files] { return files; }));
    } catch (const quasimc::InputError&) {  // most inputs are faulty
    }
    return 0;
}
