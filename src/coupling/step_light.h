#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

inline constexpr std::uint32_t kNoOrgan = std::numeric_limits<std::uint32_t>::max();

/// The light of one step: the scene, and the results of all bands together or of each by itself.
struct StepLight {
    std::optional<Scene> scene;         ///< none: there was nothing to light, or no light
    std::vector<Result> results;        ///< of a band without light: empty
    std::vector<std::uint32_t> organs;  ///< of the scene, for each query; or kNoOrgan

    /// Light on an organ of the scene (0 on kNoOrgan, and where nothing was traced).
    [[nodiscard]] Estimate at(std::uint32_t organ, Quantity quantity, std::size_t band) const {
        const bool together = results.size() == 1;
        const std::size_t index = together ? 0 : band;
        if (organ == kNoOrgan || index >= results.size() || results[index].values.empty()) {
            return {};
        }
        return results[index].at(organ, quantity, together ? band : 0);
    }
    /// The part of an organ's area that parallel light reaches; nothing if there is no such light.
    [[nodiscard]] std::optional<Estimate> sunlit(std::uint32_t organ) const {
        for (const Result& result : results) {
            if (organ != kNoOrgan && !result.sunlit_fraction.empty()) {
                return reported(result.sunlit_fraction[organ]);
            }
        }
        return std::nullopt;
    }
};

}  // namespace quasimc
