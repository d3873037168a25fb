#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

inline constexpr std::uint32_t kNoOrgan = std::numeric_limits<std::uint32_t>::max();

/// The light of one step: the scene, and one result for all bands, or one per band.
struct StepLight {
    std::optional<Scene> scene;         ///< none without organs or without light
    std::vector<Result> results;        ///< empty for a band without light
    std::vector<std::uint32_t> organs;  ///< index in the scene, for each query; or kNoOrgan

    /// Light on an organ of the scene (0 on kNoOrgan, and where nothing was computed).
    [[nodiscard]] Estimate at(std::uint32_t organ, Quantity quantity, std::size_t band) const {
        const bool together = results.size() == 1;
        const std::size_t index = together ? 0 : band;
        if (organ == kNoOrgan || index >= results.size() || results[index].values.empty()) {
            return {};
        }
        return results[index].at(organ, quantity, together ? band : 0);
    }
    /// The sunlit fraction of an organ's area; empty without parallel light.
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
