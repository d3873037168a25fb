#pragma once

#include <vector>

#include "window/window_data.h"
#include "window/window_site.h"

namespace quasimc {

/// The files of the points of a sweep, or of a single result: those of the first one under their
/// own names, those of point K, from 0, as "point-K-NAME".
[[nodiscard]] WindowFiles files_of_sweep(std::vector<WindowData> points);

}  // namespace quasimc
