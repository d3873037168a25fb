#pragma once

#include <string>
#include <vector>

#include "view/axis.h"
#include "view/canvas.h"

namespace quasimc {

/// A value on two axes, with the ends of its confidence intervals; NaN: none.
struct ChartPoint {
    double x = 0, y = 0;
    double x_low, x_high, y_low, y_high;
};

/// How points are drawn.
enum class ChartMarks {
    dots,
    line,     ///< from point to point
    columns,  ///< from the x axis up to each point, side by side
    curve,    ///< through the points, which are not drawn
};

struct ChartSeries {
    ChartMarks marks = ChartMarks::dots;
    Rgb color;
    std::vector<ChartPoint> points;
    std::string name = {};  ///< told beside its colour; empty: not told
};

struct Chart {
    std::string title, subtitle;
    Axis x, y;
    std::vector<ChartSeries> series;
};

/// Draws a chart that fills a canvas of this size. Points without a number are left out.
void draw_chart(Canvas& canvas, const Chart& chart, double width, double height);

}  // namespace quasimc
