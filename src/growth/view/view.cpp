#include "growth/view/view.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "growth/view/view_lines.h"
#include "quasimc/error.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

// Readers of labels. Words that they leave unread are ignored, with a notice.

/// Reads one number into a member of a view.
template <double View::*member>
void read_number(ViewFile& file, View& view) {
    view.*member = file.number("the value");
}

void read_angle_factor(ViewFile& file, View& view) {
    constexpr double kDegrees = 360;
    const double factor = file.number("the number of angles in a full turn");
    if (factor == 0) {
        file.fail("the angle factor is 0", "the angle is 360 degrees divided by it");
    }
    view.angle_deg = kDegrees / factor;
}

/// Reads "2", "2 pixels", "2p". The unit concerns the screen.
void read_line_width(ViewFile& file, View& view) {
    const std::string_view given = file.word();
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    const auto unit = std::find_if(given.begin(), given.end(), is_letter);
    // The exponent of a number has a letter too.
    const std::string_view width =
        parse_real(given) ? given : std::string_view(given.begin(), unit);
    view.line_width = file.parsed(width, "the line width");
    file.skip_words();
}

constexpr Range kColorNumbers{-1e6, 1e6};

/// Reads a colour, as the turtle counts them. That of the back concerns the screen.
void read_initial_color(ViewFile& file, View& view) {
    constexpr int kColors = 256;
    const int given = file.integer("the initial colour", kColorNumbers);
    view.color = (given % kColors + kColors) % kColors;
    if (view.color != given) {
        file.warn(fmt::format("colour {} counts as {}", given, view.color));
    }
    file.skip_words();
}

void read_color_increment(ViewFile& file, View& view) {
    view.color_increment = file.integer("the increment of colours", kColorNumbers);
}

void read_contour_sides(ViewFile& file, View& view) {
    constexpr int kMinSides = 3, kMaxSides = 1000;
    const int sides = file.integer("the number of sides", {-kMaxSides, kMaxSides});
    if (sides < kMinSides) {
        file.warn(fmt::format("{} contour sides count as {}", sides, kMinSides));
    }
    view.contour_sides = std::max(sides, kMinSides);
}

void read_past_cut(ViewFile& file, View& view) {
    const std::string value = lower_case(file.word());
    if (value != "on" && value != "off") {
        file.fail("the value is " + shown(value), "it is 'on' or 'off'");
    }
    view.interprets_past_cut = value == "on";
}

void read_environment_display(ViewFile& file, View& view) {
    view.passes_before_display = lower_case(file.word()) == "before";
    file.skip_words();
}

/// Reads "x: low,high y: low,high z: low,high".
void read_box(ViewFile& file, View& view) {
    file.separate_at(" \t\r\v\f,:");
    Bounds box;
    for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        file.word();
        box.low.*axis = file.number("the lower end of an axis");
        box.high.*axis = file.number("the upper end of an axis");
    }
    view.box = box;
}

/// Reads "T: x y z I: i A: a E: e S: s". |T| counts only up to I, and not at all without I.
template <bool is_torque>
void read_tropism(ViewFile& file, View& view) {
    Tropism& tropism = view.tropisms.emplace_back();
    tropism.is_torque = is_torque;
    file.separate_at(" \t\r\v\f,:");
    Vec3 direction;
    std::optional<double> intensity;
    bool has_direction = false, is_intensity_first = false;
    while (file.has_word()) {
        const std::string item = lower_case(file.word());
        if (item == "t") {
            direction = file.vector("a coordinate of T");
            has_direction = true;
        } else if (item == "i") {
            intensity = file.number("the intensity I");
            is_intensity_first |= !has_direction;
        } else if (item == "a") {
            tropism.angle_deg = file.number("the angle A");
        } else if (item == "e") {
            tropism.elasticity = file.number("the elasticity E");
        } else if (item == "s") {
            tropism.step = file.number("the step S");
        } else {
            file.fail(
                fmt::format("item {} is unknown", shown(item)), "the items are T, A, I, E and S",
                "write 'T: 0 1 0 E: 0.1'");
        }
    }
    const double size = length(direction);
    if (!(size > 0)) {
        file.warn("the tropism is off, because its direction T is 0 or missing");
    } else if (is_intensity_first) {
        file.warn("the tropism is off, because the intensity I is not after the direction T");
    } else {
        tropism.direction = direction / size;
        tropism.intensity = intensity ? std::min(*intensity, size) : 1;
    }
}

void read_old_tropism(ViewFile& file, View& view) {
    const Vec3 direction = file.vector("a coordinate of the direction");
    const double size = length(direction);
    view.old_tropism = size > 0 ? direction / size : Vec3{};
}

// Readers of labels that name files.

void read_surface(ViewFile& file, View& view) {
    const std::string_view id = file.word();
    if (id.size() != 1) {
        file.fail(
            "the surface is called " + shown(id), "the name of a surface is one character",
            "write 'surface: l leaf.s 1'");
    }
    const auto named = file.named_file(fmt::format("surface {}", shown(id)));
    if (!named) {
        return;
    }
    const double size = file.number("the size of the surface");
    constexpr Range kDivisions{1, kMaxPatchDivisions};
    PatchDivisions divisions;
    divisions.s = file.has_word() ? file.integer("the number of divisions s", kDivisions) : 0;
    divisions.t = file.has_word() ? file.integer("the number of divisions t", kDivisions) : 0;
    if (divisions.s > 0 && divisions.t == 0) {
        file.warn("one number of divisions is ignored; give both, s and t");
    }
    file.skip_words();  // a texture
    if (auto surface = read_surface_file(*named, size, divisions, file.notices())) {
        surface->name = id.front();
        view.surfaces.insert_or_assign(id.front(), std::move(*surface));
    }
}

