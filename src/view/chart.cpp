#include "view/chart.h"

#include <algorithm>
#include <cmath>

namespace quasimc {
namespace {

constexpr Rgb kLines{90, 90, 90};
constexpr Rgb kGrid{225, 225, 225};

/// Draws into the rectangle between the axes.
class ChartPlot {
  public:
    ChartPlot(Canvas& canvas, const Chart& chart, double width, double height)
        : canvas_(canvas),
          chart_(chart),
          scale_(std::clamp(std::min(width, height) / 900, 0.5, 8.0)),
          left_(95 * scale_),
          right_(width - 30 * scale_),
          top_(75 * scale_),
          bottom_(height - 70 * scale_) {}

    void draw_words() {
        canvas_.text({18 * scale_, 28 * scale_}, chart_.title, {.size = 20 * scale_});
        canvas_.text(
            {18 * scale_, 50 * scale_}, chart_.subtitle, {.size = 14 * scale_, .color = kLines});
        canvas_.text(
            {0.5 * (left_ + right_), bottom_ + 52 * scale_}, chart_.x.title,
            {.size = 15 * scale_, .anchor = TextAnchor::middle});
        canvas_.text(
            {26 * scale_, 0.5 * (top_ + bottom_)}, chart_.y.title,
            {.size = 15 * scale_, .anchor = TextAnchor::middle, .upwards = true});
    }

    void draw_axes() {
        const std::vector<double> columns = ticks_of(chart_.x, 8), rows = ticks_of(chart_.y, 7);
        const std::vector<std::string> below = texts_of(chart_.x, columns);
        const std::vector<std::string> beside = texts_of(chart_.y, rows);
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double x = place(columns[i], chart_.y.low).x;
            canvas_.line({x, top_}, {x, bottom_}, kGrid, scale_);
            canvas_.text(
                {x, bottom_ + 20 * scale_}, below[i],
                {.size = 13 * scale_, .anchor = TextAnchor::middle});
        }
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double y = place(chart_.x.low, rows[i]).y;
            canvas_.line({left_, y}, {right_, y}, kGrid, scale_);
            canvas_.text(
                {left_ - 8 * scale_, y + 4.5 * scale_}, beside[i],
                {.size = 13 * scale_, .anchor = TextAnchor::end});
        }
        canvas_.line({left_, bottom_}, {right_, bottom_}, kLines, scale_);
        canvas_.line({left_, top_}, {left_, bottom_}, kLines, scale_);
    }

    /// Colours and names of series, at the top right.
    void draw_names() {
        const double column = right_ - 330 * scale_;
        double y = top_ + 20 * scale_;
        for (const ChartSeries& series : chart_.series) {
            if (series.name.empty()) {
                continue;
            }
            const PixelPlace from{column, y - 5 * scale_}, to{column + 22 * scale_, y - 5 * scale_};
            if (series.marks == ChartMarks::dots) {
                canvas_.disk({0.5 * (from.x + to.x), from.y}, 3.5 * scale_, series.color);
            } else {
                canvas_.line(from, to, series.color, 2 * scale_);
            }
            canvas_.text({column + 30 * scale_, y}, series.name, {.size = 14 * scale_});
            y += 20 * scale_;
        }
    }

    void draw(const ChartSeries& series) {
        if (series.marks == ChartMarks::columns) {
            draw_columns(series);
        } else if (series.marks == ChartMarks::curve) {
            canvas_.polyline(places_of(series), series.color, 2 * scale_);
        } else if (series.marks == ChartMarks::line) {
            draw_line(series);
        } else {
            for (const ChartPoint& point : series.points) {
                draw_errors(point, series.color);
                if (std::isfinite(point.x) && std::isfinite(point.y)) {
                    canvas_.disk(place(point.x, point.y), 3.5 * scale_, series.color);
                }
            }
        }
    }

  private:
    [[nodiscard]] PixelPlace place(double x, double y) const {
        return {
            left_ + (right_ - left_) * chart_.x.part(x),
            bottom_ - (bottom_ - top_) * chart_.y.part(y)};
    }
    /// A place no further than the ends of the axes.
    [[nodiscard]] PixelPlace place_within(double x, double y) const {
        return place(
            std::clamp(x, chart_.x.low, chart_.x.high), std::clamp(y, chart_.y.low, chart_.y.high));
    }

    void draw_errors(const ChartPoint& p, const Rgb& color) {
        const Rgb faint = mixed(color, {255, 255, 255}, 0.5);
        if (std::isfinite(p.x_low) && std::isfinite(p.x_high)) {
            canvas_.line(
                place_within(p.x_low, p.y), place_within(p.x_high, p.y), faint, 1.5 * scale_);
        }
        if (std::isfinite(p.y_low) && std::isfinite(p.y_high)) {
            canvas_.line(
                place_within(p.x, p.y_low), place_within(p.x, p.y_high), faint, 1.5 * scale_);
        }
    }

    /// Of the points that have one.
    [[nodiscard]] std::vector<PixelPlace> places_of(const ChartSeries& series) const {
        std::vector<PixelPlace> places;
        for (const ChartPoint& point : series.points) {
            if (std::isfinite(point.x) && std::isfinite(point.y)) {
                places.push_back(place(point.x, point.y));
            }
        }
        return places;
    }

    void draw_line(const ChartSeries& series) {
        for (const ChartPoint& point : series.points) {
            draw_errors(point, series.color);
        }
        const std::vector<PixelPlace> places = places_of(series);
        for (const PixelPlace& at : places) {
            canvas_.disk(at, 3 * scale_, series.color);
        }
        canvas_.polyline(places, series.color, 2 * scale_);
    }

    /// Each as wide as the first two are apart.
    void draw_columns(const ChartSeries& series) {
        const auto& points = series.points;
        const double wide = points.size() > 1 ? points[1].x - points[0].x : 1;
        for (const ChartPoint& point : points) {
            const PixelPlace a = place(point.x - 0.48 * wide, point.y);
            const PixelPlace b = place(point.x + 0.48 * wide, std::max(0.0, chart_.y.low));
            if (std::isfinite(point.y) && b.y > a.y) {
                canvas_.rectangle(a, b.x - a.x, b.y - a.y, series.color);
            }
        }
    }

    Canvas& canvas_;
    const Chart& chart_;
    double scale_, left_, right_, top_, bottom_;
};

}  // namespace

void draw_chart(Canvas& canvas, const Chart& chart, double width, double height) {
    ChartPlot plot(canvas, chart, width, height);
    plot.draw_axes();
    for (const ChartSeries& series : chart.series) {
        plot.draw(series);
    }
    plot.draw_words();
    plot.draw_names();
}

}  // namespace quasimc
