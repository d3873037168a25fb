#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/notices.h"
#include "growth/module_string.h"
#include "growth/turtle/drawing.h"
#include "growth/turtle/turtle_cylinder.h"
#include "growth/turtle/turtle_frame.h"
#include "growth/view/view.h"

namespace quasimc {

/// The parameters of a command.
class TurtleParameters {
  public:
    TurtleParameters(const ModuleString& string, ModuleString::Position p)
        : string_(string), p_(p), count_(string.count(p)) {}

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] float operator[](std::size_t i) const { return string_.parameter(p_, i); }
    /// A parameter, or another value if there is none.
    [[nodiscard]] double value_or(std::size_t i, double other) const {
        return i < count_ ? static_cast<double>((*this)[i]) : other;
    }
    /// A parameter without its fraction. Beyond +-1e9, for what is not a number, and if there is
    /// none, it is 0.
    [[nodiscard]] int integer(std::size_t i) const {
        const double value = value_or(i, 0);
        return std::abs(value) < 1e9 ? static_cast<int>(value) : 0;
    }
    /// Three parameters, or the components of another vector.
    [[nodiscard]] Vec3 vector_or(std::size_t i, const Vec3& other) const {
        return {value_or(i, other.x), value_or(i + 1, other.y), value_or(i + 2, other.z)};
    }

  private:
    const ModuleString& string_;
    ModuleString::Position p_;
    std::size_t count_;
};

/// Interprets modules as commands of a turtle (Prusinkiewicz and Lindenmayer 1990, chapter 1). A
/// segment is drawn when its end radius is known: before the next shape, move or bracket.
class Turtle {
  public:
    /// Whether colours and widths are executed. In a pass of an environment they are not.
    enum class Commands { all, moves };

    /// @param view, notices  outlive the turtle
    Turtle(const View& view, Notices& notices, Commands commands = Commands::all);

    /// Where shapes go from now on; null: nowhere.
    void set_drawing(Drawing* drawing);
    void set_commands(Commands commands) { commands_ = commands; }
    /// The module that draws from now on.
    void begin_module(const DrawnModule& module) { module_ = module; }

    /// Executes the command at `p`. Symbols that are no commands are skipped. The symbols '?' '%'
    /// and '$' are not for the turtle.
    /// @returns the position after its modules: a command may have several, as "@Gs"
    [[nodiscard]] ModuleString::Position execute(
        const ModuleString& string, ModuleString::Position p);

    /// Draws the pending segment; to be called at the end of the string.
    void finish() { end_segment(); }

