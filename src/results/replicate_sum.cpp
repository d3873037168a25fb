#include "results/replicate_sum.h"

#include "base/checks.h"

namespace quasimc {

void ReplicateSum::add(const CombinedReplicates& light, double weight) {
    EXPECT(light.values.size() == values_.size() && light.sizes.size() == amounts_);
    for (std::size_t i = 0; i < values_.size(); ++i) {
        values_[i] += weight * light.values[i];
    }
    for (std::size_t i = 0; i < amounts_; ++i) {
        of_point_[i] = both(of_point_[i], light.sizes[i] * weight);
    }
}

void ReplicateSum::end_point() {
    for (std::size_t i = 0; i < amounts_; ++i) {
        sizes_[i].more += of_point_[i].more;
        sizes_[i].less += of_point_[i].less;
        of_point_[i] = {};
    }
}

std::vector<double> ReplicateSum::values(std::size_t amount) const {
    std::vector<double> own(replicates());
    for (std::size_t r = 0; r < own.size(); ++r) {
        own[r] = values_[r * amounts_ + amount];
    }
    return own;
}

Estimate ReplicateSum::estimate(std::size_t amount, double factor) const {
    return scaled(estimate_contributions(values(amount), sizes_[amount]), factor);
}

}  // namespace quasimc
