#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/notices.h"
#include "files/input_files.h"
#include "growth/view/view.h"
#include "quasimc/error.h"

namespace quasimc {

struct PlantProgram;  // growth/language/program.h

/// A model of cpfg's language: an L-system with its view file, checked and compiled; const.
class PlantModel {
  public:
    /// Reads a model and its view file, if `view` is not empty. Files that they name are relative
    /// to the folder of the file that names them.
    /// @throws InputError  with all faults that were found
    /// @param reader  reads all of them
    [[nodiscard]] static std::shared_ptr<const PlantModel> read(
        const std::string& model,
        const std::string& view,
        Notices& notices,
        InputFiles::Reader reader = read_file);

    ~PlantModel();
    PlantModel(const PlantModel&) = delete;
    PlantModel& operator=(const PlantModel&) = delete;

    [[nodiscard]] const View& view() const;
    /// The number after "derivation length:".
    [[nodiscard]] std::int64_t steps() const;
    /// Whether the model has queries, ?E.
    [[nodiscard]] bool asks_environment() const;
    [[nodiscard]] const std::vector<InputFile>& inputs() const;

    [[nodiscard]] const PlantProgram& program() const { return *program_; }

  private:
    PlantModel();
    std::unique_ptr<PlantProgram> program_;
};

}  // namespace quasimc
