#pragma once

// The public interface of QuasiMC in one include; docs/guide/libraries.md shows how to use it. The
// shortest program is
//
//   const quasimc::RunFile file = quasimc::read_run_file("leaves.toml");
//   const quasimc::Result result = quasimc::run(file.scene, file.sources, file.spec);

#include "quasimc/error.h"
#include "quasimc/gap_fraction.h"
#include "quasimc/lamp_control.h"
#include "quasimc/material.h"
#include "quasimc/mesh.h"
#include "quasimc/result.h"
#include "quasimc/result_file.h"
#include "quasimc/run.h"
#include "quasimc/run_file.h"
#include "quasimc/run_spec.h"
#include "quasimc/scene.h"
#include "quasimc/series.h"
#include "quasimc/share.h"
#include "quasimc/source.h"
#include "quasimc/sums.h"
#include "quasimc/sun_shade.h"
#include "quasimc/version.h"
