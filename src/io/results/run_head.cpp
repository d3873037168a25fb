#include "io/results/run_head.h"

#include "io/results/json_parts.h"

namespace quasimc {

std::string head_of_run(const RunFile& run) {
    JsonStream json;
    json.begin_object(JsonLayout::rows);
    json_head(json, run);
    json.end_object();
    return json.take();
}

std::string number_bytes(std::uint64_t number) {
    return {reinterpret_cast<const char*>(&number), sizeof number};
}

}  // namespace quasimc
