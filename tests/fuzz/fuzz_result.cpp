#include "fuzzing.h"
#include "io/results/read_result.h"
#include "readers.h"

void quasimc::fuzz::fuzz_result(const std::string& bytes) {
    try {
        static_cast<void>(
            read_result_text(bytes, "result.json", "/fuzz", {.read = read_small_file}));
    } catch (const InputError&) {  // most inputs are faulty
    }
}
