#pragma once

#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

struct NamedFile;  // growth/view/view_lines.h

/// A function of one variable, drawn by hand as a clamped cubic B-spline.
struct PlantFunction {
    std::vector<double> x, y;   ///< control points
    std::vector<double> table;  ///< values at i / (size - 1), if it is sampled

    /// The value at a number; 0 for an empty function. @param at  clamped to 0 to 1
    [[nodiscard]] double value(double at) const;
};

/// A curve in space, by length.
struct PlantCurve {
    std::vector<Vec3> points;     ///< control points of a uniform cubic B-spline
    std::vector<double> lengths;  ///< up to each sample
    double length = 0;            ///< the total

    /// The point at a fraction of the length; 0 for an empty curve. @param t  clamped to 0 to 1
    [[nodiscard]] Vec3 at(double t) const;
};

struct ContourPoint {
    double x = 0, y = 0;
};

/// Cross-section of a generalized cylinder, a uniform cubic B-spline.
struct Contour {
    std::vector<Vec3> points;  ///< control points, z = 0, repeated by their multiplicity
    bool is_open = false;

    /// Points at equal lengths, one more than the sides; none without control points.
    [[nodiscard]] std::vector<ContourPoint> divided(int sides) const;
};

/// Reads one function. @param samples  those of the view file; 0: those of the function's file
/// @throws InputError
[[nodiscard]] PlantFunction read_function_file(const NamedFile& file, int samples);
/// Reads a set of functions. @throws InputError
[[nodiscard]] std::vector<PlantFunction> read_function_set_file(const NamedFile& file);
/// Reads a curve; a contour gives an empty one. @param samples  at least 2. @throws InputError
[[nodiscard]] PlantCurve read_curve_file(const NamedFile& file, int samples);
/// Reads a contour. It has at least 3 points if it is closed, 4 if it is open. @throws InputError
[[nodiscard]] Contour read_contour_file(const NamedFile& file);

}  // namespace quasimc
