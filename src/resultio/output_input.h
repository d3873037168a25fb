#pragma once

#include <string>

#include "quasimc/error.h"
#include "quasimc/result_file.h"
#include "runfile/output_catalogue.h"

namespace quasimc {

/// The arguments for making the writer of an output.
struct OutputInput {
    const RunFile& run;                ///< first point in a sweep
    TextSink sink;                     ///< receives the bytes of the file
    std::string path = {};             ///< path of the file
    std::string where = {};            ///< where the path was given, for messages: "--csv"
    const TableSpec* table = nullptr;  ///< for make_table
};

}  // namespace quasimc
