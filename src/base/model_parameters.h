#pragma once

#include <string_view>
#include <vector>

namespace quasimc {

/// A model and all numbers that it depends on. Models with equal parameters give equal results.
struct ModelParameters {
    std::string_view model;  ///< a literal
    std::vector<double> values;
    friend bool operator==(const ModelParameters&, const ModelParameters&) = default;
};

}  // namespace quasimc
