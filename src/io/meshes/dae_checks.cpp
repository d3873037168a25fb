// What a COLLADA file says of itself, against what is there.

#include <fmt/format.h>

#include "base/text.h"
#include "io/meshes/dae_library.h"
#include "io/numbers.h"

namespace quasimc {

void DaeLibrary::check_count(std::size_t element, std::size_t found, bool is_part) {
    const std::string_view stated = tree_[element].attribute("count");
    const auto count = parse_integer(trimmed(stated));
    const auto number = static_cast<std::uint64_t>(count.value_or(0));
    const bool is_right = stated.empty() || (count && *count >= 0 &&
                                             (number == found || (is_part && number < found)));
    if (!is_right && ++wrong_counts_ == 1) {
        first_wrong_ = fmt::format(
            "<{}> of line {} states {} and has {}", tree_[element].name, tree_[element].line,
            shown(stated), found);
    }
}

/// @param corners  in all lists of the primitive
void DaeLibrary::check_faces(std::size_t primitive, std::size_t corners) {
    const std::string_view kind = tree_[primitive].name;
    std::size_t faces = tree_.children(primitive, "p").size();
    if (kind == "triangles") {
        faces = corners / 3;
    } else if (kind == "polylist") {
        const auto sizes = tree_.child(primitive, "vcount");
        std::string_view text = sizes ? tree_[*sizes].text : std::string_view();
        for (faces = 0; !take_word(text, kDaeBlanks).empty();) {
            ++faces;
        }
    } else if (kind == "polygons") {
        faces += tree_.children(primitive, "ph").size();
    }
    check_count(primitive, faces);
}

void DaeLibrary::check_children(std::size_t element, std::span<const std::string_view> known) {
    for (const std::size_t child : tree_[element].children) {
        unknown_.check(tree_[child].name, fmt::format("line {}", tree_[child].line), known);
    }
}

void DaeLibrary::finish() {
    crossed_.warn(reporter_);
    unknown_.warn("elements that COLLADA does not have there", reporter_);
    if (wrong_counts_ > 0) {
        reporter_.warnings.push_back(
            {reporter_.file,
             fmt::format(
                 "counts differ from what is there ({} in all; the first: {}): the file may be cut "
                 "short or damaged",
                 wrong_counts_, first_wrong_)});
    }
    if (repeated_ids_ > 0) {
        reporter_.warnings.push_back(
            {reporter_.file,
             fmt::format(
                 "ids occur twice ({} in all, the first is {}): the element that comes first is "
                 "taken",
                 repeated_ids_, first_repeated_)});
    }
    if (left_out_ > 0) {
        reporter_.warnings.push_back(
            {reporter_.file, fmt::format("{} parts are lines: left out", left_out_)});
    }
}

}  // namespace quasimc
