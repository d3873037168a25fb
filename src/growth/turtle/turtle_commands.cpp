#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "growth/turtle/turtle.h"

namespace quasimc {

namespace {

/// The unit vector `heading` turned by |heading x force| radians towards `force`.
Vec3 bent_heading(const Vec3& heading, const Vec3& force) {
    const Vec3 axis = cross(heading, force);
    const double angle = length(axis);
    if (!(angle > 0)) {
        return heading;
    }
    return std::cos(angle) * heading + (std::sin(angle) / angle) * cross(axis, heading);
}

/// The direction of a tropism, turned by its angle in the plane that holds the heading.
Vec3 tropism_direction(const Tropism& tropism, const Vec3& heading) {
    if (tropism.is_torque || tropism.angle_deg == 0) {
        return tropism.direction;
    }
    const Turn turn = turn_of(tropism.angle_deg);
    const Vec3 across = cross(heading, tropism.direction);
    Vec3 direction = turn.c * tropism.direction;
    if (const double size = length(across); size > 0) {
        direction += (turn.s / size) * cross(tropism.direction, across);
    }
    return direction;
}

}  // namespace

int Turtle::parts(double value, int least, const char* command) {
    constexpr int kMaxParts = 1024;
    if (value > kMaxParts) {
        warn(fmt::format("'{}': more than {} parts; that number is used", command, kMaxParts));
    }
    return value >= least ? static_cast<int>(std::min<double>(value, kMaxParts)) : least;
}

void Turtle::change_color(const Parameters& parameters, int sign) {
    if (commands_ != Commands::all) {
        return;
    }
    constexpr int kColors = 256;
    const int color = parameters.count() > 0
                          ? parameters.integer(0)
                          : state_.color + sign * (view_.color_increment % kColors);
    state_.color = (color % kColors + kColors) % kColors;
}

void Turtle::change_width(const Parameters& parameters, int sign) {
    if (commands_ != Commands::all) {
        return;
    }
    constexpr double kMinWidth = 1e-7;
    const double width = parameters.count() > 0
                             ? parameters[0] * state_.scale
                             : state_.width + sign * view_.line_width_increment * state_.scale;
    state_.width = std::max(kMinWidth, width);
}

/// Sets the elasticity of a tropism or torque (sign 0), or changes it, by default by its step.
void Turtle::change_tropism(const Parameters& parameters, int sign) {
    const std::size_t least = sign == 0 ? 2 : 1;
    if (parameters.count() < least) {
        return;
    }
    const int number = parameters.integer(0);
    const auto i = static_cast<std::size_t>(number) - 1;
    if (number < 1 || i >= view_.tropisms.size()) {
        warn(fmt::format("there is no tropism {}; a change of it is skipped", number));
        return;
    }
    const double value = parameters.value_or(1, view_.tropisms[i].step);
    double& elasticity = own_settings().elasticities[i];
    elasticity = sign == 0 ? value : elasticity + sign * value;
}

void Turtle::bend_before_move() {
    TurtleFrame& frame = state_.frame;
    const auto sum = [&](bool is_torque) {
        std::optional<Vec3> force;  // nothing if no elasticity acts
        for (std::size_t i = 0; i < view_.tropisms.size(); ++i) {
            const Tropism& tropism = view_.tropisms[i];
            const double strength = settings().elasticities[i] * tropism.intensity;
            if (tropism.is_torque == is_torque && strength != 0 && tropism.direction != Vec3{}) {
                force =
                    force.value_or(Vec3{}) + strength * tropism_direction(tropism, frame.heading);
            }
        }
        return force;
    };
    if (const auto force = sum(false)) {
        frame.heading = bent_heading(frame.heading, *force);
        adjust_axes();
    }
    if (const auto torque = sum(true)) {
        const double angle = dot(frame.left, *torque);
        turn_towards(frame.left, frame.up, {std::cos(angle), std::sin(angle)});
    }
}

void Turtle::bend_after_move() {
    const auto turn = [this](Vec3& side) {
        const double s = std::clamp(state_.elasticity * dot(view_.old_tropism, side), -1.0, 1.0);
        turn_towards(heading(), side, {std::sqrt(1 - s * s), s});
    };
    turn(up());
    turn(left());
}

void Turtle::move_to(const Vec3& position) {
    end_segment();
    state_.frame.position = position;
    bounds_.add(position);
}

void Turtle::orient(const Parameters& parameters) {
    const Vec3 given = parameters.vector_or(0, {}), up = parameters.vector_or(3, {});
    const Vec3 along = given == Vec3{} ? Vec3{0, 1, 0} : given;
    heading() = normalized(along);
    const bool is_across = dot(along, up) == 0 || dot(heading(), up) == 0;
    if (up == Vec3{} || !is_across) {
        adjust_axes();
        return;
    }
    state_.frame = with_axes(state_.frame, {heading(), normalized(up)});
}

void Turtle::adjust_axes() {
    state_.frame = with_axes(state_.frame, turned_to(state_.node, heading()));
}

void Turtle::make_left_horizontal() {
    const Vec3 horizontal{heading().z, 0, -heading().x};
    constexpr double kVertical = 1e-9;
    if (length(horizontal) > kVertical) {
        left() = normalized(horizontal);
        up() = cross(left(), heading());
    }
}

}  // namespace quasimc
