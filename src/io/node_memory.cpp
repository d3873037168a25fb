#include "io/node_memory.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "io/descriptor.h"

namespace quasimc {

enum class ArrayState : std::uint32_t { free, is_written, is_there };

/// An array, of which other processes know the maker and its descriptor of the file.
struct ArrayEntry {
    ArrayState state = ArrayState::free;
    std::int32_t process = 0, descriptor = -1;
    std::uint64_t hash = 0, bytes = 0;
};

/// What processes know of each other's arrays.
struct ArrayList {
    pthread_mutex_t mutex{};
    std::array<ArrayEntry, 1024> entries;
};

namespace {

/// Keeps the list to one thread of one process. An entry that one which died has half written does
/// no harm: its process is gone, and bytes are compared.
class Locked {
  public:
    explicit Locked(ArrayList& list) : mutex_(&list.mutex) {
        if (::pthread_mutex_lock(mutex_) == EOWNERDEAD) {
            ::pthread_mutex_consistent(mutex_);
        }
    }
    ~Locked() { ::pthread_mutex_unlock(mutex_); }
    Locked(const Locked&) = delete;
    Locked& operator=(const Locked&) = delete;

  private:
    pthread_mutex_t* mutex_;
};

/// A file in memory, mapped to be read.
class Mapping {
  public:
    Mapping(int descriptor, std::size_t bytes)
        : bytes_(bytes), start_(::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, descriptor, 0)) {}
    ~Mapping() {
        if (is_there()) {
            ::munmap(start_, bytes_);
        }
    }
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;

    [[nodiscard]] bool is_there() const { return start_ != MAP_FAILED; }
    [[nodiscard]] const std::byte* data() const { return static_cast<const std::byte*>(start_); }

  private:
    std::size_t bytes_;
    void* start_;
};

bool write_all(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            return false;
        }
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return true;
}

bool is_alive(std::int32_t process) {
    return ::kill(process, 0) == 0 || errno == EPERM;
}

bool is_sealed(int descriptor) {
    const int seals = ::fcntl(descriptor, F_GET_SEALS);
    return seals >= 0 && (seals & F_SEAL_WRITE) != 0;
}

/// Whether files that are open leave enough for others that the program opens.
bool leaves_room(int descriptor) {
    constexpr rlim_t kPartForArrays = 4;
    rlimit limit{};
    return ::getrlimit(RLIMIT_NOFILE, &limit) == 0 &&
           std::cmp_less(descriptor, limit.rlim_cur / kPartForArrays);
}

std::shared_ptr<const std::byte> bytes_of(std::shared_ptr<const Mapping> mapping) {
    const std::byte* const data = mapping->data();
    return {std::move(mapping), data};
}

/// What another process has put there, if it is these bytes.
std::shared_ptr<const std::byte> take(const ArrayEntry& entry, std::span<const std::byte> bytes) {
    const std::string path = fmt::format("/proc/{}/fd/{}", entry.process, entry.descriptor);
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (!file.is_open() || ::fstat(file.number(), &status) != 0 ||
        std::cmp_not_equal(status.st_size, bytes.size()) || !is_sealed(file.number())) {
        return nullptr;
    }
    auto mapping = std::make_shared<const Mapping>(file.number(), bytes.size());
    const bool is_same =
        mapping->is_there() && std::memcmp(mapping->data(), bytes.data(), bytes.size()) == 0;
    return is_same ? bytes_of(std::move(mapping)) : nullptr;
}

}  // namespace

/// The list, as long as it is there: arrays may live longer.
struct NodeArrays {
    explicit NodeArrays(ArrayList& all) : list(&all) {}

    std::atomic<ArrayList*> list;

    void set(std::size_t place, ArrayState state, int descriptor = -1) const {
        if (ArrayList* const all = list) {
            const Locked locked(*all);
            ArrayEntry& entry = all->entries[place];
            if (entry.process == ::getpid()) {  // not given to another meanwhile
                entry.descriptor = descriptor;
                entry.state = state;
            }
        }
    }
};

