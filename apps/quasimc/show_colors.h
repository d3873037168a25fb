#pragma once

#include <string>
#include <utility>
#include <vector>

#include "picture/scene_picture.h"
#include "show_values.h"

/// The mapping of values to colours.
struct ScaleChoice {
    bool error = false;                    ///< show classes of the relative standard error
    std::string colors = "viridis";        ///< name of a colour map
    std::pair<double, double> range = {};  ///< see quasimc::scale_of
};

// Each gives every organ of a picture its colour, and the picture its second title and legend.

void color_plainly(const quasimc::Scene& scene, quasimc::ScenePicture& picture);
/// One colour for each value of a label; a scale for many numbers.
/// @throws quasimc::InputError  if no organ has it
void color_by_label(
    const quasimc::Scene& scene, const std::string& key, quasimc::ScenePicture& picture);
void color_by_value(
    const quasimc::Scene& scene,
    const ShownValues& values,
    const ScaleChoice& choice,
    quasimc::ScenePicture& picture);

/// The sources of a run, or with [time] those of a time step; null if there is no such step.
/// @param when  ShownValues::when
[[nodiscard]] const quasimc::Sources* sources_at(
    const quasimc::RunFile& run, const std::string& when);
/// Directions towards the suns in a picture: all; of a time step, whose suns are positions of one,
/// the mean direction.
/// @param sources  null: none
[[nodiscard]] std::vector<quasimc::Vec3> suns_of(
    const quasimc::Sources* sources, bool is_time_step);

/// Checks the ending of a picture's name, if it has one; pipes have none.
/// @param where  for the message
/// @throws quasimc::InputError  for an ending of another format
void check_picture_name(const std::string& where, const std::string& path);

/// @throws quasimc::InputError  if the program was built without pictures
/// @param where  for the message
void require_pictures(const std::string& where);
