#include "fuzzing.h"
#include "io/weather/read_ies.h"
#include "readers.h"

void quasimc::fuzz::fuzz_ies(const std::string& bytes) {
    Reporter reporter{"file", {}, {}};
    static_cast<void>(read_ies(bytes, reporter));
}
