#include "scene/organ_areas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "base/lazy.h"

namespace quasimc {

namespace {

/// Position of a number among increasing sums: the first sum beyond it, and the fraction within it.
struct CdfInterval {
    std::uint32_t number = 0;
    double before = 0;    ///< the sum before it
    double fraction = 0;  ///< within the interval, 0 to 1
};

CdfInterval interval_at(std::span<const double> until, double pick) {
    const auto last = static_cast<std::ptrdiff_t>(until.size()) - 1;
    const auto i = static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(
        std::upper_bound(until.begin(), until.end(), pick) - until.begin(), last));
    const double before = i == 0 ? 0 : until[i - 1];
    const double own = until[i] - before;
    return {i, before, own > 0 ? std::clamp((pick - before) / own, 0.0, 1.0) : 0};
}

/// The metric of an affine map: the products of its columns, as fractions of their sum of squares,
/// in steps of 1e-12. Maps with equal metrics change all areas by the ratio of their square_size().
using LinearPart = std::array<std::int64_t, 6>;

double square_size(const Affine& a) {
    return dot(a.rows[0], a.rows[0]) + dot(a.rows[1], a.rows[1]) + dot(a.rows[2], a.rows[2]);
}

LinearPart linear_part_of(const Affine& a) {
    const auto product = [&](double Vec3::*i, double Vec3::*j) {
        double sum = 0;
        for (const Vec3& row : a.rows) {
            sum += row.*i * row.*j;
        }
        constexpr double kSteps = 1e12;
        return std::llround(kSteps * sum / square_size(a));
    };
    return {product(&Vec3::x, &Vec3::x), product(&Vec3::y, &Vec3::y), product(&Vec3::z, &Vec3::z),
            product(&Vec3::x, &Vec3::y), product(&Vec3::y, &Vec3::z), product(&Vec3::z, &Vec3::x)};
}

/// Sums over the triangles of an instance, for a map of square_size 1.
std::vector<double> sums_of(const Instance& instance) {
    std::vector<double> until;
    until.reserve(instance.mesh->size());
    double sum = 0;
    for (std::size_t i = 0; i < instance.mesh->size(); ++i) {
        until.push_back(sum += area(instance.triangle(i)) / square_size(instance.transform));
    }
    return until;
}

}  // namespace

OrganAreas::OrganAreas(
    std::shared_ptr<const SceneGeometry> geometry, const std::vector<Organ>& organs)
    : geometry_(std::move(geometry)) {
    const std::size_t own = geometry_->mesh().size();
    until_.reserve(own);
    for (std::size_t i = 0; i < own; ++i) {
        until_.push_back(area(geometry_->mesh()[i]));
    }
    // All copies of a mesh with the same metric share the fractions of their triangles.
    std::map<std::pair<const Mesh*, LinearPart>, std::uint32_t> known;
    for (const Instance& instance : geometry_->instances()) {
        const auto [shape, is_new] = known.try_emplace(
            {instance.mesh.get(), linear_part_of(instance.transform)},
            static_cast<std::uint32_t>(mesh_until_.size()));
        if (is_new) {
            mesh_until_.push_back(sums_of(instance));
        }
        sums_.push_back(shape->second);
    }
    instance_until_.resize(sums_.size());
    for (const Organ& organ : organs) {
        sum_within(organ);
    }
}

void OrganAreas::sum_within(const Organ& organ) {
    const std::size_t own = until_.size();
    const std::size_t end = std::size_t{organ.first_triangle} + organ.triangle_count;
    double sum = 0;
    for (std::size_t i = organ.first_triangle; i < end && i < own; ++i) {
        until_[i] = sum += until_[i];
    }
    for (std::size_t i = organ.first_triangle; i < end && i >= own;) {
        const std::uint32_t k = geometry_->ranges().find(static_cast<std::uint32_t>(i));
        instance_until_[k] = sum +=
            mesh_until_[sums_[k]].back() * square_size(geometry_->instances()[k].transform);
        i += geometry_->ranges().count(k);
    }
}

OrganAreas::Pick OrganAreas::pick(const Organ& organ, double area) const {
    if (organ.first_triangle >= until_.size()) {
        return pick_of_instances(organ, area);
    }
    const CdfInterval interval =
        interval_at(std::span(until_).subspan(organ.first_triangle, organ.triangle_count), area);
    return {organ.first_triangle + interval.number, interval.fraction};
}

OrganAreas::Pick OrganAreas::pick_of_instances(const Organ& organ, double area) const {
    const RangeIndex& ranges = geometry_->ranges();
    const std::uint32_t first = ranges.find(organ.first_triangle);
    const std::uint32_t last = ranges.find(organ.first_triangle + organ.triangle_count - 1);
    const CdfInterval instance =
        interval_at(std::span(instance_until_).subspan(first, last - first + 1), area);
    const std::uint32_t k = first + instance.number;
    const std::vector<double>& until = mesh_until_[sums_[k]];
    const CdfInterval interval = interval_at(until, instance.fraction * until.back());
    return {ranges.first(k) + interval.number, interval.fraction};
}

const OrganAreas& organ_areas(const Scene& scene) {
    const SceneData& data = data_of(scene);
    return data.areas->get([&] { return OrganAreas(data.geometry, scene.organs()); });
}

}  // namespace quasimc
