// Compiled once for each vector unit: foreach_target.h includes this file repeatedly.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/triangle_block.cpp"
#include "raster/triangle_block.h"

#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quasimc {
namespace HWY_NAMESPACE {
namespace {

// Products and sums, not MulAdd, which rounds differently on machines with a fused one.
namespace hn = hwy::HWY_NAMESPACE;
using Numbers = hn::CappedTag<double, kBlockLanes>;
using Vector = hn::Vec<Numbers>;
using Wholes = hn::Rebind<std::int32_t, Numbers>;
constexpr Numbers kNumbers;

/// One coordinate of a corner, for some lanes.
Vector coordinate(
    const TriangleBlock& corners, std::size_t corner, const BeamAxis& axis, std::size_t lane) {
    const auto times = [&](std::size_t i, double along) {
        return hn::Mul(hn::Set(kNumbers, along), hn::Load(kNumbers, &corners.at[corner][i][lane]));
    };
    const auto sum =
        hn::Add(hn::Add(times(0, axis.along.x), times(1, axis.along.y)), times(2, axis.along.z));
    return hn::Add(sum, hn::Set(kNumbers, axis.offset));
}

/// A corner in grid coordinates.
struct Corner {
    Vector x, y;
};

/// Puts the lower one first.
void order(Corner& a, Corner& b) {
    const auto swap = hn::Lt(b.y, a.y);
    const Corner lower{hn::IfThenElse(swap, b.x, a.x), hn::IfThenElse(swap, b.y, a.y)};
    b = {hn::IfThenElse(swap, a.x, b.x), hn::IfThenElse(swap, a.y, b.y)};
    a = lower;
}

Vector slope(const Corner& from, const Corner& to) {
    return hn::Div(hn::Sub(to.x, from.x), hn::Sub(to.y, from.y));
}

void set_sides(Corner low, Corner middle, Corner high, std::size_t lane, BlockSpans& spans) {
    order(low, middle);
    order(middle, high);
    order(low, middle);
    hn::Store(low.x, kNumbers, spans.low_x + lane);
    hn::Store(low.y, kNumbers, spans.low_y + lane);
    hn::Store(middle.x, kNumbers, spans.middle_x + lane);
    hn::Store(middle.y, kNumbers, spans.middle_y + lane);
    hn::Store(slope(low, high), kNumbers, spans.slope_long + lane);
    hn::Store(slope(low, middle), kNumbers, spans.slope_low + lane);
    hn::Store(slope(middle, high), kNumbers, spans.slope_high + lane);
}

/// Two sides of a triangle from its first corner, in grid coordinates: like TrianglePlane.
struct Plane {
    Vector ax, ay, bx, by, x, y, per_area;

