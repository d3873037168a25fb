#pragma once

namespace quasimc {

/// The range of a number, ends included.
struct Range {
    double low, high;
};

}  // namespace quasimc
