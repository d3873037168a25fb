#pragma once

#include <cstdint>

namespace quasimc {

/// An index that can't be taken for another kind of index. `value` counts from 0.
template <typename Tag>
struct Id {
    std::uint32_t value = 0;
    friend constexpr bool operator==(Id, Id) = default;
    friend constexpr auto operator<=>(Id, Id) = default;
};

using MaterialId = Id<struct MaterialTag>;
using OrganIndex = Id<struct OrganTag>;  ///< place in the scene's list; an organ's id is the user's
using RegionIndex = Id<struct ElementTag>;  ///< a part of an organ that is of one material

}  // namespace quasimc
