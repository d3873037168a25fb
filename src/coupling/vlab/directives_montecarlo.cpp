// Directives of MonteCarlo alone, except for the light and the domain.

#include <array>

#include "coupling/vlab/directive_table.h"

namespace quasimc {
namespace {

void pass_over(Values& values, DirectiveContext& /*context*/) {
    static_cast<void>(values.rest());
}

/// Without a value the directive means yes.
void read_no_direct(Values& values, DirectiveContext& context) {
    const bool ignores = values.at_end() || values.yes_no().value_or(false);
    context.spec.run.direct_light = ignores ? DirectLight::excluded : DirectLight::included;
}

constexpr std::array kMontecarloDirectives{
    DirectiveEntry{"version", Dialect::montecarlo, pass_over},
    DirectiveEntry{"no direct light", Dialect::montecarlo, read_no_direct},
};

}  // namespace

std::span<const DirectiveEntry> montecarlo_directives() {
    return kMontecarloDirectives;
}

}  // namespace quasimc
