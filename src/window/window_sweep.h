#pragma once

#include <cstddef>
#include <functional>

#include "window/window_data.h"
#include "window/window_site.h"

namespace quasimc {

/// Reads a point of a sweep, from 0.
using ReadPoint = std::function<WindowData(std::size_t point)>;

/// The files of a sweep with results: those of a shown point under their own names, those of point
/// K as "point-K-NAME". Points are read when a page requests them, and the last few are kept. For
/// one thread.
/// @param points  number of points
/// @param shown  the point whose files have their own names
[[nodiscard]] WindowFiles files_of_sweep(std::size_t points, std::size_t shown, ReadPoint read);

}  // namespace quasimc
