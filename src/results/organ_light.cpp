#include <variant>

#include <fmt/format.h>

#include "quasimc/error.h"
#include "quasimc/result.h"
#include "quasimc/scene.h"

namespace quasimc {
namespace {

const SceneNames& names_of(const Result& result) {
    if (!result.names) {
        throw InputError({{"result", "it has no names", "it was created without a scene", ""}});
    }
    return *result.names;
}

}  // namespace

OrganLight Result::operator[](std::string_view organ) const& {
    return {*this, names_of(*this).organ_index(organ)};
}

OrganLight Result::operator[](std::size_t index) const& {
    const std::size_t count = names_of(*this).organs().size();
    if (index >= count) {
        throw InputError(
            {{fmt::format("organ {}", index), "no organ of the scene has this index", "",
              fmt::format("it has {}, counted from 0", count)}});
    }
    return {*this, index};
}

OrganLight Result::organ(std::int64_t id) const& {
    return {*this, names_of(*this).organ_index(id)};
}

std::size_t BandKey::index(const SceneNames& names) const {
    if (const auto* name = std::get_if<std::string>(&key_)) {
        return names.band_index(*name);
    }
    const std::size_t index = std::get<std::size_t>(key_);
    if (index >= names.bands().size()) {
        throw InputError(
            {{fmt::format("band {}", index), "no band of the scene has this index", "",
              fmt::format("it has {}, counted from 0", names.bands().size())}});
    }
    return index;
}

Estimate OrganLight::at(Quantity quantity, const BandKey& band) const {
    return result_->at(index_, quantity, band.index(names_of(*result_)));
}

Estimate OrganLight::sunlit_fraction() const {
    if (result_->sunlit_fraction.empty()) {
        throw InputError({{"sunlit_fraction", "no source is a sun", "", ""}});
    }
    return result_->sunlit_fraction[index_];
}

}  // namespace quasimc
