// The entry of libFuzzer. The name of the program tells what is fuzzed: quasimc_fuzz_ies is a link
// to quasimc_fuzz, which holds every reader.

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "readers.h"

namespace {

quasimc::fuzz::FuzzedReader reader_of_program() {
    constexpr std::string_view kPrefix = "quasimc_fuzz_";
    const std::string_view name = program_invocation_short_name;
    return quasimc::fuzz::find_reader(
        name.starts_with(kPrefix) ? name.substr(kPrefix.size()) : name);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const quasimc::fuzz::FuzzedReader reader = reader_of_program();
    reader.read(std::string(data, data + size));
    return 0;
}
