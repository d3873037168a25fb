#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "quasimc/source.h"
#include "stress/reference.h"

namespace quasimc::stress {
namespace {

constexpr double kPi = std::numbers::pi;

Frame frame_around(const Vec3& n) {
    const Vec3 other = std::abs(n.x) < .6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 s = normalized(cross(other, n));
    return {s, cross(n, s), n};
}

Vec3 in_frame(const Frame& f, double cosine, double phi) {
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return sine * std::cos(phi) * f.s + sine * std::sin(phi) * f.t + cosine * f.n;
}

std::optional<Emitter> far_emitter(const Node& source, const Scene& scene) {
    const std::string type = text_at(source, "type", "");
    const std::size_t bands = scene.bands().size();
    Emitter emitter;
    const Vec3 to_light = scene.orientation().towards(
        number_at(source, "azimuth_deg", 0), number_at(source, "elevation_deg", 90));
    emitter.direction = -to_light;
    if (type == "uniform_sky" || type == "sky") {
        emitter.kind = type == "sky" ? Emitter::Kind::overcast_sky : Emitter::Kind::uniform_sky;
        emitter.amount = per_band_at(source, "irradiance_horizontal", bands, 0);
        const bool is_known =
            type == "uniform_sky" || text_at(source, "model", "") == "cie_overcast";
        return is_known ? std::optional(emitter) : std::nullopt;
    }
    emitter.amount = per_band_at(source, "irradiance_facing", bands, 0);
    if (type == "directional") {
        return emitter;
    }
    if (type != "sun" || source.find("disk") == nullptr || to_light.z < .01) {
        return std::nullopt;
    }
    emitter.kind = Emitter::Kind::cone;
    emitter.angle = solar_radius_deg(1) * kPi / 180;
    return emitter;
}

std::optional<Emitter> lamp_emitter(const Node& source, const Scene& scene) {
    const std::map<std::string, Emitter::Kind> kinds{
        {"point", Emitter::Kind::point},         {"spot", Emitter::Kind::spot},
        {"rectangle", Emitter::Kind::rectangle}, {"disk", Emitter::Kind::disk},
        {"line", Emitter::Kind::line},           {"sphere", Emitter::Kind::sphere}};
    const auto kind = kinds.find(text_at(source, "type", ""));
    if (kind == kinds.end()) {
        return std::nullopt;
    }
    const Orientation& axes = scene.orientation();
    Emitter lamp;
    lamp.kind = kind->second;
    lamp.amount = per_band_at(source, "power", scene.bands().size(), 0);
    lamp.exponent = number_at(source, "exponent", 0);
    lamp.length = number_at(source, "length", 0);
    lamp.width = number_at(source, "width", 0);
    lamp.radius = number_at(source, "radius", 0);
    lamp.position = axes.inward(vector_at(source, "position", {}));
    const Vec3 down = axes.outward({0, 0, -1});
    lamp.axes = frame_around(normalized(axes.inward(vector_at(source, "aim", down))));
    if (source.find("along") != nullptr) {
        const Vec3 along = axes.inward(vector_at(source, "along", {}));
        lamp.axes.s = normalized(along - dot(along, lamp.axes.n) * lamp.axes.n);
        lamp.axes.t = cross(lamp.axes.n, lamp.axes.s);
    }
    if (lamp.kind == Emitter::Kind::line) {
        const Vec3 from = axes.inward(vector_at(source, "from", {}));
        const Vec3 to = axes.inward(vector_at(source, "to", {}));
        lamp.position = .5 * (from + to);
        lamp.length = length(to - from);
        lamp.axes = frame_around(normalized(to - from));
    }
    return lamp;
}

/// A start point of a beam along `direction` (in the disk around the scene, or in the cell, above
/// or below it), and the area across the beam.
std::pair<Vec3, double> beam_entry(const PlainScene& scene, const Vec3& direction, Random& random) {
    const double u = random.unit();
    const double v = random.unit();
    if (scene.cell.periodic()) {
        const Cell& cell = scene.cell;
        const double margin = scene.bounds.size().z + std::min(cell.size_x, cell.size_y);
        const double z = direction.z < 0 ? scene.bounds.high.z + 1e-6 * margin
                                         : scene.bounds.low.z - 1e-6 * margin;
        return {
            {cell.low_x + u * cell.size_x, cell.low_y + v * cell.size_y, z},
            cell.size_x * cell.size_y * std::abs(direction.z)};
    }
    const double radius = scene.bounds.radius();
    const Frame frame = frame_around(direction);
    const double r = radius * std::sqrt(u);
    const Vec3 origin = scene.bounds.center() + r * std::cos(2 * kPi * v) * frame.s +
                        r * std::sin(2 * kPi * v) * frame.t - 1.5 * radius * direction;
    return {origin, kPi * radius * radius};
}

StartedRay far_ray(const Emitter& emitter, const PlainScene& scene, Random& random) {
    Vec3 direction = emitter.direction;
    double solid = 1;  // integral of radiance over directions, per unit of the given amount
    if (emitter.kind == Emitter::Kind::cone) {
        const double sine = std::sin(emitter.angle);
        const double depth = 2 * std::pow(std::sin(emitter.angle / 2), 2);  // 1 - cosine
        const double u = random.unit();
        direction =
            in_frame(frame_around(emitter.direction), 1 - u * depth, 2 * kPi * random.unit());
        solid = 2 * depth / (sine * sine);
    } else if (emitter.kind != Emitter::Kind::beam) {
        const double height = random.unit();  // sine of the elevation, uniform
        direction = -in_frame(frame_around({0, 0, 1}), height, 2 * kPi * random.unit());
        solid = 2;
        if (emitter.kind == Emitter::Kind::overcast_sky) {
            solid *= (1 + 2 * height) / 3 * 9 / 7;
        }
    }
    const auto [origin, area] = beam_entry(scene, direction, random);
    return {origin, direction, solid * area};
}

/// Samples a direction by the cosine law about n.
Vec3 cosine_direction(const Frame& frame, Random& random) {
    const double u = random.unit();
    return in_frame(frame, std::sqrt(u), 2 * kPi * random.unit());
}

StartedRay lamp_ray(const Emitter& lamp, Random& random) {
    const Frame& f = lamp.axes;
    const double u = random.unit();
    const double v = random.unit();
    Vec3 origin = lamp.position;
    switch (lamp.kind) {
        case Emitter::Kind::spot: {
            const double cosine = std::pow(1 - u, 1 / (lamp.exponent + 1));
            return {origin, in_frame(f, cosine, 2 * kPi * v)};
        }
        case Emitter::Kind::rectangle:
            origin += (u - .5) * lamp.length * f.s + (v - .5) * lamp.width * f.t;
            return {origin, cosine_direction(f, random)};
        case Emitter::Kind::disk: {
            const double r = lamp.radius * std::sqrt(u);
            origin += r * std::cos(2 * kPi * v) * f.s + r * std::sin(2 * kPi * v) * f.t;
            return {origin, cosine_direction(f, random)};
        }
        case Emitter::Kind::line: {
            // Samples theta with density proportional to sin^2 by rejection.
            double theta = kPi * random.unit();
            while (random.unit() > std::sin(theta) * std::sin(theta)) {
                theta = kPi * random.unit();
            }
            origin += (u - .5) * lamp.length * f.n;
            return {origin, in_frame(f, std::cos(theta), 2 * kPi * v)};
        }
        case Emitter::Kind::sphere: {
            const Vec3 n = random.direction();
            return {origin + lamp.radius * n, cosine_direction(frame_around(n), random)};
        }
        default:
            return {origin, random.direction()};
    }
}

}  // namespace

std::optional<std::vector<Emitter>> emitters_of(const Node& document, const Scene& scene) {
    std::vector<Emitter> emitters;
    for (const Node* source : tables_at(document, "source")) {
        auto emitter = source->find("power") == nullptr ? far_emitter(*source, scene)
                                                        : lamp_emitter(*source, scene);
        if (!emitter) {
            return std::nullopt;
        }
        emitters.push_back(std::move(*emitter));
    }
    return emitters;
}

StartedRay start_ray(const Emitter& emitter, const PlainScene& scene, Random& random) {
    return emitter.kind <= Emitter::Kind::overcast_sky ? far_ray(emitter, scene, random)
                                                       : lamp_ray(emitter, random);
}

}  // namespace quasimc::stress
