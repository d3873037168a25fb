#include "growth/turtle/turtle.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "base/text.h"

namespace quasimc {

/// All commands. One of several modules has its parameters after the last.
struct Turtle::CommandTable {
    using T = Turtle&;
    using P = const TurtleParameters&;
    struct Command {
        std::string_view name;
        void (*run)(Turtle& turtle, const TurtleParameters& parameters);
    };

    static constexpr Turn kBack{-1, 0};
    static constexpr auto kAll = std::to_array<Command>({
        {"F", [](T t, P p) { t.move({.draws = true, .adds_corner = true}, p); }},
        {"G", [](T t, P p) { t.move({.draws = true, .adds_corner = false}, p); }},
        {"f", [](T t, P p) { t.move({.draws = false, .adds_corner = true}, p); }},
        {"g", [](T t, P p) { t.move({.draws = false, .adds_corner = false}, p); }},
        {"+", [](T t, P p) { turn_towards(t.heading(), t.left(), t.angle(p)); }},
        {"-", [](T t, P p) { turn_towards(t.heading(), t.left(), opposite(t.angle(p))); }},
        {"&", [](T t, P p) { turn_towards(t.heading(), t.up(), t.angle(p)); }},
        {"^", [](T t, P p) { turn_towards(t.heading(), t.up(), opposite(t.angle(p))); }},
        {"/", [](T t, P p) { turn_towards(t.left(), t.up(), t.angle(p)); }},
        {"\\", [](T t, P p) { turn_towards(t.left(), t.up(), opposite(t.angle(p))); }},
        {"|", [](T t, P) { turn_towards(t.heading(), t.left(), kBack); }},
        {"[", [](T t, P) { t.push(); }},
        {"]", [](T t, P) { t.pop(); }},
        {";", [](T t, P p) { t.change_color(p, 1); }},
        {",", [](T t, P p) { t.change_color(p, -1); }},
        {"#", [](T t, P p) { t.change_width(p, 1); }},
        {"!", [](T t, P p) { t.change_width(p, -1); }},
        {"_", [](T t, P p) { t.set_elasticity(p); }},
        {"{", [](T t, P p) { t.begin_polygon(p); }},
        {".", [](T t, P p) { t.mark_corner(p); }},
        {"}", [](T t, P) { t.end_polygon(); }},
        {"@M", [](T t, P p) { t.move_to(p.vector_or(0, t.state_.frame.position)); }},
        {"@R", [](T t, P p) { t.orient(p); }},
        {"@v", [](T t, P) { t.make_left_horizontal(); }},
        {"@D", [](T t, P p) { t.state_.scale = p.value_or(0, t.state_.scale); }},
        {"@Di", [](T t, P p) { t.state_.scale *= p.value_or(0, t.view_.scale_multiplier); }},
        {"@Dd", [](T t, P p) { t.state_.scale /= p.value_or(0, t.view_.scale_multiplier); }},
        {"@Ts", [](T t, P p) { t.change_tropism(p, 0); }},
        {"@Ti", [](T t, P p) { t.change_tropism(p, 1); }},
        {"@Td", [](T t, P p) { t.change_tropism(p, -1); }},
        {"@Tf", [](T t, P) { t.set_node(); }},
        {"@Tp", [](T t, P) { t.adjust_axes(); }},
        {"@O", [](T t, P p) { t.draw_sphere(p); }},
        {"@o", [](T t, P p) { t.draw_disc(p); }},
        {"@c", [](T t, P p) { t.draw_disc(p); }},
        {"@#", [](T t, P p) { t.set_contour(p); }},
        {"@!", [](T t, P p) { t.set_contour_sides(p); }},
        {"@Gs", [](T t, P) { t.begin_cylinder(); }},
        {"@Gc", [](T t, P p) { t.end_cylinder_segment(p); }},
        {"@Ge", [](T t, P p) { t.end_cylinder(p); }},
        {"@Gt", [](T t, P p) { t.set_tangents(p); }},
        {"@Gr", [](T t, P p) { t.set_radius_tangents(p); }},
        {"@PS", [](T t, P p) { t.patches_[p.integer(0)] = {}; }},
        {"@PC", [](T t, P p) { t.set_patch_point(p); }},
        {"@PD", [](T t, P p) { t.draw_patch(p); }},
        {"@bo", [](T t, P) { t.end_segment(); }},  // a ring has no area
        {"@bc", [](T t, P) { t.end_segment(); }},
        {"@;", [](T, P) {}},  // back sides have the colour of the front
        {"@,", [](T, P) {}},
        {"@Tx", [](T, P) {}},  // textures
        {"@L", [](T, P) {}},   // labels
        {"@S", [](T t, P) { t.warn("'@S': shell commands are not run"); }},
    });

