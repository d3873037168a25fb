#include "grow_pictures.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "coupling/lighting.h"
#include "numbered_path.h"
#include "show_colors.h"

bool is_picture_name(const std::string& path) {
    return quasimc::lower_case(std::filesystem::path(path).extension().string()) == ".png";
}

GrowPictures::GrowPictures(
    std::string path,
    std::string title,
    const ViewArguments& view,
    std::vector<quasimc::InputFile> inputs)
    : path_(std::move(path)),
      title_(std::move(title)),
      colors_(view.colors),
      inputs_(std::move(inputs)) {
    require_pictures("-o");
    quasimc::Faults faults;
    range_ = range_of(view, faults);
    set_view(view, quasimc::plant_orientation(), base_, faults);
    faults.throw_if_any();
    // Opens the first file and abandons it, so that a wrong path is reported before the growth.
    const quasimc::OutputFiles first({path_of(0)}, inputs_);
}

quasimc::OutputPath GrowPictures::path_of(std::int64_t step) const {
    return {numbered_path(path_, step).value_or(path_), "-o"};
}

void GrowPictures::add(GrownPlant& plant) {
    last_step_ = plant.step();
    const bool stays =
        numbered_path(path_, 0) && !frames_.empty() && frames_.back().step != last_step_;
    if (!stays && !frames_.empty()) {
        frames_.pop_back();
    }
    if (plant.scene()) {
        frames_.push_back({last_step_, plant.scene()});
    }
}

void GrowPictures::set_light(const GrowEnvironment& environment) {
    if (frames_.empty() || frames_.back().step != environment.pass_step()) {
        return;
    }
    Frame& frame = frames_.back();
    std::vector<ShownValues> all =
        light_values(environment.light(), environment.light_of(*frame.scene));
    const auto absorbed = std::find_if(all.begin(), all.end(), [](const ShownValues& values) {
        return values.key.starts_with("absorbed_flux_density");
    });
    if (absorbed != all.end()) {
        frame.values = std::move(*absorbed);
    }
}

quasimc::ScenePicture GrowPictures::picture_of(
    const Frame& frame, std::pair<double, double> range) const {
    quasimc::ScenePicture picture = base_;
    if (frame.values.estimates.empty()) {
        color_plainly(*frame.scene, picture);
    } else {
        color_by_value(*frame.scene, frame.values, {false, colors_, range}, picture);
    }
    picture.title = fmt::format("{}, step {}", title_, frame.step);
    return picture;
}

void GrowPictures::write() const {
    if (frames_.empty()) {
        throw quasimc::InputError(
            {{path_, fmt::format("the plant of step {} has no shape", last_step_), "",
              "check the homomorphism of the model; --string writes the string"}});
    }
    std::pair<double, double> range = range_;
    quasimc::Bounds box;
    std::vector<quasimc::OutputPath> paths;
    const bool is_automatic = range.first == range.second;
    for (const Frame& frame : frames_) {
        box.include(frame.scene->bounds());
        paths.push_back(path_of(frame.step));
        const quasimc::Legend legend = picture_of(frame, {}).legend;
        if (is_automatic && !frame.values.estimates.empty()) {
            range = {std::min(range.first, legend.low), std::max(range.second, legend.high)};
        }
    }
    quasimc::OutputFiles files(paths, inputs_);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        quasimc::ScenePicture picture = picture_of(frames_[i], range);
        picture.framed = box;
        files.sink(i)(quasimc::draw_scene(*frames_[i].scene, picture));
    }
    files.commit();
    files.throw_if_given_up();
}