void read_contour(ViewFile& file, View& view) {
    constexpr Range kIds{0, 1'000'000};
    const int id = file.integer("the number of the contour", kIds);
    if (const auto named = file.named_file(fmt::format("contour {} is a circle: its file", id))) {
        view.contours.insert_or_assign(id, read_contour_file(*named));
    }
}

/// Reads the number of samples of a function or curve.
int read_samples(ViewFile& file, Range range, int otherwise) {
    return file.has_word() ? file.integer("the number of samples", range) : otherwise;
}

void read_function(ViewFile& file, View& view) {
    PlantFunction& function = view.functions.emplace_back();
    if (const auto named =
            file.named_file(fmt::format("function {}, which is 0,", view.functions.size()))) {
        function = read_function_file(*named, read_samples(file, {0, kMaxViewSamples}, 0));
    }
}

void read_function_set(ViewFile& file, View& view) {
    if (!view.functions.empty()) {
        file.warn("the set replaces the functions before it");
    }
    view.functions.clear();
    if (const auto named = file.named_file("the set of functions")) {
        view.functions = read_function_set_file(*named);
    }
}

void read_curve(ViewFile& file, View& view) {
    constexpr int kSamples = 100;  // as in cpfg
    PlantCurve& curve = view.curves.emplace_back();
    if (const auto named =
            file.named_file(fmt::format("curve {}, which is 0,", view.curves.size()))) {
        curve = read_curve_file(*named, read_samples(file, {2, kMaxViewSamples}, kSamples));
        if (curve.points.empty()) {
            file.warn("a contour is no curve: its values are 0");
        }
    }
}

void warn_of_unsupported(ViewFile& file, View&) {
    file.warn("this predefined shape is not supported and ignored");
    file.skip_words();
}

struct ViewLabel {
    std::string_view name;  ///< lower case
    void (*read)(ViewFile& file, View& view);
};

// To add a label: write its reader above, and add a row.
constexpr ViewLabel kViewLabels[] = {
    {"angle factor", read_angle_factor},
    {"angle increment", read_number<&View::angle_deg>},
    {"initial line width", read_line_width},
    {"line width increment", read_number<&View::line_width_increment>},
    {"initial scale", read_number<&View::scale>},
    {"scale multiplier", read_number<&View::scale_multiplier>},
    {"initial color", read_initial_color},
    {"color increment", read_color_increment},
    {"contour sides", read_contour_sides},
    {"box", read_box},
    {"surface", read_surface},
    {"contour", read_contour},
    {"function", read_function},
    {"function set", read_function_set},
    {"curve", read_curve},
    {"tropism", read_tropism<false>},
    {"torque", read_tropism<true>},
    {"tropism direction", read_old_tropism},
    {"initial elasticity", read_number<&View::elasticity>},
    {"elasticity increment", read_number<&View::elasticity_increment>},
    {"interpretation past %", read_past_cut},
    {"environment display", read_environment_display},
    {"tsurface", warn_of_unsupported},
    {"line", warn_of_unsupported},
};

/// Labels of the camera, of light and materials, and of the screen, which do not change the plant.
constexpr std::string_view kOtherLabels =
    "back distance|camera|field of view|front distance|max zoom|min zoom|projection|scale|"
    "scale factor|twist|up|up vector|view angle|view direction|view point|view reference point|"
    "view volume|viewpoint|window|ambient light|background|background color|background scene|"
    "color map|colormap|diffuse weight|initial material|initial texture|light|light direction|"
    "material|material file|shade mode|shadow map|shadows|specular weight|texture|antialiasing|"
    "clear between frames|concave polygons|corrected normals|cue range|display|double buffer|"
    "dynamic representation|font|generate on view change|grid|label font|line style|render mode|"
    "rotation|stationary representation|stereo|tapered lines|winding|z buffer";

void warn_of_unknown_label(const std::string& label, ViewFile& file) {
    std::vector<std::string_view> names;
    for (const ViewLabel& row : kViewLabels) {
        names.push_back(row.name);
    }
    for (std::string_view rest = kOtherLabels; !rest.empty();) {
        names.push_back(take_word(rest, "|"));
    }
    if (std::count(names.begin(), names.end(), label) == 0) {
        const std::string near = near_word_text(label, names);
        file.notices().once(
            "label of a view file: " + label,
            fmt::format(
                "{}: label {} is unknown and ignored{}", file.where(), shown(label),
                near.empty() ? "" : "; " + near));
    }
}

/// Reads the current line of a view file.
void read_view_line(ViewFile& file, View& view) {
    file.separate_at(kBetweenViewValues);
    const std::optional<std::string> label = file.take_label();
    if (!label) {
        file.warn(shown(file.line()) + " is ignored (lines are 'label: value')");
        return;
    }
    for (const ViewLabel& row : kViewLabels) {
        if (row.name == *label) {
            row.read(file, view);
            if (file.has_word()) {
                file.warn(shown(file.ahead()) + " is ignored");
            }
            return;
        }
    }
    warn_of_unknown_label(*label, file);
}

}  // namespace

View read_view(const PreprocessedText& text, InputFiles& files, Notices& notices) {
    View view;
    Faults faults;
    ViewFile file(text, files, notices);
    while (faults.size() < kMaxViewFaults && file.next()) {
        try {
            read_view_line(file, view);
        } catch (const InputError& error) {
            faults.add(error);
        }
    }
    faults.throw_if_any();
    return view;
}

}  // namespace quasimc
