#include "stress/campaign.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <new>

#include <unistd.h>

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>

#include "stress/grammar.h"
#include "stress/shrink.h"

namespace quasimc::stress {
namespace {

using Clock = std::chrono::steady_clock;

/// A running campaign. The tally outlives the judging process.
class Worker {
  public:
    Worker(const Campaign& campaign, Tally& tally, Clock::time_point end)
        : campaign_(campaign), tally_(tally), end_(end) {}

    /// Judges scenes from a number on.
    void judge_from(std::uint64_t number) {
        const std::uint64_t last = campaign_.first + campaign_.scenes;
        for (; number < last && Clock::now() < end_; ++number) {
            tally_.scene = number;
            alarm(campaign_.seconds_per_scene);
            judge_scene(number);
            alarm(0);
            ++tally_.scenes;
            if (tally_.scenes % 1000 == 0) {
                log(describe(tally_));
            }
        }
        tally_.scene = last;
    }

    void log(const std::string& line) const {
        std::ofstream(campaign_.out / "log.txt", std::ios::app) << line << '\n';
    }

    /// Writes a run file with a comment.
    void keep(const std::string& name, const std::string& words, const Node& document) const {
        std::ofstream file(campaign_.out / (name + ".toml"));
        file << "# " << words << '\n' << to_toml(document);
    }

  private:
    void judge_scene(std::uint64_t number) {
        const Node document = random_run(number);
        const bool with_identity =
            campaign_.identity_every != 0 && number % campaign_.identity_every == 0;
        const Rules& rules = number < kFirstOfGaps ? campaign_.rules : campaign_.gap_rules;
        const Verdict verdict = judge(document, number, rules, with_identity);
        tally_.comparisons += verdict.comparisons;
        tally_.retested += verdict.retested ? 1 : 0;
        tally_.closely_tested += verdict.closely_tested ? 1 : 0;
        tally_.roundings += verdict.is_rounding ? 1 : 0;
        if (!verdict.findings.empty()) {
            ++tally_.findings;
            report(number, document, verdict);
        }
        if (campaign_.coverage_every != 0 && number % campaign_.coverage_every == 0) {
            count_coverage(number, document);
        }
    }

    void report(std::uint64_t number, const Node& document, const Verdict& verdict) {
        constexpr std::size_t kMaxLines = 4;
        const std::size_t count = verdict.findings.size();
        for (std::size_t i = 0; i < std::min(count, kMaxLines); ++i) {
            const Finding& finding = verdict.findings[i];
            log(fmt::format(
                "{} {} ({} of {}): {}", number, name_of(finding.kind), i + 1, count,
                finding.words));
        }
        const Finding& first = verdict.findings.front();
        const std::string name = fmt::format("{}-{}", number, name_of(first.kind));
        keep(name + "-whole", first.words, document);
        alarm(4 * campaign_.seconds_per_scene);
        keep(
            name, first.words,
            shrunk(document, failure_like(first, number), campaign_.shrinking_tries));
    }

    void count_coverage(std::uint64_t number, const Node& document) {
        alarm(4 * campaign_.seconds_per_scene);
        std::vector<Coverage> all;
        try {
            all = coverage_of(
                make_case(document), campaign_.coverage, campaign_.coverage_seeds, number);
        } catch (const InputError&) {
            return;  // already judged
        }
        ++tally_.covered_scenes;
        for (const Coverage& coverage : all) {
            if (coverage.numbers == 0) {
                continue;
            }
            const double step = std::clamp((coverage.held - .87) * 100, 0.0, 11.0);
            ++tally_.coverage_counts[static_cast<std::size_t>(step)];
            if (coverage.is_finding()) {
                ++tally_.findings;
                const std::string words = fmt::format(
                    "of {} numbers' intervals by {} only {:.3f} +- {:.3f} hold the truth",
                    coverage.numbers, name_of(coverage.way), coverage.held, coverage.error);
                log(fmt::format("{} coverage: {}", number, words));
                keep(fmt::format("{}-coverage-{}", number, name_of(coverage.way)), words, document);
            }
        }
    }

    const Campaign& campaign_;
    Tally& tally_;
    Clock::time_point end_;
};

Clock::time_point end_of(const Campaign& campaign) {
    const auto now = Clock::now();
    if (campaign.seconds <= 0) {
        return Clock::time_point::max();
    }
    return now + std::chrono::duration_cast<Clock::duration>(
                     std::chrono::duration<double>(campaign.seconds));
}

/// Notes the scene at which the process ended, and why.
void note_death(const Worker& worker, Tally& tally, int status) {
    ++tally.deaths;
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    const std::string words =
        signal == SIGALRM ? std::string("took too long")
                          : fmt::format("ended the program, signal {}, status {}", signal, status);
    worker.log(fmt::format("{} {}", tally.scene, words));
    worker.keep(fmt::format("{}-death", tally.scene), words, random_run(tally.scene));
}

}  // namespace

Tally run_campaign(const Campaign& campaign) {
    std::filesystem::create_directories(campaign.out);
    void* shared =
        mmap(nullptr, sizeof(Tally), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) {
        throw std::bad_alloc();
    }
    Tally& tally = *new (shared) Tally;
    Worker worker(campaign, tally, end_of(campaign));
    std::uint64_t next = campaign.first;
    while (true) {
        const pid_t child = fork();
        if (child == 0) {
            worker.judge_from(next);
            _exit(0);
        }
        int status = 0;
        if (child < 0 || waitpid(child, &status, 0) < 0) {
            throw std::runtime_error("no process can be started");
        }
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
            break;
        }
        note_death(worker, tally, status);
        next = tally.scene + 1;
    }
    const Tally result = tally;
    munmap(shared, sizeof(Tally));
    worker.log(describe(result));
    return result;
}

std::string describe(const Tally& tally) {
    std::string text = fmt::format(
        "{} scenes, {} comparisons; {} tested again, {} closely; {} with surfaces too close "
        "for rays, {} with findings, {} that ended the program or hung",
        tally.scenes, tally.comparisons, tally.retested, tally.closely_tested, tally.roundings,
        tally.findings, tally.deaths);
    if (tally.covered_scenes > 0) {
        text += fmt::format(
            "; intervals of {} scenes, held below .88, by steps of .01, .98 and more:",
            tally.covered_scenes);
        for (const std::uint64_t count : tally.coverage_counts) {
            text += fmt::format(" {}", count);
        }
    }
    return text;
}

}  // namespace quasimc::stress
