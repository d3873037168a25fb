#pragma once

#include <string>
#include <utility>
#include <vector>

#include "picture/scene_picture.h"
#include "show_values.h"

/// The mapping of values to colours.
struct ScaleChoice {
    bool error = false;                    ///< show the standard error, per cent of the value
    std::string colors = "viridis";        ///< name of a colour map
    std::pair<double, double> range = {};  ///< see quasimc::scale_of
};

// Each gives every organ of a picture its colour, and the picture its second title and legend.

void color_plainly(const quasimc::Scene& scene, quasimc::ScenePicture& picture);
/// One colour for each value of a label.
/// @throws quasimc::InputError  if no organ has it
void color_by_label(
    const quasimc::Scene& scene, const std::string& key, quasimc::ScenePicture& picture);
void color_by_value(
    const quasimc::Scene& scene,
    const ShownValues& values,
    const ScaleChoice& choice,
    quasimc::ScenePicture& picture);

/// Directions towards the suns in a picture: all suns, or with [time] those of the shown time.
/// @param values  shown values, or null
[[nodiscard]] std::vector<quasimc::Vec3> suns_of(
    const quasimc::RunFile& run, const ShownValues* values);

/// Checks the ending of a picture's name, if it has one; pipes have none.
/// @param where  for the message
/// @throws quasimc::InputError  for an ending of another format
void check_picture_name(const std::string& where, const std::string& path);

/// @throws quasimc::InputError  if the program was built without pictures
/// @param where  for the message
void require_pictures(const std::string& where);
