#pragma once

#include <string>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {

inline constexpr const char* kSite = "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n";

/// A run file with [time], without a [[source]].
inline std::string with_time(const std::string& keys, const std::string& site = kSite) {
    RunText text;
    text.sources = "";
    text.rest = site + "[time]\n" + keys;
    return text.text();
}

/// All of its warnings, a line each.
inline std::string all_warnings(const RunFile& run) {
    std::string all;
    for (const Warning& warning : run.warnings) {
        all += warning.where + ": " + warning.text + "\n";
    }
    return all;
}

}  // namespace quasimc::test
