#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/mesh/cell.h"
#include "geometry/scene_geometry.h"
#include "optics/material.h"
#include "quasimc/scene.h"