    void store(Vector first, Vector a, Vector b, std::size_t lane, BlockGradient& to) const {
        const auto by_x = hn::Mul(hn::Sub(hn::Mul(a, by), hn::Mul(b, ay)), per_area);
        const auto by_y = hn::Mul(hn::Sub(hn::Mul(b, ax), hn::Mul(a, bx)), per_area);
        hn::Store(
            hn::Sub(hn::Sub(first, hn::Mul(by_x, x)), hn::Mul(by_y, y)), kNumbers, to.at + lane);
        hn::Store(by_x, kNumbers, to.by_x + lane);
        hn::Store(by_y, kNumbers, to.by_y + lane);
    }
};

void set_depths(
    const Plane& plane, const Vector (&depths)[3], std::size_t lane, BlockSpans& spans) {
    plane.store(
        depths[0], hn::Sub(depths[1], depths[0]), hn::Sub(depths[2], depths[0]), lane, spans.depth);
    hn::Store(plane.x, kNumbers, spans.first_x + lane);
    hn::Store(plane.y, kNumbers, spans.first_y + lane);
    hn::Store(depths[0], kNumbers, spans.first_depth + lane);
    hn::Store(hn::Min(depths[0], hn::Min(depths[1], depths[2])), kNumbers, spans.low_depth + lane);
    hn::Store(hn::Max(depths[0], hn::Max(depths[1], depths[2])), kNumbers, spans.high_depth + lane);
}

void set_barycentric(const Plane& plane, std::size_t lane, BlockSpans& spans) {
    const auto zero = hn::Zero(kNumbers);
    const auto one = hn::Set(kNumbers, 1.0);
    plane.store(zero, one, zero, lane, spans.u);
    plane.store(zero, zero, one, lane, spans.v);
}

/// A number of lines for each period. @param periods  of some lanes
Vector lines_of(const std::int32_t* periods, std::int64_t lines) {
    return hn::Mul(
        hn::PromoteTo(kNumbers, hn::Load(Wholes(), periods)),
        hn::Set(kNumbers, static_cast<double>(lines)));
}

/// set() for some lanes. @returns whether any of them touches a row
bool set_lanes(
    const TriangleBlock& corners,
    const BlockPeriods& periods,
    const RasterGrid& grid,
    std::size_t lane,
    BlockSpans& spans) {
    Corner at[3];
    Vector depths[3];
    const Corner moved{
        lines_of(periods.x + lane, grid.columns), lines_of(periods.y + lane, grid.rows)};
    for (std::size_t i = 0; i < 3; ++i) {
        at[i] = {
            hn::Sub(coordinate(corners, i, grid.x, lane), moved.x),
            hn::Sub(coordinate(corners, i, grid.y, lane), moved.y)};
        depths[i] = coordinate(corners, i, grid.z, lane);
    }
    auto row = hn::Ceil(hn::Min(at[0].y, hn::Min(at[1].y, at[2].y)));
    auto end = hn::Ceil(hn::Max(at[0].y, hn::Max(at[1].y, at[2].y)));
    if (!grid.repeats_y) {
        row = hn::Max(row, hn::Zero(kNumbers));
        end = hn::Min(end, hn::Set(kNumbers, static_cast<double>(grid.rows)));
    }
    const auto ax = hn::Sub(at[1].x, at[0].x);
    const auto ay = hn::Sub(at[1].y, at[0].y);
    const auto bx = hn::Sub(at[2].x, at[0].x);
    const auto by = hn::Sub(at[2].y, at[0].y);
    const auto twice_area = hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
    // Corners have single precision: thinner triangles count as edge-on.
    const auto squares = hn::Add(
        hn::Add(hn::Add(hn::Mul(ax, ax), hn::Mul(ay, ay)), hn::Mul(bx, bx)), hn::Mul(by, by));
    const auto is_wide = hn::Gt(hn::Abs(twice_area), hn::Mul(hn::Set(kNumbers, 0x1p-24), squares));
    end = hn::IfThenElse(is_wide, end, row);
    hn::Store(row, kNumbers, spans.row + lane);
    hn::Store(end, kNumbers, spans.end_row + lane);
    const auto touches = hn::Lt(row, end);
    if (hn::AllFalse(kNumbers, touches)) {
        return false;
    }
    hn::Store(twice_area, kNumbers, spans.twice_area + lane);
    set_sides(at[0], at[1], at[2], lane, spans);
    const Plane plane{
        ax, ay, bx, by, at[0].x, at[0].y, hn::Div(hn::Set(kNumbers, 1.0), twice_area)};
    set_depths(plane, depths, lane, spans);
    if (grid.has_barycentric) {
        set_barycentric(plane, lane, spans);
    }
    return true;
}

bool set_block(
    const TriangleBlock& corners,
    const BlockPeriods& periods,
    const RasterGrid& grid,
    BlockSpans& spans) {
    bool touches = false;
    for (std::size_t lane = 0; lane < kBlockLanes; lane += hn::Lanes(kNumbers)) {
        touches = set_lanes(corners, periods, grid, lane, spans) || touches;
    }
    return touches;
}

/// Sets the periods of some lanes along one axis. @returns whether the first are the last
bool set_periods(
    const TriangleBlock& corners,
    const BeamAxis& axis,
    std::int64_t lines,
    std::size_t lane,
    std::int32_t* first,
    std::int32_t* last) {
    const auto a = coordinate(corners, 0, axis, lane);
    const auto b = coordinate(corners, 1, axis, lane);
    const auto c = coordinate(corners, 2, axis, lane);
    const auto size = hn::Set(kNumbers, static_cast<double>(lines));
    const auto margin = hn::Mul(hn::Set(kNumbers, kPeriodMargin), size);
    const auto period_of = [&](Vector x) {
        const auto most = hn::Set(kNumbers, kMaxPeriods);
        return hn::Floor(hn::Min(hn::Max(hn::Div(x, size), hn::Neg(most)), most));
    };
    const auto low = period_of(hn::Sub(hn::Min(a, hn::Min(b, c)), margin));
    const auto high = period_of(hn::Add(hn::Max(a, hn::Max(b, c)), margin));
    hn::Store(hn::DemoteTo(Wholes(), low), Wholes(), first + lane);
    hn::Store(hn::DemoteTo(Wholes(), high), Wholes(), last + lane);
    return hn::AllTrue(kNumbers, hn::Eq(low, high));
}

bool block_periods(
    const TriangleBlock& corners, const RasterGrid& grid, BlockPeriods& first, BlockPeriods& last) {
    first = last = {};
    bool same = true;
    for (std::size_t lane = 0; lane < kBlockLanes; lane += hn::Lanes(kNumbers)) {
        same = (!grid.repeats_x ||
                set_periods(corners, grid.x, grid.columns, lane, first.x, last.x)) &&
               same;
        same =
            (!grid.repeats_y || set_periods(corners, grid.y, grid.rows, lane, first.y, last.y)) &&
            same;
    }
    return same;
}

/// Three numbers of some lanes, as Vec3.
struct Vectors {
    Vector x, y, z;
};

Vector dot(const Vectors& a, const Vectors& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

Vectors cross(const Vectors& a, const Vectors& b) {
    return {
        hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
        hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
        hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

/// From the first corner of a triangle to another.
Vectors side(const TriangleBlock& corners, std::size_t to, std::size_t lane) {
    const auto along = [&](std::size_t i) {
        return hn::Sub(
            hn::Load(kNumbers, &corners.at[to][i][lane]),
            hn::Load(kNumbers, &corners.at[0][i][lane]));
    };
    return {along(0), along(1), along(2)};
}

void block_cosines(const TriangleBlock& corners, const Vec3& direction, double* to) {
    const Vectors along{
        hn::Set(kNumbers, direction.x), hn::Set(kNumbers, direction.y),
        hn::Set(kNumbers, direction.z)};
    for (std::size_t lane = 0; lane < kBlockLanes; lane += hn::Lanes(kNumbers)) {
        const Vectors up = cross(side(corners, 1, lane), side(corners, 2, lane));
        const auto size = hn::Sqrt(dot(up, up));
        const auto is_seen = hn::Gt(size, hn::Zero(kNumbers));
        const auto cosine = hn::Div(dot(up, along), size);
        hn::StoreU(hn::IfThenElseZero(is_seen, cosine), kNumbers, to + lane);
    }
}

/// x modulo n of whole numbers.
Vector wrapped(Vector x, double n) {
    const auto size = hn::Set(kNumbers, n);
    return hn::Sub(x, hn::Mul(hn::Floor(hn::Div(x, size)), size));
}

/// Sets the spans of the next row of some lanes, as row `i` of the current rows.
void set_row(const RasterGrid& grid, std::size_t i, std::size_t lane, BlockSpans& spans) {
    const auto load = [lane](const double* from) { return hn::Load(kNumbers, from + lane); };
    const auto row = load(spans.row);
    const auto is_row = hn::Lt(row, load(spans.end_row));
    if (hn::AllFalse(kNumbers, is_row)) {
        return;
    }
    const auto in_row = grid.repeats_y ? wrapped(row, static_cast<double>(grid.rows)) : row;
    const auto moved = hn::Mul(in_row, hn::Set(kNumbers, grid.row_shift));
    const auto shift = hn::Sub(moved, hn::Floor(moved));
    const auto low_x = load(spans.low_x);
    const auto middle_y = load(spans.middle_y);
    const auto up = hn::Sub(row, load(spans.low_y));
    const auto along = hn::Add(low_x, hn::Mul(up, load(spans.slope_long)));
    const auto other = hn::IfThenElse(
        hn::Lt(row, middle_y), hn::Add(low_x, hn::Mul(up, load(spans.slope_low))),
        hn::Add(load(spans.middle_x), hn::Mul(hn::Sub(row, middle_y), load(spans.slope_high))));
    auto first = hn::Ceil(hn::Sub(hn::Min(along, other), shift));
    auto last = hn::Ceil(hn::Sub(hn::Max(along, other), shift));
    if (!grid.repeats_x) {
        first = hn::Max(first, hn::Zero(kNumbers));
        last = hn::Min(last, hn::Set(kNumbers, static_cast<double>(grid.columns)));
    }
    const auto is_covered = hn::And(is_row, hn::Lt(first, last));
    const std::size_t at = i * kBlockLanes + lane;
    hn::Store(row, kNumbers, spans.y + at);
    hn::Store(in_row, kNumbers, spans.in_row + at);
    hn::Store(first, kNumbers, spans.first + at);
    hn::Store(last, kNumbers, spans.last + at);
    hn::Store(shift, kNumbers, spans.shift + at);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(kNumbers, is_covered, bits);
    spans.covered[i] |= std::uint32_t{bits[0]} << lane;
    hn::Store(hn::Add(row, hn::Set(kNumbers, 1.0)), kNumbers, spans.row + lane);
}

bool next_rows(const RasterGrid& grid, BlockSpans& spans) {
    double most = 0;
    for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
        const double rows = spans.end_row[lane] - spans.row[lane];
        most = rows > most ? rows : most;
    }
    spans.rows = 0;
    for (; spans.rows < kBlockRows && static_cast<double>(spans.rows) < most; ++spans.rows) {
        spans.covered[spans.rows] = 0;
        for (std::size_t lane = 0; lane < kBlockLanes; lane += hn::Lanes(kNumbers)) {
            set_row(grid, spans.rows, lane, spans);
        }
    }
    return most > 0;
}

/// A quantity along a row, at given columns of the grid.
struct OnRow {
    Vector start, by_x;

    OnRow(const BlockGradient& gradient, std::size_t lane, Vector y)
        : start(hn::Add(
              hn::Load(kNumbers, gradient.at + lane),
              hn::Mul(hn::Load(kNumbers, gradient.by_y + lane), y))),
          by_x(hn::Load(kNumbers, gradient.by_x + lane)) {}

    [[nodiscard]] Vector at(Vector x) const { return hn::Add(start, hn::Mul(by_x, x)); }
};

/// The part of a triangle that contains a point, like TriangleParts::at().
/// @param n  parts along a side
Vector part_at(Vector u, Vector v, Vector n) {
    const auto zero = hn::Zero(kNumbers);
    const auto one = hn::Set(kNumbers, 1.0);
    const auto clamped = [&](Vector x, Vector most) {
        return hn::Min(hn::Floor(hn::Max(x, zero)), most);
    };
    const auto along = hn::Mul(u, n);
    const auto across = hn::Mul(v, n);
    const auto last = hn::Sub(n, one);
    const auto j = clamped(across, last);
    const auto i = clamped(along, hn::Sub(last, j));
    const auto rest = hn::Sub(hn::Add(hn::Sub(along, i), across), j);
    const auto is_turned = hn::And(hn::Gt(rest, one), hn::Lt(hn::Add(i, j), last));
    const auto before = hn::Mul(j, hn::Sub(hn::Add(n, n), j));
    return hn::Add(hn::Add(before, hn::Add(i, i)), hn::IfThenElse(is_turned, one, zero));
}

using Depths = hn::Rebind<float, Numbers>;
using Uints = hn::Rebind<std::uint32_t, Numbers>;

/// The upper half of depth_key().
hn::Vec<Uints> ordered_bits(Vector depth) {
    const auto bits = hn::BitCast(Uints(), hn::DemoteTo(Depths(), depth));
    const auto sign = hn::Set(Uints(), 0x80000000U);
    const auto is_negative = hn::Eq(hn::And(bits, sign), sign);
    return hn::IfThenElse(is_negative, hn::Not(bits), hn::Or(bits, sign));
}

hn::Vec<Uints> to_uints(Vector whole) {
    return hn::BitCast(Uints(), hn::DemoteTo(Wholes(), whole));
}

/// The hits of one line on each of some lanes.
struct SpanHits {
    alignas(64) std::uint32_t lines[kBlockLanes], depths[kBlockLanes], hit[kBlockLanes];

    /// Appends the hits of the lanes whose bit is set.
    std::size_t append(std::uint32_t lanes, std::size_t size, const LineHitArrays& to) const {
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
            to.lines[size] = lines[lane];
            to.keys[size] = std::uint64_t{depths[lane]} << 32U | hit[lane];
            ++size;
        }
        return size;
    }
};

/// Writes the hits on the rows of a block.
class RowHits {
  public:
    RowHits(
        const RasterGrid& grid,
        const BlockSpans& spans,
        const BlockPatches& patches,
        const LineHitArrays& to)
        : grid_(grid), spans_(spans), patches_(patches), to_(to) {}

    [[nodiscard]] std::size_t size() const { return size_; }

    /// Adds the hits on one row of some lanes. @param lanes  requested lanes, bit 0 for `lane`
    void add(std::size_t row, std::size_t lane, std::uint32_t lanes) {
        if (lanes == 0) {
            return;
        }
        const std::size_t at = row * kBlockLanes + lane;
        const auto y = hn::Load(kNumbers, spans_.y + at);
        const auto shift = hn::Load(kNumbers, spans_.shift + at);
        const auto last = hn::Load(kNumbers, spans_.last + at);
        const OnRow depth(spans_.depth, lane, y), u(spans_.u, lane, y), v(spans_.v, lane, y);
        const auto low = hn::Load(kNumbers, spans_.low_depth + lane);
        const auto high = hn::Load(kNumbers, spans_.high_depth + lane);
        const auto n = hn::Load(kNumbers, patches_.parts + lane);
        const auto first_hit = hn::Load(Uints(), patches_.hit + lane);
        const auto columns = static_cast<double>(grid_.columns);
        const auto begin =
            hn::Mul(hn::Load(kNumbers, spans_.in_row + at), hn::Set(kNumbers, columns));
        auto column = hn::Load(kNumbers, spans_.first + at);
        SpanHits hits;
        while (lanes != 0) {
            const auto x = hn::Add(column, shift);
            const auto part = part_at(u.at(x), v.at(x), n);
            const auto in_grid = grid_.repeats_x ? wrapped(column, columns) : column;
            hn::Store(to_uints(hn::Add(begin, in_grid)), Uints(), hits.lines + lane);
            hn::Store(
                ordered_bits(hn::Min(hn::Max(depth.at(x), low), high)), Uints(),
                hits.depths + lane);
            hn::Store(hn::Add(first_hit, to_uints(hn::Add(part, part))), Uints(), hits.hit + lane);
            size_ = hits.append(lanes << lane, size_, to_);
            column = hn::Add(column, hn::Set(kNumbers, 1.0));
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(kNumbers, hn::Lt(column, last), bits);
            lanes &= bits[0];
        }
    }

  private:
    const RasterGrid& grid_;
    const BlockSpans& spans_;
    const BlockPatches& patches_;
    LineHitArrays to_;
    std::size_t size_ = 0;
};

std::size_t write_hits(
    const RasterGrid& grid,
    const BlockSpans& spans,
    const BlockPatches& patches,
    std::uint32_t wanted,
    const LineHitArrays& to) {
    const std::uint32_t all = (1U << hn::Lanes(kNumbers)) - 1;
    RowHits hits(grid, spans, patches, to);
    for (std::size_t row = 0; row < spans.rows; ++row) {
        for (std::size_t lane = 0; lane < kBlockLanes; lane += hn::Lanes(kNumbers)) {
            hits.add(row, lane, (spans.covered[row] & wanted) >> lane & all);
        }
    }
    return hits.size();
}

SpanLoops span_loops() {
    return {&set_block, &block_periods, &block_cosines, &next_rows, &write_hits};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quasimc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quasimc {

HWY_EXPORT(span_loops);

SpanLoops best_span_loops() {
    return HWY_DYNAMIC_DISPATCH(span_loops)();
}

}  // namespace quasimc
#endif
