#include "quasimc/share.h"

namespace quasimc {

// tasks * n may have more than 64 digits. With tasks = q * of + r it is q * n + r * n / of, and
// r * n / of is found by long division, one binary digit of n after the other.
std::uint64_t Share::until(std::uint64_t tasks, std::uint64_t n) const {
    std::uint64_t quotient = 0, remainder = 0;
    const auto add = [&](std::uint64_t amount) {  // amount < of
        if (remainder >= of - amount) {
            remainder -= of - amount;
            ++quotient;
        } else {
            remainder += amount;
        }
    };
    for (int digit = 63; digit >= 0; --digit) {
        quotient *= 2;
        add(remainder);
        if ((n >> static_cast<unsigned>(digit)) % 2 == 1) {
            add(tasks % of);
        }
    }
    return tasks / of * n + quotient;
}

}  // namespace quasimc
