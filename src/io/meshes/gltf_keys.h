#pragma once

#include "io/runfile/document.h"
#include "io/runfile/table_reader.h"

namespace quasimc {

/// Warns of keys that glTF 2.0 does not have, where geometry is stated: a misspelled "translation"
/// would be passed over.
void warn_of_unknown_keys(const Node& root, Reporter& reporter);

}  // namespace quasimc
