#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "command_line.h"
#include "picture/scene_picture.h"
#include "quasimc/quasimc.h"

/// How to draw, as given on the command line.
struct ViewArguments {
    std::string view = "200,20", size = "1200x900", background = "white";
    std::string colors = "viridis", range, cuts;
    double opening = 0;
    std::size_t threads = 0;
    bool bare = false;
};

/// The flags for drawing.
[[nodiscard]] std::vector<Flag> view_flags(ViewArguments& arguments);

/// The ends of the colour scale; equal ones: automatic.
[[nodiscard]] std::pair<double, double> range_of(
    const ViewArguments& arguments, quasimc::Faults& faults);
/// Sets size, camera, clipping planes and annotations.
/// @param axes  of the file, for clipping planes
void set_view(
    const ViewArguments& arguments,
    const quasimc::Orientation& axes,
    quasimc::ScenePicture& picture,
    quasimc::Faults& faults);
