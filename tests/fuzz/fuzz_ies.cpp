#include "fuzzing.h"
#include "readers.h"
#include "weather/read_ies.h"

void quasimc::fuzz::fuzz_ies(const std::string& bytes) {
    Reporter reporter{"file", {}, {}};
    static_cast<void>(read_ies(bytes, reporter));
}
