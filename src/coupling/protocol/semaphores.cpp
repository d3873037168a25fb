#include "coupling/protocol/semaphores.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <string>
#include <system_error>

#include <poll.h>
#include <unistd.h>

#include <fmt/format.h>
#include <sys/ipc.h>
#include <sys/sem.h>
#include <sys/syscall.h>

#include "coupling/protocol/byte_stream.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

constexpr unsigned short kFromMaster = 0, kToMaster = 1;

/// Interval between checks whether the simulator still exists, while waiting for it.
constexpr long kLookEveryNanoseconds = 100'000'000;

/// The argument of semctl, which the caller has to define.
union SemaphoreArgument {
    int value;
    semid_ds* status;
    unsigned short* values;
};

[[noreturn]] void semaphores_gone(const char* how) {
    throw PeerDisconnected(std::string("the plant simulator has ended: ") + how);
}

[[noreturn]] void gone_by_error(int error) {
    semaphores_gone(
        error == EIDRM || error == EINVAL ? "its semaphores were removed"
                                          : std::generic_category().message(error).c_str());
}

/// Number of answers left to a simulator that continues alone: half of a semaphore's maximum. The
/// other half is for lpfg, which ends by adding to its semaphores; above the maximum that fails.
constexpr short kForever = 32767 / 2;

/// Returns a descriptor of a process; -1 and errno if there is none.
int watch(int process) {
    errno = 0;  // an unknown process is not watched
    return process > 0 ? static_cast<int>(::syscall(SYS_pidfd_open, process, 0)) : -1;
}

}  // namespace

SemaphorePair::SemaphorePair(long key) {
    constexpr int kCount = 2, kMode = 0600;
    set_ = ::semget(static_cast<key_t>(key), kCount, kMode);
    if (set_ < 0) {
        throw InputError(
            {{fmt::format("-k {}", key), "there is no pair of semaphores with that key",
              std::generic_category().message(errno),
              "the plant simulator creates it and passes the key; without -k, pipes are used"}});
    }
    maker_ = ::semctl(set_, kFromMaster, GETPID);  // the last process to use them so far
    master_ = watch(maker_);
    died_early_ = master_ < 0 && errno == ESRCH;
}

SemaphorePair::~SemaphorePair() {
    if (master_ >= 0) {
        ::close(master_);
    }
}

// The sign is a value of 0. The same operation takes a debt that the kernel returns when this
// process ends, so a kill at any time after the sign leaves an answer.
void SemaphorePair::announce() {
    const int before = ::semctl(set_, kToMaster, GETVAL);
    if (before < 0) {
        gone_by_error(errno);
    }
    std::array<sembuf, 3> sign_and_owe{
        {{kToMaster, static_cast<short>(-before), IPC_NOWAIT},
         {kToMaster, kForever, 0},
         {kToMaster, -kForever, SEM_UNDO}}};
    if (::semop(set_, sign_and_owe.data(), sign_and_owe.size()) < 0) {
        set_answers(0);  // without the debt, only a kill leaves no answer
        check();
    }
}

void SemaphorePair::wait_for_master() {
    sembuf take{kFromMaster, -1, 0};
    const timespec limit{0, kLookEveryNanoseconds};
    while (::semtimedop(set_, &take, 1, &limit) < 0) {
        if (errno != EAGAIN && errno != EINTR) {
            gone_by_error(errno);
        }
        check();
    }
}

void SemaphorePair::post_to_master() {
    sembuf give{kToMaster, 1, 0};
    while (::semop(set_, &give, 1) < 0) {
        if (errno != EINTR) {
            gone_by_error(errno);
        }
    }
}

// Setting a semaphore also cancels the debt of announce(): the end of this process then changes
// nothing.
void SemaphorePair::set_answers(int count) const noexcept {
    SemaphoreArgument argument{};
    argument.value = count;
    ::semctl(set_, kToMaster, SETVAL, argument);
}

void SemaphorePair::post_last() const noexcept {
    set_answers(1);
}

void SemaphorePair::post_forever() const noexcept {
    set_answers(kForever);
}

bool SemaphorePair::master_died() const {
    if (died_early_ || maker_ <= 0) {
        return died_early_;
    }
    if (master_ < 0) {  // an old kernel, or a container that forbids descriptors of processes
        return ::kill(maker_, 0) < 0 && errno == ESRCH;
    }
    pollfd process{master_, POLLIN, 0};
    return ::poll(&process, 1, 0) > 0;
}

void SemaphorePair::check() const {
    if (::semctl(set_, kFromMaster, GETVAL) < 0) {
        gone_by_error(errno);
    }
    if (master_died()) {
        semaphores_gone("its process ended without a command to exit");
    }
}

void SemaphorePair::remove() const {
    ::semctl(set_, 0, IPC_RMID);
}

}  // namespace quasimc