    [[nodiscard]] const TurtleFrame& frame() const { return state_.frame; }
    [[nodiscard]] double line_width() const { return state_.width; }
    [[nodiscard]] double scale() const { return state_.scale; }
    /// Bounds of all positions, spheres and surfaces so far.
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }

    /// Enters a sub-L-system: scale and width are multiplied, and restored when it is left.
    void enter_subsystem(double scale);
    void leave_subsystem();

    /// Settings that few models change.
    struct Settings {
        std::vector<double> elasticities;  ///< one for each tropism and torque
        CylinderSettings cylinder;
        CylinderPoint from;  ///< start of the next segment of the generalized cylinder
        CylinderRing ring;   ///< its last ring; without sides, it is not begun
    };
    /// The complete state, which brackets restore.
    struct State {
        TurtleFrame frame;
        HeadingAndUp node;  ///< axes after the last segment
        double width = 1, scale = 1, elasticity = 0;
        int color = 0;
        std::shared_ptr<Settings> settings;  ///< null: the initial ones
    };
    /// The state, to continue from it later.
    [[nodiscard]] std::shared_ptr<const State> state() const {
        return std::make_shared<const State>(state_);
    }
    void set_state(const State& state);

  private:
    using Position = ModuleString::Position;
    using Parameters = TurtleParameters;
    struct CommandTable;
    struct Move {
        bool draws = false, adds_corner = false;
    };
    struct PendingSegment {
        DrawnSegment segment;
        DrawnModule module;
        int color = 0;
    };
    struct Polygon {
        std::optional<CylinderCurve> curve;  // of a generalized cylinder
        std::vector<CylinderPoint> points;
    };

    void warn(const std::string& text) { notices_.once("turtle: " + text); }
    [[nodiscard]] double radius() const { return state_.width / 2; }
    [[nodiscard]] const Settings& settings() const {
        return state_.settings ? *state_.settings : initial_settings_;
    }
    /// The settings of this state alone, to be changed.
    [[nodiscard]] Settings& own_settings();

    // turtle.cpp: moves, and what they draw
    [[nodiscard]] Position execute_named(const ModuleString& string, Position p);
    [[nodiscard]] Vec3& heading() { return state_.frame.heading; }
    [[nodiscard]] Vec3& left() { return state_.frame.left; }
    [[nodiscard]] Vec3& up() { return state_.frame.up; }
    /// Warns if a parameter of a command is not a finite number: all shapes after it are lost.
    void check_finite(double value) {
        if (!std::isfinite(value)) {
            warn(
                "a parameter is not a finite number; nothing is drawn after it, up to the end of "
                "the branch");
        }
    }
    [[nodiscard]] const Turn& angle(const Parameters& parameters) {
        if (parameters.count() > 0) {
            check_finite(parameters[0]);
        }
        return parameters.count() > 0 ? turns_.turn(parameters[0]) : view_turn_;
    }
    void move(const Move& move, const Parameters& parameters);
    void push();
    void pop();
    void end_segment() {
        if (pending_) {
            send_segment();
        }
    }
    void send_segment();
    void announce(const DrawnModule& module);
    [[nodiscard]] Drawing* shape();

    // turtle_commands.cpp: colours, widths, axes, tropisms
    /// Turns the heading by the tropisms, then the frame about it by the torques.
    void bend_before_move();
    /// Turns the heading by the old form of tropism.
    void bend_after_move();
    [[nodiscard]] int parts(double value, int least, const char* command);
    void change_color(const Parameters& parameters, int sign);
    void change_width(const Parameters& parameters, int sign);
    void set_elasticity(const Parameters& parameters) {
        state_.elasticity = parameters.value_or(0, state_.elasticity + view_.elasticity_increment);
    }
    void change_tropism(const Parameters& parameters, int sign);
    void move_to(const Vec3& position);
    void orient(const Parameters& parameters);
    void set_node() { state_.node = {state_.frame.heading, state_.frame.up}; }
    void adjust_axes();
    void make_left_horizontal();

    // turtle_shapes.cpp
    [[nodiscard]] double diameter(const Parameters& parameters) const {
        return parameters.count() > 0 ? parameters[0] * state_.scale : state_.width;
    }
    void draw_sphere(const Parameters& parameters);
    void draw_disc(const Parameters& parameters);
    void draw_surface(char name, const Parameters& parameters);
    void begin_polygon(const Parameters& parameters);
    void mark_corner(const Parameters& parameters);
    void add_corner(int strips);
    void end_polygon();
    void set_contour(const Parameters& parameters);
    void set_contour_sides(const Parameters& parameters);
    void set_tangents(const Parameters& parameters);
    void set_radius_tangents(const Parameters& parameters);
    void begin_cylinder();
    void end_cylinder_segment(const Parameters& parameters);
    void end_cylinder(const Parameters& parameters);
    void set_patch_point(const Parameters& parameters);
    void draw_patch(const Parameters& parameters);
    [[nodiscard]] CylinderPoint cylinder_point(int strips) const;
    void send_triangles(const std::vector<Triangle>& triangles);

    static constexpr std::size_t kNoModule = std::numeric_limits<std::size_t>::max();

    const View& view_;
    Notices& notices_;
    Commands commands_;
    Turn view_turn_;
    TurnCache turns_;
    Settings initial_settings_;
    State state_;
    std::vector<State> stack_;
    std::vector<std::pair<double, double>> outer_;  // scales and widths outside sub-L-systems
    Bounds bounds_;

    Drawing* drawing_ = nullptr;
    DrawnModule module_;
    std::size_t announced_ = kNoModule;  // the module that the drawing knows
    std::optional<PendingSegment> pending_;
    std::vector<Polygon> polygons_;                       // that are open
    std::map<int, std::map<std::size_t, Vec3>> patches_;  // points 4 * row + column
    CylinderMaker cylinders_;
};

}  // namespace quasimc
