// Compiled once for each vector unit: foreach_target.h includes this file repeatedly.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "series/basis/add_responses.cpp"
#include "series/basis/add_responses.h"

#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quasimc {
namespace HWY_NAMESPACE {
namespace {

// Products and sums, not MulAdd, which rounds differently on machines with a fused one.
namespace hn = hwy::HWY_NAMESPACE;

/// One number, or a vector of them, of some responses.
template <typename D>
struct Terms {
    using Vector = hn::Vec<D>;
    Vector first, second, third, fourth;

    Terms(D d, const float* const* from, std::size_t at)
        : first(read(d, from[0] + at)),
          second(read(d, from[1] + at)),
          third(read(d, from[2] + at)),
          fourth(read(d, from[3] + at)) {}

    static Vector read(D d, const float* from) {
        return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), from));
    }
    /// Adds them to a sum.
    /// @param factors  one per response, at a distance of `stride`
    Vector add_to(Vector sum, D d, const double* factors, std::size_t stride) const {
        const auto times = [&](std::size_t k, Vector x) {
            return hn::Mul(hn::Set(d, factors[k * stride]), x);
        };
        const Vector both = hn::Add(times(0, first), times(1, second));
        const Vector others = hn::Add(times(2, third), times(3, fourth));
        return hn::Add(sum, hn::Add(both, others));
    }
};

/// The sums to which responses are added.
struct Target {
    const double* factors;
    double* const* to;
    std::size_t sums;
};

/// Four sums, from position `at` on.
template <typename D>
void add_at(
    D d, const float* const* from, std::size_t responses, std::size_t at, const Target& target) {
    auto a = hn::LoadU(d, target.to[0] + at), b = hn::LoadU(d, target.to[1] + at);
    auto c = hn::LoadU(d, target.to[2] + at), e = hn::LoadU(d, target.to[3] + at);
    for (std::size_t k = 0; k < responses; k += kAddedAtOnce) {
        const Terms<D> terms(d, from + k, at);
        const double* factors = target.factors + k * target.sums;
        a = terms.add_to(a, d, factors, target.sums);
        b = terms.add_to(b, d, factors + 1, target.sums);
        c = terms.add_to(c, d, factors + 2, target.sums);
        e = terms.add_to(e, d, factors + 3, target.sums);
    }
    hn::StoreU(a, d, target.to[0] + at);
    hn::StoreU(b, d, target.to[1] + at);
    hn::StoreU(c, d, target.to[2] + at);
    hn::StoreU(e, d, target.to[3] + at);
}

void add_responses(
    const float* const* from,
    const double* factors,
    std::size_t responses,
    std::size_t count,
    std::size_t sums,
    double* const* to) {
    constexpr hn::CappedTag<double, 8> kNumbers;
    constexpr hn::CappedTag<double, 1> kOne;
    const std::size_t lanes = hn::Lanes(kNumbers);
    for (std::size_t s = 0; s < sums; s += kAddedAtOnce) {
        const Target target{factors + s, to + s, sums};
        std::size_t at = 0;
        for (; at + lanes <= count; at += lanes) {
            add_at(kNumbers, from, responses, at, target);
        }
        for (; at < count; ++at) {
            add_at(kOne, from, responses, at, target);
        }
    }
}

AddResponses variant_of_add_responses() {
    return &add_responses;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quasimc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quasimc {

HWY_EXPORT(variant_of_add_responses);

AddResponses best_add_responses() {
    return HWY_DYNAMIC_DISPATCH(variant_of_add_responses)();
}

}  // namespace quasimc
#endif
