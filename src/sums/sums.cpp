#include "quasimc/sums.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sums/light_blocks.h"
#include "sums/sum_data.h"

namespace quasimc {

namespace {

/// The number in a column of a block of the run, in all replicates; 0 if it was not declared.
std::uint64_t counted(const SumData& sums, std::string_view name, std::size_t column = 0) {
    const BlockBins block = sums.layout.find(name);
    std::uint64_t count = 0;
    for (const ExactBins& bins : sums.replicates) {
        count +=
            block.exists() ? static_cast<std::uint64_t>(bins.quanta(block.bin(0, column)).low) : 0;
    }
    return count;
}

/// Adds the bins of sums of one run.
void add_replicates(SumData& sums, const SumData& other) {
    const bool is_same_run =
        sums.layout == other.layout && sums.units == other.units && sums.bounds == other.bounds &&
        sums.strategies == other.strategies && sums.spectra == other.spectra &&
        sums.emitted_flux == other.emitted_flux && sums.measured == other.measured &&
        sums.escaped == other.escaped && sums.origins == other.origins &&
        sums.replicates.size() == other.replicates.size() &&
        sums.per_contribution.size() == other.per_contribution.size() &&
        sums.digest == other.digest;
    if (!is_same_run) {
        throw std::invalid_argument("sums of different runs can't be added");
    }
    for (std::size_t r = 0; r < sums.replicates.size(); ++r) {
        sums.replicates[r] += other.replicates[r];
    }
    for (std::size_t i = 0; i < sums.per_contribution.size(); ++i) {
        sums.per_contribution[i] = std::max(sums.per_contribution[i], other.per_contribution[i]);
    }
}

}  // namespace

Sums::Sums() : data_(std::make_unique<SumData>()) {}
Sums::Sums(SumData data) : data_(std::make_unique<SumData>(std::move(data))) {}
Sums::Sums(const Sums& other) : data_(std::make_unique<SumData>(*other)) {}
Sums::Sums(Sums&& other) noexcept : Sums() {
    data_.swap(other.data_);
}
Sums::~Sums() = default;

Sums& Sums::operator=(const Sums& other) {
    data_ = std::make_unique<SumData>(*other);
    return *this;
}

Sums& Sums::operator=(Sums&& other) noexcept {
    Sums taken(std::move(other));  // its previous data are destroyed with it
    data_.swap(taken.data_);
    return *this;
}

Sums& Sums::operator+=(const Sums& other) {
    add_replicates(*data_, *other);
    data_->paths += other->paths;
    data_->samples += other->samples;
    return *this;
}

Sums& Sums::add_share(const Sums& other) {
    if (data_->paths != other->paths || data_->samples != other->samples) {
        throw std::invalid_argument("shares with different numbers of paths can't be added");
    }
    add_replicates(*data_, *other);
    return *this;
}

std::uint64_t Sums::paths() const {
    return data_->paths;
}

std::uint64_t Sums::rays() const {
    return work_of(*data_, WorkUnit::ray) + work_of(*data_, WorkUnit::segment);
}

std::uint64_t Sums::digest() const {
    return data_->digest;
}

bool operator==(const Sums& a, const Sums& b) {
    return *a == *b;
}

const ContributionBound& SumData::bound(std::string_view quantity) const {
    static const ContributionBound kNone;
    const auto found = std::ranges::find(bounds, quantity, &ContributionBound::quantity);
    return found == bounds.end() ? kNone : *found;
}

std::uint64_t work_of(const SumData& sums, WorkUnit unit) {
    return counted(sums, kWork, static_cast<std::size_t>(unit));
}

double samples_of_scattered(const SumData& sums) {
    const std::uint64_t count = counted(sums, kScatteredCount);
    return count > 0 ? static_cast<double>(count) / static_cast<double>(sums.replicates.size())
                     : static_cast<double>(sums.samples);
}

SumData meaning_of(const SumData& sums) {
    return {
        .layout = sums.layout,
        .units = sums.units,
        .bounds = sums.bounds,
        .strategies = sums.strategies,
        .spectra = sums.spectra,
        .sun_spectra = sums.sun_spectra,
        .emitted_flux = sums.emitted_flux,
        .measured = sums.measured,
        .escaped = sums.escaped,
        .origins = sums.origins,
        .replicates = {},
        .per_contribution = sums.per_contribution};
}

Sums first_replicates(
    const Sums& sums, std::size_t count, std::uint64_t paths, std::uint64_t samples) {
    SumData first = meaning_of(*sums);
    const auto& all = sums->replicates;
    first.replicates.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
    first.paths = paths;
    first.samples = samples;
    return Sums(std::move(first));
}

}  // namespace quasimc
