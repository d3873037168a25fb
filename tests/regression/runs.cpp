#include "regression/runs.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "solvers/ray_bundles/ray_bundles.h"

namespace quasimc::test {
namespace {

/// The ways and their words, which the hash and the table rest on: not those of the library.
constexpr std::array<std::pair<std::string_view, Method>, 5> kWays{
    {{"sources", Method::light_tracing},
     {"organs", Method::from_organs},
     {"lit_surfaces", Method::first_hits},
     {"bundles", Method::ray_bundles},
     {"automatic", Method::automatic}}};

constexpr std::array kAllQuantities{Quantity::absorbed_flux,   Quantity::absorbed_flux_density,
                                    Quantity::incident_upper,  Quantity::incident_lower,
                                    Quantity::incident_direct, Quantity::incident_scattered};
static_assert(kAllQuantities.size() == kQuantities);

std::string_view word_of(Method way) {
    for (const auto& [word, value] : kWays) {
        if (value == way) {
            return word;
        }
    }
    return "unknown";
}

/// Whether a case can be computed in a way.
bool is_offered(const Case& c, Method method) {
    Faults faults;
    if (method == Method::ray_bundles) {
        check_diffuse(c.scene, faults);
    }
    return faults.empty();
}

/// A number for why a run stopped: not the library's own.
std::uint64_t number_of(StopReason reason) {
    switch (reason) {
        case StopReason::finished:
            return 1;
        case StopReason::target_reached:
            return 2;
        case StopReason::time_limit:
            return 3;
        case StopReason::path_limit:
            return 4;
        case StopReason::interrupted:
            return 6;
        case StopReason::no_light:
            break;
    }
    return 5;
}

/// Fowler, Noll and Vo: FNV-1a (draft-eastlake-fnv), of words whose lowest byte comes first.
class Hash {
  public:
    void add(std::uint64_t word) {
        for (int i = 0; i < 8; ++i) {
            state_ = (state_ ^ (word >> (8 * i) & 0xffU)) * 0x100000001b3U;
        }
    }
    void add(double x) {
        add(std::bit_cast<std::uint64_t>(
            std::isnan(x) ? std::numeric_limits<double>::quiet_NaN() : x));
    }
    void add(const Estimate& e) {
        for (const double x : {e.mean, e.standard_error, e.ci95_low, e.ci95_high}) {
            add(x);
        }
    }
    void add(const std::vector<Estimate>& estimates) {
        add(std::uint64_t{estimates.size()});
        for (const Estimate& e : estimates) {
            add(e);
        }
    }
    void add(const BandBudget& b) {
        add(b.emitted);
        for (const Estimate& e :
             {b.absorbed_by_organs, b.absorbed_by_ground, b.escaped, b.cut_off, b.imbalance}) {
            add(e);
        }
        add(b.closure_error);
    }
    void add(const Audit& audit) {
        add(audit.paths);
        add(std::uint64_t{audit.replicates});
        for (const BandAudit& b : audit.bands) {
            for (const double x :
                 {b.reduced_chi_square, b.freedom, b.chi_square_p_value, b.difference,
                  b.standard_error, b.difference_p_value}) {
                add(x);
            }
        }
        add(audit.p_value);
    }

    [[nodiscard]] std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 0xcbf29ce484222325U;
};

void add_values(Hash& hash, const Result& result) {
    hash.add(std::uint64_t{result.organs()});
    hash.add(std::uint64_t{result.bands});
    for (std::size_t organ = 0; organ < result.organs(); ++organ) {
        for (const Quantity q : kAllQuantities) {
            for (std::size_t band = 0; band < result.bands; ++band) {
                hash.add(result.at(organ, q, band));
            }
        }
    }
}

}  // namespace

const std::vector<std::string_view>& all_ways() {
    static const std::vector<std::string_view> ways = [] {
        std::vector<std::string_view> words;
        for (const auto& [word, value] : kWays) {
            words.push_back(word);
        }
        return words;
    }();
    return ways;
}

std::vector<std::string_view> ways_of(const Case& c) {
    std::vector<std::string_view> words;
    for (const auto& [word, method] : kWays) {
        if (is_offered(c, method)) {
            words.push_back(word);
        }
    }
    return words;
}

std::uint64_t digest_of(const Result& result) {
    Hash hash;
    add_values(hash, result);
    hash.add(result.sunlit_fraction);
    hash.add(std::uint64_t{result.ratios});
    hash.add(result.ratio_values);
    for (const BandBudget& budget : result.budget) {
        hash.add(budget);
    }
    hash.add(std::uint64_t{result.escaped_by_difference ? 1U : 0U});
    for (const char c : word_of(result.chosen.method)) {
        hash.add(std::uint64_t{static_cast<unsigned char>(c)});
    }
    if (result.audit) {
        hash.add(*result.audit);
    }
    hash.add(result.paths);
    hash.add(std::uint64_t{result.replicates});
    hash.add(result.rays);
    hash.add(number_of(result.stop));
    hash.add(result.fraction_at_target);
    return hash.value();
}

Result run_case(const Case& c, std::string_view way, const Variant& variant) {
    RunSpec spec = c.spec;
    for (const auto& [word, value] : kWays) {
        if (word == way) {
            spec.method = value;
        }
    }
    spec.threads = variant.threads;
    spec.seed = variant.seed;
    return run(c.scene, c.sources, spec);
}

Row row_of(std::string_view name, std::string_view way, const Result& result) {
    Row row{
        .name = std::string(name),
        .way = std::string(way),
        .chosen = std::string(word_of(result.chosen.method)),
        .digest = digest_of(result),
        .paths = result.paths,
        .rays = result.rays};
    double known = 0;
    for (std::size_t organ = 0; organ < result.organs(); ++organ) {
        for (std::size_t band = 0; band < result.bands; ++band) {
            const Estimate& e = result.at(organ, Quantity::absorbed_flux, band);
            if (std::isnan(e.mean)) {
                continue;
            }
            ++known;
            row.absorbed += e.mean;
            row.error += std::isnan(e.standard_error) ? 0 : e.standard_error;
        }
    }
    row.absorbed /= known;
    row.error /= known;
    return row;
}

std::string line_of(const Row& row) {
    return fmt::format(
        "{:<33} {:<12} {:<12} {:016x} {:<22} {:<22} {:>6} {:>8}", row.name, row.way, row.chosen,
        row.digest, row.absorbed, row.error, row.paths, row.rays);
}

std::string heading() {
    return fmt::format(
        "{:<33} {:<12} {:<12} {:<16} {:<22} {:<22} {:>6} {:>8}", "# case", "asked", "chosen",
        "digest", "absorbed", "error", "paths", "rays");
}

}  // namespace quasimc::test
