#pragma once

#include <memory>

#include "sources/source.h"

namespace quasimc {

/// A source with its light times a factor, 0 or more; the source itself for 1.
[[nodiscard]] std::shared_ptr<const Source> make_dimmed(
    std::shared_ptr<const Source> source, double factor);

}  // namespace quasimc