    /// The function of a command; null: there is none.
    static auto find(std::string_view name) {
        const auto found = std::find_if(kAll.begin(), kAll.end(), [name](const Command& command) {
            return command.name == name;
        });
        return found == kAll.end() ? nullptr : found->run;
    }
    /// Whether a longer command begins with a name.
    static bool begins(std::string_view name) {
        return std::any_of(kAll.begin(), kAll.end(), [name](const Command& command) {
            return command.name.starts_with(name);
        });
    }
};

Turtle::Turtle(const View& view, Notices& notices, Commands commands)
    : view_(view),
      notices_(notices),
      commands_(commands),
      view_turn_(turn_of(view.angle_deg)),
      cylinders_(view, notices) {
    for (const Tropism& tropism : view.tropisms) {
        initial_settings_.elasticities.push_back(tropism.elasticity);
    }
    initial_settings_.cylinder.sides = std::max(3, view.contour_sides);
    state_.width = view.line_width;
    state_.scale = view.scale;
    state_.elasticity = view.old_tropism == Vec3{} ? 0 : view.elasticity;
    state_.color = view.color;
    bounds_.add(state_.frame.position);
}

ModuleString::Position Turtle::execute(const ModuleString& string, ModuleString::Position p) {
    static constexpr auto kBySymbol = [] {
        std::array<decltype(CommandTable::Command::run), 256> runs{};
        for (const auto& command : CommandTable::kAll) {
            if (command.name.size() == 1) {
                runs[static_cast<unsigned char>(command.name[0])] = command.run;
            }
        }
        return runs;
    }();
    const char symbol = string.symbol(p);
    if (symbol == '@' || symbol == '~') {
        return execute_named(string, p);
    }
    if (const auto run = kBySymbol[static_cast<unsigned char>(symbol)]) {
        run(*this, {string, p});
    }
    return string.next(p);
}

ModuleString::Position Turtle::execute_named(const ModuleString& string, Position p) {
    const auto is_name = [&string](Position at) {
        return at < string.end() && string.symbol(at) != '[' && string.symbol(at) != ']';
    };
    const bool is_surface = string.symbol(p) == '~';
    p = string.next(p);
    if (!is_name(p)) {
        warn(is_surface ? "'~' without a name is skipped" : "'@' without a command is skipped");
        return p;
    }
    if (is_surface) {
        draw_surface(string.symbol(p), {string, p});
        return string.next(p);
    }
    std::string name{'@', string.symbol(p)};
    if (const Position after = string.next(p); string.count(p) == 0 && is_name(after)) {
        const std::string longer = name + string.symbol(after);
        if (CommandTable::find(longer) ||
            (!CommandTable::find(name) && CommandTable::begins(name))) {
            name = longer;
            p = after;
        }
    }
    if (const auto run = CommandTable::find(name)) {
        const Parameters parameters(string, p);
        for (std::size_t i = 0; i < parameters.count(); ++i) {
            check_finite(parameters[i]);
        }
        run(*this, parameters);
    } else {
        warn(shown(name) + " is no command; it is skipped");
    }
    return string.next(p);
}

void Turtle::move(const Move& move, const Parameters& parameters) {
    TurtleFrame& frame = state_.frame;
    const double length = parameters.count() > 0 ? parameters[0] * state_.scale : state_.scale;
    check_finite(length);
    end_segment();
    if (!view_.tropisms.empty()) {
        bend_before_move();
    }
    const Vec3 from = frame.position;
    frame.position += length * frame.heading;
    bounds_.add(frame.position);
    if (move.draws && drawing_ != nullptr && length != 0) {
        pending_ = {{from, frame.position, radius(), radius(), frame}, module_, state_.color};
        pending_->segment.frame.position = from;
    }
    if (move.adds_corner && !polygons_.empty()) {
        constexpr int kStrips = 4;
        add_corner(kStrips);
    }
    if (state_.elasticity != 0) {
        bend_after_move();
    }
    if (move.draws) {
        set_node();
    }
}

void Turtle::push() {
    end_segment();
    stack_.push_back(state_);
}

void Turtle::pop() {
    end_segment();
    if (stack_.empty()) {
        warn("a ']' without a '[' before it is ignored");
        return;
    }
    state_ = std::move(stack_.back());
    stack_.pop_back();
}

void Turtle::enter_subsystem(double scale) {
    end_segment();
    outer_.emplace_back(state_.scale, state_.width);
    state_.scale *= scale;
    state_.width *= scale;
}

void Turtle::leave_subsystem() {
    end_segment();
    if (!outer_.empty()) {
        std::tie(state_.scale, state_.width) = outer_.back();
        outer_.pop_back();
    }
}

void Turtle::set_state(const State& state) {
    end_segment();
    state_ = state;
    bounds_.add(state_.frame.position);
}

Turtle::Settings& Turtle::own_settings() {
    if (state_.settings.use_count() != 1) {  // none yet, or shared with a state of the stack
        state_.settings = std::make_shared<Settings>(settings());
    }
    return *state_.settings;
}

void Turtle::set_drawing(Drawing* drawing) {
    end_segment();
    drawing_ = drawing;
    announced_ = kNoModule;
}

void Turtle::send_segment() {
    pending_->segment.radius_to = radius();
    announce(pending_->module);
    drawing_->segment(pending_->segment, pending_->color);
    pending_.reset();
}

void Turtle::announce(const DrawnModule& module) {
    if (announced_ != module.index) {
        announced_ = module.index;
        drawing_->begin_module(module);
    }
}

Drawing* Turtle::shape() {
    end_segment();
    if (drawing_ != nullptr) {
        announce(module_);
    }
    return drawing_;
}

}  // namespace quasimc
