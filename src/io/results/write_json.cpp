#include <fmt/format.h>

#include "io/results/json_parts.h"
#include "io/results/write_result.h"
#include "io/sha256.h"

namespace quasimc {
namespace {

/// Writes the list of organs and returns its digest.
std::string write_organs(const RunFile& run, const Result& result, const TextSink& sink) {
    const JsonNames names = json_names(run);
    Sha256 digest;
    const std::vector<Organ>& organs = run.scene.organs();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        std::string line = json_organ(organs[i], result, i, names);
        line += i + 1 < organs.size() ? ",\n" : "\n";
        digest.add(line);
        sink(line);
    }
    return digest.hex();
}

}  // namespace

std::string write_json(const RunFile& run, const Result& result, const TextSink& sink) {
    sink("{\n");
    sink(json_head(run));
    sink(json_result_head(run, result));
    sink(json_warnings(run));
    sink("\"organs\": [\n");
    std::string digest = write_organs(run, result, sink);
    sink(fmt::format("],\n\"organs_sha256\": \"{}\"\n}}\n", digest));
    return digest;
}

std::string digest_of_organs(const RunFile& run, const Result& result) {
    return write_organs(run, result, [](std::string_view) {});
}

}  // namespace quasimc
