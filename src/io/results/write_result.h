#pragma once

#include <string>
#include <vector>

#include "io/runfile/run_file.h"
#include "io/text_sink.h"
#include "results/result.h"

namespace quasimc {

/// Writes the table of organs: comment lines that begin with '#', one header line, one row per
/// organ (docs/formats/csv.md).
void write_csv(const RunFile& run, const Result& result, const TextSink& sink);

/// Writes everything that is known of a run and its result (docs/formats/json.md).
/// @returns the SHA-256 of the organs' part, by which two results are compared
std::string write_json(const RunFile& run, const Result& result, const TextSink& sink);

/// The SHA-256 of the organs' part of write_json.
[[nodiscard]] std::string digest_of_organs(const RunFile& run, const Result& result);

/// What a person wants to know at once: ten lines or so.
/// @param written  the files that were written
[[nodiscard]] std::string summary(
    const RunFile& run, const Result& result, const std::vector<std::string>& written);

}  // namespace quasimc
