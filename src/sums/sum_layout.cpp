#include "quasimc/sums.h"

namespace quasimc {

std::size_t SumLayout::detector(std::size_t index) const {
    std::size_t first = coarse_escaped() + 3 * coarse_bands();
    for (std::size_t i = 0; i < index; ++i) {
        first += detectors[i].bins;
    }
    return first;
}

std::vector<SumBlock> SumLayout::blocks() const {
    const auto of_regions = [&](std::string name, std::size_t first, std::size_t columns) {
        return SumBlock{std::move(name), first, regions, columns, stride()};
    };
    const auto of_run = [](std::string name, std::size_t first, std::size_t columns) {
        return SumBlock{std::move(name), first, 1, columns, columns};
    };
    std::vector<SumBlock> all{
        of_regions("direct_upper", direct(0, SurfaceSide::upper, 0), spectra),
        of_regions("direct_lower", direct(0, SurfaceSide::lower, 0), spectra),
        of_regions("scattered_upper", scattered(0, SurfaceSide::upper), bands),
        of_regions("scattered_lower", scattered(0, SurfaceSide::lower), bands),
        of_regions("sunlit", sunlit(0), 1),
        of_regions("absorbed_direct", absorbed_direct(0), absorbed_bands()),
        of_regions("absorbed_scattered", absorbed_scattered(0), absorbed_bands()),
        of_regions("unoccluded_upper", unoccluded(0, SurfaceSide::upper, 0), unoccluded_spectra()),
        of_regions(
            "unoccluded_lower", unoccluded(0, SurfaceSide::upper, 0) + unoccluded_spectra(),
            unoccluded_spectra()),
        of_regions("squares", squares(0, SurfaceSide::upper, 0), 2 * counted_kinds),
        of_regions(
            "coarse_scattered_upper", coarse_scattered(0, SurfaceSide::upper), coarse_bands()),
        of_regions(
            "coarse_scattered_lower", coarse_scattered(0, SurfaceSide::lower), coarse_bands()),
        of_run("emitted", emitted(), spectra),
        of_run("escaped_direct", escaped_direct(), spectra),
        of_run("escaped_scattered", escaped_scattered(), bands),
        of_run("scattered_out", scattered_out(), bands),
        of_run("cut_off", cut_off(), bands),
        of_run("rays", rays(), 1),
        of_run("coarse_escaped_scattered", coarse_escaped(), coarse_bands()),
        of_run("coarse_scattered_out", coarse_escaped() + coarse_bands(), coarse_bands()),
        of_run("coarse_cut_off", coarse_escaped() + 2 * coarse_bands(), coarse_bands())};
    for (std::size_t i = 0; i < detectors.size(); ++i) {
        all.push_back(of_run(detectors[i].name, detector(i), detectors[i].bins));
    }
    return all;
}

}  // namespace quasimc
