// @Words@: what point set it is.
//
// What     Independent random numbers.
// Paper    Author (year), journal.
// Points   Any number.
// Theory   docs/theory/@page@.md

#include <memory>

#include "samplers/monte_carlo.h"
#include "samplers/sampler.h"

namespace quasimc {
namespace {

class @Name@ final : public Sampler {
  public:
    double number(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const override {
        Stream own = stream;
        own.sequence = ~stream.sequence;  // other numbers than those of monte_carlo
        return random_number(own, point, dimension);
    }
};

}  // namespace

/// The sampler `@name@` of the catalogue.
std::unique_ptr<Sampler> make_@name@() {
    return std::make_unique<@Name@>();
}

}  // namespace quasimc
