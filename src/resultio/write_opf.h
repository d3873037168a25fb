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

/// Writes an OPF file anew, with numbers as attributes of the nodes that organs were made of: those
/// whose id and class are an organ's. Attributes of the same names that were there before are
/// replaced; numbers that are not known are left out; all else stays, but for how quotes and
/// entities are written.
/// @param bytes  of the file
/// @throws InputError  if it is no XML, or no organ is found in it
OpfMatches write_opf(std::string_view bytes, const FieldScene& shown, const TextSink& sink);

}  // namespace quasimc
