#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include <dlfcn.h>

#include "quasimc/quasimc.h"
#include "rank_team.h"
#include "ranks.h"

namespace {

namespace fs = std::filesystem;

std::uint64_t number_in(const char* variable) {
    const char* text = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe)
    return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
}

/// Whether mpirun, or srun with PMIx, has started several processes.
bool are_several() {
    const bool by_slurm = std::getenv("PMIX_RANK") != nullptr;  // NOLINT(concurrency-mt-unsafe)
    return number_in("OMPI_COMM_WORLD_SIZE") > 1 ||
           (by_slurm && number_in("SLURM_STEP_NUM_TASKS") > 1);
}

[[noreturn]] void refuse_mpi(const std::string& why) {
    throw quasimc::InputError(
        {{"MPI", "the ranks of the job can't work together", why,
          "start the program without mpirun, or install its module for MPI"}});
}

/// Loads the module from the folder of the program, or from where it was installed.
const QuasimcRanks& load_ranks() {
    std::error_code error;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    void* module = nullptr;
    for (const char* name : {"quasimc_mpi.so", QUASIMC_MPI_MODULE}) {
        module =
            module != nullptr ? module : ::dlopen((folder / name).c_str(), RTLD_NOW | RTLD_GLOBAL);
    }
    if (module == nullptr) {
        refuse_mpi(::dlerror());  // NOLINT(concurrency-mt-unsafe): one thread so far
    }
    using Start = const QuasimcRanks* (*)();
    const auto start = reinterpret_cast<Start>(::dlsym(module, "quasimc_ranks"));
    const QuasimcRanks* ranks = start == nullptr ? nullptr : start();
    if (ranks == nullptr || ranks->version != kQuasimcRanksVersion) {
        refuse_mpi("its module is of another version, or MPI does not start");
    }
    return *ranks;
}

void sleep_a_little() {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
}

class MpiRankTeam final : public RankTeam {
  public:
    explicit MpiRankTeam(const QuasimcRanks& ranks) : ranks_(ranks) {}

    [[nodiscard]] Exit run(const std::function<Exit()>& work) override {
        try {
            const Exit exit = work();
            leave();
            return exit;
        } catch (const quasimc::Stopped&) {
            leave();
            throw;
        } catch (const std::exception& error) {
            if (is_first() && !has_ordered_) {
                leave();
                throw;
            }
            std::fprintf(stderr, "rank %d: %s\n", static_cast<int>(ranks_.rank), error.what());
            ranks_.abort(static_cast<int>(Exit::input_error));
            throw;
        }
    }

    [[nodiscard]] std::uint64_t rank() const override { return ranks_.rank; }
    [[nodiscard]] std::uint64_t size() const override { return ranks_.ranks; }

    [[nodiscard]] bool meet(bool is_done) override {
        if (is_first() && !is_done) {
            ranks_.stop();
        }
        ranks_.barrier();
        std::uint64_t is_first_done = is_done ? 1 : 0;
        ranks_.broadcast(&is_first_done, 1);
        if (!is_first() && is_first_done == 0) {
            await_stop();
        }
        return is_first_done != 0;
    }

    [[nodiscard]] quasimc::TeamOrder order(const quasimc::TeamOrder& order) override {
        has_ordered_ = true;
        std::array<std::uint64_t, 9> numbers{
            order.kind,        order.is_prepare,  order.point,
            order.time_step,   order.first_paths, order.round.first,
            order.round.count, order.tasks.calls, order.tasks.task};
        ranks_.broadcast(numbers.data(), numbers.size());
        const auto& [kind, is_prepare, point, time_step, first_paths, first, count, calls, task] =
            numbers;
        return {kind, is_prepare, point, time_step, first_paths, {first, count}, {calls, task}};
    }

    void add_up(std::vector<std::int64_t>& numbers) override {
        ranks_.add_up(numbers.data(), numbers.size());
    }

    /// Sends the number of bytes, and then the bytes as words of 8.
    void share_bytes(std::string& bytes) override {
        std::uint64_t count = bytes.size();
        ranks_.broadcast(&count, 1);
        Words words = words_of(bytes);
        words.resize(count / kWord + 1);
        ranks_.broadcast(words.data(), words.size());
        bytes = bytes_of(words, count);
    }

    void send(std::string_view bytes) override {
        const std::uint64_t count = bytes.size();
        ranks_.send(&count, 1);
        const Words words = words_of(bytes);
        ranks_.send(words.data(), words.size());
    }

    [[nodiscard]] std::string receive(std::uint64_t rank, const std::stop_token& stop) override {
        while (ranks_.has_sent(rank) == 0) {
            if (stop.stop_requested()) {
                throw quasimc::Stopped(
                    quasimc::StopReason::interrupted, "stopped while other ranks were at work");
            }
            sleep_a_little();
        }
        std::uint64_t count = 0;
        ranks_.receive(rank, &count, 1);
        Words words(count / kWord + 1);
        ranks_.receive(rank, words.data(), words.size());
        return bytes_of(words, count);
    }

    void stop() override { ranks_.stop(); }
    [[nodiscard]] bool is_stopped() override {
        is_stopped_ = is_stopped_ || (!is_first() && ranks_.is_stopped() != 0);
        return is_stopped_;
    }
    void await_stop() override {
        while (!is_stopped()) {
            sleep_a_little();
        }
        is_stopped_ = false;
    }

  private:
    using Words = std::vector<std::uint64_t>;
    static constexpr std::size_t kWord = sizeof(std::uint64_t);

    static Words words_of(std::string_view bytes) {
        Words words(bytes.size() / kWord + 1);
        std::memcpy(words.data(), bytes.data(), bytes.size());
        return words;
    }
    static std::string bytes_of(const Words& words, std::uint64_t count) {
        return {reinterpret_cast<const char*>(words.data()), count};
    }

    void leave() {
        if (is_first()) {
            static_cast<void>(order({.kind = quasimc::TeamOrder::kEnd}));
        }
        ranks_.finalize();
    }

    const QuasimcRanks& ranks_;
    bool has_ordered_ = false;
    bool is_stopped_ = false;
};

}  // namespace

bool RankTeam::is_another_rank() {
    return are_several() && (number_in("OMPI_COMM_WORLD_RANK") > 0 || number_in("PMIX_RANK") > 0);
}

std::unique_ptr<RankTeam> RankTeam::join() {
    if (!are_several()) {
        return nullptr;
    }
    // Threads of MPI leave Ctrl-C to the program.
    sigset_t interrupt{}, before{};
    sigemptyset(&interrupt);
    sigaddset(&interrupt, SIGINT);
    ::pthread_sigmask(SIG_BLOCK, &interrupt, &before);
    auto ranks = std::make_unique<MpiRankTeam>(load_ranks());
    if (!ranks->is_first()) {
        std::signal(SIGINT, SIG_IGN);  // the first rank stops all
    }
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return ranks;
}
