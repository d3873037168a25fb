#include "io/meshes/geom_text.h"

#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "io/line_scanner.h"
#include "io/meshes/geom_keywords.h"
#include "io/meshes/unknown_keywords.h"
#include "io/numbers.h"

namespace quasimc {
namespace {

/// Thrown inside this file where nothing sensible can follow.
struct GeomFault {
    std::string problem, why, suggestion;
};

class GeomReader {
  public:
    GeomReader(std::string_view text, Reporter& reporter) : words_(text), reporter_(reporter) {}

    std::optional<GeomText> read() {
        try {
            words_.next();
            while (!words_.is_end()) {
                const std::string_view type = take_name("an object");
                const std::size_t object = read_object(type);
                if (type == "Shape") {
                    text_.shapes.push_back(object);
                } else if (!is_geom_type(type)) {
                    constexpr std::array<std::string_view, 2> kUsual{"Shape", "Material"};
                    unknown_objects_.check(
                        type, fmt::format("line {}", text_.objects[object].line), kUsual);
                }
            }
            unknown_objects_.warn("objects of kinds that PlantGL does not know", reporter_);
            unknown_fields_.warn("fields that PlantGL does not know", reporter_);
        } catch (const GeomFault& fault) {
            reporter_.fault(words_.line(), fault.problem, fault.why, fault.suggestion);
            return std::nullopt;
        }
        return std::move(text_);
    }

  private:
    [[noreturn]] void refuse(std::string_view expected) const {
        const std::string_view word = words_.word();
        if (words_.is_end()) {
            throw GeomFault{"the file ends too early", fmt::format("{} is missing", expected), ""};
        }
        if (word.starts_with(':')) {
            throw GeomFault{
                fmt::format("{} is not read", shown(word)),
                "macros, included files and functions are PlantGL's own",
                "let PlantGL write triangles: scene.save(\"all.obj\")"};
        }
        if (word.find_first_of("+-*/()") != std::string_view::npos && !parse_real(word)) {
            throw GeomFault{
                fmt::format("{} is not read", shown(word)), "expressions are not computed",
                "let PlantGL write triangles: scene.save(\"all.obj\")"};
        }
        throw GeomFault{
            fmt::format("{} stands where {} is expected", shown(word), expected), "", ""};
    }

    std::string_view take_name(std::string_view expected) {
        if (!words_.is_name()) {
            refuse(expected);
        }
        const std::string_view name = words_.word();
        words_.next();
        return name;
    }

    bool take_if(char mark) {
        const bool is_there = words_.is(mark);
        if (is_there) {
            words_.next();
        }
        return is_there;
    }

    void take(char mark) {
        if (!take_if(mark)) {
            refuse(fmt::format("'{}'", mark));
        }
    }

    double take_number() {
        const std::optional<double> number = parse_real(words_.word());
        if (!number || !std::isfinite(*number)) {
            refuse("a finite number");
        }
        words_.next();
        return *number;
    }

    /// What follows the type of an object: a name, if it has one, and its fields in braces.
    std::size_t read_object(std::string_view type) {
        if (++depth_ > kDeepestNesting) {
            throw GeomFault{"objects are nested too deep", "", ""};
        }
        if (type == "Inline") {
            throw GeomFault{
                "Inline is not read", "it is a scene of another file",
                "let PlantGL write triangles: scene.save(\"all.obj\")"};
        }
        GeomObject object{type, {}, words_.line(), {}};
        if (words_.is_name()) {
            object.name = take_name("a name");
        }
        take('{');
        while (!take_if('}')) {
            read_field(object);
            take_if(',');
        }
        --depth_;
        const std::size_t number = text_.objects.size();
        if (!object.name.empty() && !names_.emplace(object.name, number).second) {
            throw GeomFault{fmt::format("{} is there twice", shown(object.name)), "", ""};
        }
        text_.objects.push_back(std::move(object));
        return number;
    }

