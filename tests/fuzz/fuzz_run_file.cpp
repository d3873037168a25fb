#include "fuzzing.h"
#include "readers.h"
#include "runfile/run_file.h"

void quasimc::fuzz::fuzz_run_file(const std::string& bytes) {
    const InputFiles files("/fuzz", read_small_file);
    try {
        static_cast<void>(read_sweep_document(
            read_toml(bytes, "run.toml"), "run.toml", [files] { return files; }));
    } catch (const InputError&) {  // most inputs are faulty
    }
}
