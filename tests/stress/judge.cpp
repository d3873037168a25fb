#include "stress/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>

#include "planner/lint_wedges.h"
#include "stress/checks.h"
#include "stress/near_surfaces.h"
#include "sums/statistics.h"

namespace quasimc::stress {
namespace {

/// New random numbers for every test of every scene.
Effort seeded(Effort effort, std::uint64_t number, std::uint64_t test) {
    effort.seed = mix64(mix64(number) + test) >> 1;
    return effort;
}

std::vector<Answer> answers_of(const Case& it, const std::vector<Way>& ways, const Effort& effort) {
    std::vector<Answer> answers;
    for (const Way way : ways) {
        Effort own = effort;
        own.seed = mix64(effort.seed + static_cast<std::uint64_t>(way)) >> 1;
        answers.push_back(compute(it, way, own));
    }
    return answers;
}

/// The mean of answers of many seeds, with its standard error from their scatter.
Answer pooled(const std::vector<Answer>& answers) {
    Answer all{answers[0].way, static_cast<double>(answers.size()) - 1, {}, std::nullopt};
    for (std::size_t i = 0; i < answers[0].numbers.size(); ++i) {
        std::vector<double> means;
        double high = 0;
        bool is_known = false, is_found = false;
        for (const Answer& answer : answers) {
            const Number& n = answer.numbers[i];
            means.push_back(n.mean);
            high = std::max(high, n.high);
            is_known = is_known || n.is_known;
            is_found = is_found || n.mean != 0 || !std::isnan(n.error);
        }
        const Estimate e = estimate_mean(means);
        Number number{e.mean, e.standard_error, e.ci95_low, e.ci95_high, is_known};
        if (!is_found) {
            number.error = std::nan("");
            number.high = high / static_cast<double>(answers.size());
        }
        all.numbers.push_back(number);
    }
    return all;
}

/// Number of intervals that do not overlap the range of the truth. @param slack  half the width of
/// this range
unsigned count_misses(
    const std::vector<Answer>& answers, std::size_t number, double truth, double slack) {
    unsigned misses = 0;
    for (const Answer& answer : answers) {
        const Number& n = answer.numbers[number];
        misses += truth - slack > n.high || truth + slack < n.low ? 1 : 0;
    }
    return misses;
}

/// The probability of at least this number of misses, by the F distribution for binomial sums
/// (Abramowitz and Stegun 26.5.28).
double p_value_of_misses(unsigned misses, unsigned tries, double each) {
    if (misses == 0) {
        return 1;
    }
    const double above = 2.0 * (tries - misses + 1);
    const double below = 2.0 * misses;
    return f_tail(below * (1 - each) / (above * each), above, below);
}

Finding finding_of(Finding::Kind kind, const Disagreement& d, const std::string& words) {
    return {kind, d.a, d.b, words};
}

/// Disagreements of the second test that the first test had too.
std::vector<Disagreement> both_times(
    const std::vector<Disagreement>& first, const std::vector<Disagreement>& second) {
    std::vector<Disagreement> both;
    for (const Disagreement& d : second) {
        const bool was_there = std::any_of(first.begin(), first.end(), [&](const auto& other) {
            return other.number == d.number && other.a == d.a && other.b == d.b;
        });
        if (was_there) {
            both.push_back(d);
        }
    }
    return both;
}

std::vector<Way> ways_among(const std::vector<Disagreement>& suspects) {
    std::set<Way> ways;
    for (const Disagreement& d : suspects) {
        ways.insert(d.a);
        ways.insert(d.b);
    }
    return {ways.begin(), ways.end()};
}

/// Tests the disagreements of the screening a second time, and the remaining ones a last time.
void retest(
    const Case& it,
    const std::vector<Disagreement>& first,
    std::uint64_t number,
    const Rules& rules,
    Verdict& verdict) {
    verdict.retested = true;
    const auto answers = answers_of(it, ways_among(first), seeded(rules.second, number, 2));
    const auto suspects = both_times(first, disagreements(it, answers, rules.second_level));
    if (suspects.empty()) {
        return;
    }
    verdict.closely_tested = true;
    const double level =
        rules.family_level / rules.scenes / (4 * static_cast<double>(suspects.size()));
    const auto findings = compare_closely(it, suspects, number, rules, level);
    if (!findings.empty() &&
        (has_near_surfaces(it.run.scene) || !lint_wedges(it.run.scene, it.run.sources).empty())) {
        verdict.is_rounding = true;
        return;
    }
    verdict.findings.insert(verdict.findings.end(), findings.begin(), findings.end());
}

void judge_numbers(
    const Case& it,
    std::uint64_t number,
    const Rules& rules,
    bool with_identity,
    Verdict& verdict) {
    const std::vector<std::string> names = number_names(it.run.scene);
    const Effort screen = seeded(rules.screen, number, 1);
    const std::vector<Answer> answers = answers_of(it, ways_of(it), screen);
    for (const Answer& answer : answers) {
        for (const std::string& fault : impossible_numbers(answer, names)) {
            verdict.findings.push_back({Finding::Kind::impossible, answer.way, answer.way, fault});
        }
    }
    if (with_identity) {
        for (const std::string& fault : faults_of_identity(it, screen)) {
            verdict.findings.push_back(
                {Finding::Kind::identity, Way::automatic, Way::automatic, fault});
        }
    }
    verdict.comparisons = count_comparisons(answers);
    if (verdict.comparisons == 0) {
        return;
    }
    const double level = rules.screen_level / static_cast<double>(verdict.comparisons);
    const auto first = disagreements(it, answers, level);
    if (!first.empty()) {
        retest(it, first, number, rules, verdict);
    }
}

}  // namespace

std::string name_of(Finding::Kind kind) {
    constexpr std::array names{"refused", "impossible", "identity", "difference", "interval"};
    return names[static_cast<std::size_t>(kind)];
}

Rules gap_rules() {
    constexpr std::uint64_t kPaths = 4 * kClosePaths;
    return {
        .screen = {kPaths, 16, 1, 1},
        .screen_level = .2,
        .second = {kPaths, 16, 1, 1},
        .last = {kPaths, 16, 1, 1}};
}

std::vector<Finding> compare_closely(
    const Case& it,
    const std::vector<Disagreement>& suspects,
    std::uint64_t number,
    const Rules& rules,
    double level) {
    const std::vector<std::string> names = number_names(it.run.scene);
    std::map<Way, std::vector<Answer>> all;
    std::map<Way, Answer> means;
    for (const Way way : ways_among(suspects)) {
        for (unsigned i = 0; i < rules.last_seeds; ++i) {
            const Effort effort = seeded(rules.last, number, 1000 + i);
            all[way].push_back(answers_of(it, {way}, effort).front());
        }
        means[way] = pooled(all[way]);
    }
    std::vector<Finding> findings;
    const double quantile = student_t_quantile(1 - level / 2, rules.last_seeds - 1);
    for (const Disagreement& d : suspects) {
        const auto pair = disagreements(it, {means[d.a], means[d.b]}, level);
        const auto same = std::find_if(
            pair.begin(), pair.end(), [&](const auto& p) { return p.number == d.number; });
        if (same != pair.end()) {
            findings.push_back(finding_of(Finding::Kind::difference, d, same->words));
        }
        for (const auto& [way, other] : {std::pair{d.a, d.b}, std::pair{d.b, d.a}}) {
            // Intervals of the reference do not account for low counts; its means are used.
            if (way == Way::reference) {
                continue;
            }
            const Number& truth = means[other].numbers[d.number];
            const double slack =
                quantile * truth.error + slack_between(it, d.number, means[way], means[other]);
            const unsigned misses =
                std::isnan(truth.error) ? 0 : count_misses(all[way], d.number, truth.mean, slack);
            if (p_value_of_misses(misses, rules.last_seeds, rules.misses) < level) {
                findings.push_back(finding_of(
                    Finding::Kind::interval, d,
                    fmt::format(
                        "{}: {} of {} intervals of {} miss what {} says", names[d.number], misses,
                        rules.last_seeds, name_of(way), name_of(other))));
            }
        }
    }
    return findings;
}

Verdict judge(const Node& document, std::uint64_t number, const Rules& rules, bool with_identity) {
    Verdict verdict;
    try {
        judge_numbers(make_case(document), number, rules, with_identity, verdict);
    } catch (const std::exception& error) {
        verdict.findings.push_back(
            {Finding::Kind::refused, Way::automatic, Way::automatic, error.what()});
    }
    return verdict;
}

}  // namespace quasimc::stress
