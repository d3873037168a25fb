#pragma once

// The public API of QuasiMC in one include. README.md and docs/guide show how to use it; the
// shortest program is
//
//   const quasimc::RunFile file = quasimc::read_run_file("leaves.toml");
//   const quasimc::Result result = quasimc::run(file.scene, file.sources, file.spec);

#include "base/input_error.h"
#include "base/orientation.h"
#include "base/vec3.h"
#include "base/version.h"
#include "detectors/catalogue.h"
#include "geometry/mesh/triangle.h"
#include "geometry/shapes/shapes.h"
#include "io/results/read_result.h"
#include "io/results/write_result.h"
#include "io/runfile/options.h"
#include "io/runfile/run_file.h"
#include "optics/catalogue.h"
#include "optics/material.h"
#include "results/result.h"
#include "run/run.h"
#include "run/series.h"
#include "run/simulator.h"
#include "samplers/catalogue.h"
#include "scene/scene.h"
#include "scene/scene_builder.h"
#include "solvers/planner.h"
#include "solvers/run_spec.h"
#include "sources/civil_time.h"
#include "sources/lamp.h"
#include "sources/sky.h"
#include "sources/sky_table.h"
#include "sources/source.h"
#include "sources/sun_position.h"
#include "sums/statistics.h"
