#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

namespace quasimc::test {

/// A line of /proc/self/status in bytes ("VmRSS", "VmHWM"); 0 where there is none.
[[nodiscard]] inline double status_bytes(const std::string& key) {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with(key + ":")) {
            return 1024 * std::atof(line.c_str() + key.size() + 1);
        }
    }
    return 0;
}

}  // namespace quasimc::test
