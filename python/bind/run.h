#pragma once

#include "runfile/run_file.h"

namespace quasimc::python {

/// The light on a scene and the options of its computation.
struct LightHandle {
    LightOfRun light;
};

}  // namespace quasimc::python
