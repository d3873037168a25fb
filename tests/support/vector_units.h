#pragma once

#include <functional>

namespace quasimc {

/// Calls `test` once for each vector unit that the program is compiled for and this machine has,
/// made the best one for as long: the slowest, of plain words, is always among them.
void for_each_vector_unit(const std::function<void()>& test);

}  // namespace quasimc