    /// A field and its value; a shape may also have its geometry and its appearance without words.
    void read_field(GeomObject& object) {
        GeomField field{{}, words_.line(), {}};
        const std::string_view word = take_name("a field");
        const auto known = names_.find(word);
        if (object.type == "Shape" && (known != names_.end() || words_.is('{') || words_.is(','))) {
            if (known == names_.end() && !words_.is('{')) {
                throw GeomFault{fmt::format("there is no {}", shown(word)), "", ""};
            }
            field.name = object.fields.empty() ? "Geometry" : "Appearance";
            field.value =
                std::vector<std::size_t>{known != names_.end() ? known->second : read_object(word)};
        } else {
            field.name = word;
            field.value = read_value();
            if (const auto fields = geom_fields(object.type); !fields.empty()) {
                unknown_fields_.check(word, fmt::format("line {}", field.line), fields);
            }
        }
        object.fields.push_back(std::move(field));
    }

    GeomValue read_value() {
        if (words_.is('<')) {
            GeomRows row;
            read_row(row, '>');
            return row;
        }
        if (words_.is('[')) {
            return read_list();
        }
        if (words_.is_text()) {
            const std::string_view text = words_.word();
            words_.next();
            return text;
        }
        if (!words_.is_name()) {
            return take_number();
        }
        const std::string_view name = words_.word();
        words_.next();
        return named_value(name);
    }

    /// An object, the name of one, or a word.
    GeomValue named_value(std::string_view name) {
        if (words_.is('{') || (words_.is_name() && is_geom_type(name))) {
            return std::vector<std::size_t>{read_object(name)};
        }
        const auto known = names_.find(name);
        return known == names_.end() ? GeomValue(name)
                                     : GeomValue(std::vector<std::size_t>{known->second});
    }

    /// Numbers between marks, as a row.
    void read_row(GeomRows& rows, char end) {
        words_.next();
        read_numbers(rows, end);
    }

    void read_numbers(GeomRows& rows, char end) {
        while (!take_if(end)) {
            rows.numbers.push_back(take_number());
            take_if(',');
        }
        rows.ends.push_back(rows.numbers.size());
    }

    /// A row, or rows of a matrix, one after the other.
    void read_rows(GeomRows& rows) {
        const char begin = words_.word().front();
        if (begin == '<') {
            read_row(rows, '>');
            return;
        }
        words_.next();
        if (!words_.is('<')) {
            read_numbers(rows, ']');
            return;
        }
        while (!take_if(']')) {
            if (!words_.is('<')) {
                refuse("a point");
            }
            read_row(rows, '>');
            take_if(',');
        }
    }

    /// Rows, numbers (a row) or objects between brackets.
    GeomValue read_list() {
        GeomRows rows;
        std::vector<std::size_t> objects;
        words_.next();
        while (!words_.is(']')) {
            if (words_.is('<') || words_.is('[')) {
                read_rows(rows);
            } else if (words_.is_name()) {
                const std::string_view name = take_name("an object");
                GeomValue value = named_value(name);
                auto* object = std::get_if<std::vector<std::size_t>>(&value);
                if (object == nullptr) {
                    throw GeomFault{fmt::format("there is no {}", shown(name)), "", ""};
                }
                objects.push_back(object->front());
            } else {
                rows.numbers.push_back(take_number());
            }
            take_if(',');
        }
        words_.next();
        if (!objects.empty()) {
            return objects;
        }
        if (rows.ends.empty() && !rows.numbers.empty()) {
            rows.ends.push_back(rows.numbers.size());
        }
        return rows;
    }

    GeomWords words_;
    Reporter& reporter_;
    UnknownKeywords unknown_objects_, unknown_fields_;
    GeomText text_;
    std::map<std::string_view, std::size_t> names_;
    int depth_ = 0;
};

}  // namespace

const GeomField* GeomObject::find(std::string_view field) const {
    for (const GeomField& each : fields) {
        if (each.name == field) {
            return &each;
        }
    }
    return nullptr;
}

std::optional<GeomText> read_geom_text(std::string_view text, Reporter& reporter) {
    return GeomReader(text, reporter).read();
}

}  // namespace quasimc
