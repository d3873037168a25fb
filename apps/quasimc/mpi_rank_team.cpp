#include <algorithm>
#include <array>
#include <atomic>
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
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <dlfcn.h>

#include <fmt/format.h>

#include "io/node_memory.h"
#include "quasimc/quasimc.h"
#include "rank_team.h"
#include "ranks.h"

namespace {

namespace fs = std::filesystem;

std::uint64_t number_in(const char* variable) {
    const char* text = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe)
    return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
}

/// Whether mpirun, or srun with PMIx, has started several of us.
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

using Counter = std::atomic<std::uint64_t>;
static_assert(Counter::is_always_lock_free && sizeof(Counter) == sizeof(std::uint64_t));

/// What ranks of a node share: the counter of tasks, and after it the list of common arrays.
constexpr std::uint64_t kListPlace = 64;
const std::uint64_t kNodeBytes = kListPlace + quasimc::NodeMemory::bytes_of_list();

/// The module lies beside the program, or where it was installed.
const QuasimcRanks& load_ranks() {
    std::error_code error;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    void* module = nullptr;
    for (const char* place : {"quasimc_mpi.so", QUASIMC_MPI_MODULE}) {
        module =
            module != nullptr ? module : ::dlopen((folder / place).c_str(), RTLD_NOW | RTLD_GLOBAL);
    }
    if (module == nullptr) {
        refuse_mpi(::dlerror());  // NOLINT(concurrency-mt-unsafe): one thread so far
    }
    using Start = const QuasimcRanks* (*)(std::uint64_t);
    const auto start = reinterpret_cast<Start>(::dlsym(module, "quasimc_ranks"));
    const QuasimcRanks* ranks = start == nullptr ? nullptr : start(kNodeBytes);
    if (ranks == nullptr || ranks->version != kQuasimcRanksVersion) {
        refuse_mpi("its module is of another version, or MPI does not start");
    }
    return *ranks;
}

class MpiRankTeam final : public RankTeam {
  public:
    explicit MpiRankTeam(const QuasimcRanks& ranks) : ranks_(ranks) {
        size_ = ranks.ranks;
        team_.is_first = ranks.rank == 0;
        team_.size = ranks.ranks;
        team_.machine = ranks.node;
        team_.machines = ranks.nodes;
        share_memory();
        set_mail();
        team_.tasks.begin = [this](std::uint64_t begin, std::uint64_t end) {
            return begin_tasks(begin, end);
        };
        team_.tasks.meet = [this](std::uint64_t own) {
            ranks_.barrier();
            ranks_.broadcast(&own, 1);
            return own;
        };
        team_.order = [this](const quasimc::TeamOrder& order) { return pass_order(order); };
        team_.share = [this](std::string& bytes) { share_bytes(bytes); };
        team_.add_up = [this](std::vector<std::int64_t>& numbers) {
            ranks_.add_up(numbers.data(), numbers.size());
        };
    }

    [[nodiscard]] Exit run(const std::function<Exit()>& work) override {
        try {
            const Exit exit = work();
            leave();
            return exit;
        } catch (const quasimc::Stopped&) {
            leave();
            throw;
        } catch (const std::exception& error) {
            if (team_.is_first && !has_ordered_) {
                leave();
                throw;
            }
            std::fprintf(stderr, "rank %d: %s\n", static_cast<int>(ranks_.rank), error.what());
            ranks_.abort(static_cast<int>(Exit::input_error));
            throw;
        }
    }

  private:
    /// The ranks of a node have large arrays of the scene once.
    void share_memory() {
        void* const list = static_cast<std::byte*>(ranks_.node_memory) + kListPlace;
        if (ranks_.is_first_of_node != 0) {
            quasimc::NodeMemory::make_list(list);
        }
        ranks_.barrier();
        memory_ = std::make_shared<quasimc::NodeMemory>(list);
        team_.memory = memory_;
    }

    void set_mail() {
        team_.mail.send = [this](std::uint64_t number, std::string_view bytes) {
            ranks_.send(number, bytes.data(), bytes.size());
        };
        team_.mail.has_arrived = [this] { return ranks_.has_arrived() != 0; };
        team_.mail.receive = [this](std::uint64_t number) -> std::optional<std::string> {
            const std::uint64_t count = ranks_.find(number);
            if (count == kNoMail) {
                return std::nullopt;
            }
            std::string bytes(count, '\0');
            ranks_.receive(bytes.data(), bytes.size());
            return bytes;
        };
        team_.mail.close = [this] { ranks_.close(); };
        team_.mail.is_closed = [this] { return ranks_.is_closed() != 0; };
        team_.mail.end = [this] { ranks_.end_mail(); };
    }

    /// Each node has a share of the tasks, which its ranks take one by one.
    [[nodiscard]] quasimc::TaskRange begin_tasks(std::uint64_t begin, std::uint64_t end) const {
        const auto [first, last] =
            quasimc::share_of(ranks_.node + 1, ranks_.nodes).range(end - begin);
        auto* counter = static_cast<Counter*>(ranks_.node_memory);
        if (ranks_.is_first_of_node != 0) {
            *counter = begin + first;
        }
        ranks_.barrier();
        return {counter, begin + last, ranks_.nodes == 1};
    }

    [[nodiscard]] quasimc::TeamOrder pass_order(const quasimc::TeamOrder& order) {
        has_ordered_ = true;
        std::array<std::uint64_t, 10> numbers{
            order.is_end,      order.is_prepare,  order.is_runs,     order.point,
            order.moment,      order.first_paths, order.round.first, order.round.count,
            order.tasks.calls, order.tasks.task};
        ranks_.broadcast(numbers.data(), numbers.size());
        return {
            numbers[0],
            numbers[1],
            numbers[2],
            numbers[3],
            numbers[4],
            numbers[5],
            {numbers[6], numbers[7]},
            {numbers[8], numbers[9]}};
    }

    /// As words of 8 bytes, behind their number and that of the bytes.
    void share_bytes(std::string& bytes) const {
        std::uint64_t count = bytes.size();
        ranks_.broadcast(&count, 1);
        std::vector<std::uint64_t> words((count + 7) / 8);
        std::memcpy(words.data(), bytes.data(), team_.is_first ? count : 0);
        if (count > 0) {
            ranks_.broadcast(words.data(), words.size());
        }
        bytes.assign(reinterpret_cast<const char*>(words.data()), count);
    }

    void leave() {
        if (team_.is_first) {
            static_cast<void>(pass_order({.is_end = 1}));
        }
        memory_->close();  // the list is memory of MPI
        ranks_.finalize();
    }

    const QuasimcRanks& ranks_;
    std::shared_ptr<quasimc::NodeMemory> memory_;
    bool has_ordered_ = false;
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
    if (!ranks->team().is_first) {
        std::signal(SIGINT, SIG_IGN);  // the first rank stops all
    }
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return ranks;
}
