#pragma once

#include <cstddef>
#include <string_view>

#include "quasimc/error.h"
#include "resultio/field_formats.h"

namespace quasimc {

/// How many organs of a scene were found in an OPF file.
struct OpfMatches {
    std::size_t found = 0, missing = 0;
};

/// Writes an OPF file anew, with numbers as attributes of the nodes whose id and class are
/// an organ's. Existing attributes of the same names are replaced, unknown numbers are left out.
/// Everything else is unchanged, apart from the spelling of quotes and entities.
/// @param bytes  content of the file
/// @throws InputError  if it is no XML, or no organ is found in it
OpfMatches write_opf(std::string_view bytes, const FieldScene& shown, const TextSink& sink);

}  // namespace quasimc