namespace {

/// An array of which this process is the maker. It can be found as long as this one needs it.
class Given {
  public:
    Given(std::shared_ptr<const NodeArrays> arrays, std::size_t place)
        : arrays_(std::move(arrays)), place_(place) {}
    ~Given() { arrays_->set(place_, ArrayState::free); }
    Given(const Given&) = delete;
    Given& operator=(const Given&) = delete;

    /// @returns whether it is there
    bool make(std::span<const std::byte> bytes) {
        file_.emplace(::memfd_create("quasimc", MFD_CLOEXEC | MFD_ALLOW_SEALING));
        constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL;
        if (!file_->is_open() || !leaves_room(file_->number()) ||
            !write_all(file_->number(), bytes) ||
            ::fcntl(file_->number(), F_ADD_SEALS, kSeals) != 0) {
            return false;
        }
        mapping_.emplace(file_->number(), bytes.size());
        if (mapping_->is_there()) {
            arrays_->set(place_, ArrayState::is_there, file_->number());
        }
        return mapping_->is_there();
    }
    [[nodiscard]] const std::byte* data() const { return mapping_->data(); }

  private:
    std::shared_ptr<const NodeArrays> arrays_;
    std::size_t place_;
    std::optional<Descriptor> file_;
    std::optional<Mapping> mapping_;
};

/// Who is to make an array, or has made it.
struct Found {
    enum class Answer { make_it, take_it, wait, no_room } answer = Answer::no_room;
    std::size_t place = 0;
    ArrayEntry entry;
};

/// Looks for an array in the list; where it is not, gives its place to this process.
Found find_or_claim(ArrayList& list, std::uint64_t hash, std::size_t bytes) {
    const Locked locked(list);
    std::size_t free = list.entries.size();
    for (std::size_t i = 0; i < list.entries.size(); ++i) {
        ArrayEntry& entry = list.entries[i];
        if (entry.state != ArrayState::free && entry.hash == hash && entry.bytes == bytes) {
            if (is_alive(entry.process)) {
                const bool is_there = entry.state == ArrayState::is_there;
                return {is_there ? Found::Answer::take_it : Found::Answer::wait, i, entry};
            }
            entry.state = ArrayState::free;
        }
        free = entry.state == ArrayState::free && free == list.entries.size() ? i : free;
    }
    if (free == list.entries.size()) {
        return {};
    }
    list.entries[free] = {ArrayState::is_written, ::getpid(), -1, hash, bytes};
    return {Found::Answer::make_it, free, list.entries[free]};
}

}  // namespace

std::size_t NodeMemory::bytes_of_list() {
    return sizeof(ArrayList);
}

void NodeMemory::make_list(void* list) {
    auto* const made = new (list) ArrayList;
    pthread_mutexattr_t attributes{};
    ::pthread_mutexattr_init(&attributes);
    ::pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED);
    ::pthread_mutexattr_setrobust(&attributes, PTHREAD_MUTEX_ROBUST);
    ::pthread_mutex_init(&made->mutex, &attributes);
    ::pthread_mutexattr_destroy(&attributes);
}

NodeMemory::NodeMemory(void* list)
    : arrays_(std::make_shared<NodeArrays>(*static_cast<ArrayList*>(list))) {}

void NodeMemory::close() {
    arrays_->list = nullptr;
}

std::shared_ptr<const std::byte> NodeMemory::keep(std::span<const std::byte> bytes) {
    const auto* const chars = reinterpret_cast<const char*>(bytes.data());
    const std::uint64_t hash = std::hash<std::string_view>()({chars, bytes.size()});
    while (ArrayList* const list = arrays_->list) {
        const Found found = find_or_claim(*list, hash, bytes.size());
        if (found.answer == Found::Answer::make_it) {
            const auto given = std::make_shared<Given>(arrays_, found.place);
            if (!given->make(bytes)) {
                return nullptr;
            }
            given_ += bytes.size();
            return {given, given->data()};
        }
        if (found.answer == Found::Answer::take_it) {
            auto taken = take(found.entry, bytes);
            taken_ += taken ? bytes.size() : 0;
            return taken;
        }
        if (found.answer == Found::Answer::no_room) {
            return nullptr;
        }
        std::this_thread::sleep_for(std::chrono::microseconds(200));  // while it is written
    }
    return nullptr;
}

}  // namespace quasimc
