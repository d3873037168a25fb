#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "files/output_files.h"
#include "grow_environment.h"
#include "grow_plant.h"
#include "picture/scene_picture.h"
#include "quasimc/error.h"
#include "show_values.h"
#include "show_view.h"

/// Whether the end of a file's name is that of a picture.
[[nodiscard]] bool is_picture_name(const std::string& path);

/// Pictures of a growing plant: one of the last step, or with a number in the name one of each
/// step. All have the same frame and the same scale, so they are drawn after the growth.
class GrowPictures {
  public:
    /// @param path  of the flag -o
    /// @param title  of the pictures
    /// @param inputs  files that were read; no picture may be one of them
    /// @throws InputError  for errors of the view, and if the first picture can't be written
    GrowPictures(
        std::string path,
        std::string title,
        const ViewArguments& view,
        std::vector<quasimc::InputFile> inputs);

    /// Adds a step, or replaces it. A plant without shapes has no picture.
    void add(GrownPlant& plant);
    /// Gives the organs of the last step their light, if the last pass was over it.
    /// @param environment  has light
    void set_light(const GrowEnvironment& environment);
    /// Draws and writes the pictures. @throws InputError  if there is no shape, or a file can't be
    /// written
    void write() const;

  private:
    struct Frame {
        std::int64_t step;
        std::shared_ptr<const quasimc::Scene> scene;
        ShownValues values = {};  ///< without estimates: no light is known
    };

    [[nodiscard]] quasimc::OutputPath path_of(std::int64_t step) const;
    [[nodiscard]] quasimc::ScenePicture picture_of(
        const Frame& frame, std::pair<double, double> range) const;

    std::string path_, title_, colors_;
    quasimc::ScenePicture base_;  // with the view
    std::pair<double, double> range_;
    std::vector<quasimc::InputFile> inputs_;
    std::vector<Frame> frames_;
    std::int64_t last_step_ = 0;
};
