#include "fuzzing.h"
#include "readers.h"
#include "resultio/read_result.h"

void quasimc::fuzz::fuzz_result(const std::string& bytes) {
    try {
        static_cast<void>(
            read_result_text(bytes, "result.json", "/fuzz", {.read = read_small_file}));
    } catch (const InputError&) {  // most inputs are faulty
    }
}
