#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/output_files.h"
#include "grow_flags.h"
#include "grow_plant.h"
#include "quasimc/error.h"

/// A file to be written of a plant.
struct GrowOutput {
    quasimc::OutputPath file;
    std::function<void(GrownPlant&, const quasimc::TextSink&)> write;
    bool has_shapes = false;  ///< it has no content without shapes
};

/// The requested files.
/// @throws InputError  for a geometry format that can't be written
[[nodiscard]] std::vector<GrowOutput> grow_outputs(const GrowArguments& arguments);

/// Checks that no file of a step is another output.
/// @param last_step  of the growth
/// @throws InputError  with all that are
void check_numbered(const std::vector<GrowOutput>& outputs, std::int64_t last_step);

/// Writes the files of a plant: those with a number in their name at every step, the others at the
/// end.
class GrowWriters {
  public:
    /// Opens the files of the end, so that a wrong path is reported before anything grows.
    /// @param inputs  files that were read; no output may be one of them
    GrowWriters(std::vector<GrowOutput> outputs, std::vector<quasimc::InputFile> inputs);

    /// @throws InputError  if a file can't be written
    void write_step(GrownPlant& plant) const;
    /// Writes the files of the end, each as far as it can be written.
    /// @returns the reasons why some were not
    [[nodiscard]] quasimc::Faults finish(GrownPlant& plant);

  private:
    std::vector<GrowOutput> of_steps_, of_end_;
    std::vector<quasimc::InputFile> inputs_;
    quasimc::OutputFiles files_;  // of_end_
};
