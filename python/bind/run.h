#pragma once

#include "runfile/run_file.h"

namespace quasimc::python {

/// What light falls on a scene and how it is computed.
struct LightHandle {
    LightOfRun light;
};

}  // namespace quasimc::python
