// In place of png.cpp where libpng is not installed.

#include <stdexcept>

#include "view/picture.h"

namespace quasimc {

bool has_png() {
    return false;
}

std::string to_png([[maybe_unused]] const Picture& picture) {
    throw std::logic_error("built without libpng");
}

}  // namespace quasimc
