#pragma once

// The public API of QuasiMC in one include. README.md and docs/guide show how to use it; the
// shortest program is
//
//   const quasimc::RunFile file = quasimc::read_run_file("leaves.toml");
//   const quasimc::Result result = quasimc::run(file.scene, file.sources, file.spec);

#include "quasimc/base/input_error.h"
#include "quasimc/base/orientation.h"
#include "quasimc/base/vec3.h"
#include "quasimc/base/version.h"
#include "quasimc/geometry/shapes.h"
#include "quasimc/geometry/triangle.h"
#include "quasimc/io/options.h"
#include "quasimc/io/read_result.h"
#include "quasimc/io/run_file.h"
#include "quasimc/io/write_result.h"
#include "quasimc/io/write_series.h"
#include "quasimc/optics/catalogue.h"
#include "quasimc/optics/material.h"
#include "quasimc/samplers/catalogue.h"
#include "quasimc/scene/scene.h"
#include "quasimc/scene/scene_builder.h"
#include "quasimc/sources/civil_time.h"
#include "quasimc/sources/lamp.h"
#include "quasimc/sources/sky.h"
#include "quasimc/sources/sky_table.h"
#include "quasimc/sources/source.h"
#include "quasimc/sources/sun_position.h"
#include "quasimc/tallies/statistics.h"
#include "quasimc/tracing/planner.h"
#include "quasimc/tracing/result.h"
#include "quasimc/tracing/run.h"
#include "quasimc/tracing/run_spec.h"
#include "quasimc/tracing/series.h"
#include "quasimc/tracing/simulator.h"
