#include "parallel/run_head.h"

#include <nlohmann/json.hpp>

#include "resultio/json_parts.h"

namespace quasimc {

std::string head_of_run(const RunFile& run) {
    return json_text(json_head(run));
}

std::string number_bytes(std::uint64_t number) {
    return {reinterpret_cast<const char*>(&number), sizeof number};
}

}  // namespace quasimc
