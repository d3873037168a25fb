#pragma once

#include <map>
#include <vector>

#include "base/notices.h"
#include "files/input_files.h"
#include "growth/language/preprocessor.h"
#include "growth/view/splines.h"
#include "growth/view/surface.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// A tropism, which turns the heading, or a torque, which turns about it.
struct Tropism {
    bool is_torque = false;
    Vec3 direction;         ///< unit; 0: it is off
    double angle_deg = 0;   ///< A
    double intensity = 1;   ///< factor from I and the length of T
    double elasticity = 0;  ///< E
    double step = 0;        ///< S
};

/// Content of a view file, as far as it concerns the plant.
struct View {
    double angle_deg = 45;
    double line_width = 1, line_width_increment = 0;
    double scale = 1, scale_multiplier = 1;
    int color = 128, color_increment = 1;
    int contour_sides = 8;
    std::map<char, BezierSurface> surfaces;
    std::map<int, Contour> contours;
    std::vector<PlantFunction> functions;  ///< func(1, x) is the first
    std::vector<PlantCurve> curves;        ///< curveX(1, t) is of the first
    std::vector<Tropism> tropisms;         ///< and torques, in the order of the file
    Vec3 old_tropism;                      ///< "tropism direction", unit or 0
    double elasticity = 0, elasticity_increment = 0;
    bool interprets_past_cut = true;
    bool passes_before_display = false;  ///< "environment display: before"
    std::optional<Bounds> box;           ///< bounds to be reported instead of the plant's
};

/// Reads a view file and the files that it names, relative to the folder of the file that names
/// them. Missing files and unknown labels give notices only.
/// @param files  has the same base of paths as the names of the files of `text`
/// @throws InputError  with all faults
[[nodiscard]] View read_view(const PreprocessedText& text, InputFiles& files, Notices& notices);

}  // namespace quasimc
