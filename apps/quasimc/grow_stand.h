#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "base/notices.h"
#include "coupling/plants/light_on_stand.h"

/// Whether a file of light is a run file, by its ending.
[[nodiscard]] bool is_stand_file(const std::string& path);

/// The light of a run file as the stand in which a plant grows: its scene, sources and options. A
/// module has the material whose name is its symbol, if there is one, or else the first one.
/// @param sides  of cylinders, spheres and discs
/// @param notices  receives the warnings; outlives the light
/// @param stop  ends the computation of light
/// @throws InputError  for errors of the file, except those of its light, which the first pass
///         reports
[[nodiscard]] std::unique_ptr<quasimc::LightOnStand> read_stand(
    const std::string& path, int sides, quasimc::Notices& notices, const std::stop_token& stop);
