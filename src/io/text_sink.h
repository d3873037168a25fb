#pragma once

#include <functional>
#include <string_view>

namespace quasimc {

/// Takes text in pieces.
using TextSink = std::function<void(std::string_view)>;

}  // namespace quasimc
