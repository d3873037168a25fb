#pragma once

#include <string>

#include "quasimc/error.h"
#include "quasimc/result_file.h"
#include "runfile/output_catalogue.h"

namespace quasimc {

/// What the writer of an output is made from.
struct OutputInput {
    const RunFile& run;      ///< the first of a sweep
    TextSink sink;           ///< of the file
    std::string path = {};   ///< of the file
    std::string where = {};  ///< where the path was given, for messages: "--csv"
};

}  // namespace quasimc
