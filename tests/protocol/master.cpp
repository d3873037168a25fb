#include "master.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <netinet/in.h>
#include <sys/ipc.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include "coupling/protocol/messages.h"

namespace quasimc::test {
namespace {

constexpr char kSign = '\x01';

int patience_ms() {
    return static_cast<int>(std::chrono::milliseconds(kPatience).count());
}

/// Pipes and sockets: a pair of descriptors.
class DescriptorMaster : public Master {
  public:
    ~DescriptorMaster() override { DescriptorMaster::clean_up(); }
    void await_sign() override {
        if (byte() != kSign) {
            throw MasterError("the first byte is no sign");
        }
    }
    bool is_welcomed() override {
        try {
            return byte() == kSign;
        } catch (const MasterError&) {
            return false;
        }
    }
    void await_last_sign() override { DescriptorMaster::await_sign(); }
    void write(std::string_view text) override {
        while (!text.empty()) {
            const ssize_t count = ::write(out_, text.data(), text.size());
            if (count < 0) {
                throw MasterError("the program does not read");
            }
            text.remove_prefix(static_cast<std::size_t>(count));
        }
    }
    void send() override {}
    std::string read() override {
        std::string line, reply;
        while (!line.starts_with("Control")) {
            line.clear();
            while (line.empty() || line.back() != '\n') {
                line += byte();
            }
            reply += line;
        }
        return reply;
    }
    void ask_for_next_chunk() override {}
    void clean_up() override {
        for (int* descriptor : {&in_, &out_}) {
            if (*descriptor >= 0) {
                ::close(std::exchange(*descriptor, -1));
            }
        }
    }

  protected:
    int in_ = -1, out_ = -1;

  private:
    char byte() {
        if (offset_ == buffer_.size()) {
            pollfd ready{in_, POLLIN, 0};
            buffer_.resize(65536);
            const ssize_t count = ::poll(&ready, 1, patience_ms()) > 0
                                      ? ::read(in_, buffer_.data(), buffer_.size())
                                      : -1;
            if (count <= 0) {
                buffer_.clear();
                offset_ = 0;
                throw MasterError("the program has closed the line, or says nothing");
            }
            buffer_.resize(static_cast<std::size_t>(count));
            offset_ = 0;
        }
        return buffer_[offset_++];
    }

    std::string buffer_;
    std::size_t offset_ = 0;
};

class PipeMaster final : public DescriptorMaster {
  public:
    explicit PipeMaster(std::filesystem::path folder) : folder_(std::move(folder)) {}

    void start(const std::vector<std::string>& words) override {
        std::array<int, 2> to{}, from{};
        if (::pipe2(to.data(), O_CLOEXEC) != 0 || ::pipe2(from.data(), O_CLOEXEC) != 0) {
            throw MasterError("no pipes");
        }
        std::vector<std::string> arguments{"-e", "comm.e"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        process_ =
            std::make_unique<Process>(QUASIMC_ENVIRONMENT, arguments, folder_, to[0], from[1]);
        ::close(to[0]);
        ::close(from[1]);
        out_ = to[1];
        in_ = from[0];
    }

  private:
    std::filesystem::path folder_;
};

class SocketMaster final : public DescriptorMaster {
  public:
    explicit SocketMaster(std::filesystem::path folder) : folder_(std::move(folder)) { listen(); }
    ~SocketMaster() override {
        for (const int listener : listeners_) {
            ::close(listener);
        }
    }
    void start(const std::vector<std::string>& words) override {
        std::vector<std::string> arguments{
            "-k", std::to_string(port_), "-host", "localhost", "-e", "comm.e"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        process_ = std::make_unique<Process>(QUASIMC_ENVIRONMENT, arguments, folder_);
    }
    void await_sign() override {
        accept_both();
        DescriptorMaster::await_sign();
    }
    bool is_welcomed() override {
        accept_both();
        return DescriptorMaster::is_welcomed();
    }

  private:
    void accept_both() {
        in_ = accept(listeners_[0]);
        out_ = accept(listeners_[1]);
    }
    static sockaddr_in address(int port) {
        sockaddr_in a{};
        a.sin_family = AF_INET;
        a.sin_port = htons(static_cast<std::uint16_t>(port));
        a.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        return a;
    }
    /// The program inherits it, as it does from the simulators.
    static int listener_on(int port) {
        const int made = ::socket(AF_INET, SOCK_STREAM, 0);
        const int on = 1;
        ::setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        const sockaddr_in a = address(port);
        if (::bind(made, reinterpret_cast<const sockaddr*>(&a), sizeof a) != 0 ||
            ::listen(made, 1) != 0) {
            ::close(made);
            return -1;
        }
        return made;
    }
    /// Listens on two consecutive free ports.
    void listen() {
        constexpr int kFirst = 20000, kCount = 10000, kTries = 500;
        for (int i = 0; i < kTries; ++i) {
            port_ = kFirst + (static_cast<int>(::getpid()) * 2 + 2 * i) % kCount;
            listeners_[0] = listener_on(port_);
            listeners_[1] = listeners_[0] < 0 ? -1 : listener_on(port_ + 1);
            if (listeners_[1] >= 0) {
                return;
            }
            ::close(listeners_[0]);
        }
        throw MasterError("no free ports");
    }
    static int accept(int listener) {
        pollfd ready{listener, POLLIN, 0};
        const int made = ::poll(&ready, 1, patience_ms()) > 0
                             ? ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC)
                             : -1;
        if (made < 0) {
            throw MasterError("the program does not connect");
        }
        return made;
    }

    std::filesystem::path folder_;
    int port_ = 0;
    std::array<int, 2> listeners_{-1, -1};
};

union SemaphoreArgument {
    int value;
    semid_ds* status;
    unsigned short* values;
};

/// Files and memory: the pair of semaphores.
class SemaphoreMaster : public Master {
  public:
    explicit SemaphoreMaster(std::filesystem::path folder) : folder_(std::move(folder)) {
        make_semaphores();
    }
    ~SemaphoreMaster() override { ::semctl(set_, 0, IPC_RMID); }
    /// The end of lpfg, which is stricter than that of cpfg: it adds to both semaphores before it
    /// removes them, and crashes if it can't.
    void clean_up() override {
        const int set = std::exchange(set_, -1);
        constexpr std::array<unsigned short, 2> kBoth{0, 1};
        for (const unsigned short number : kBoth) {
            sembuf release{number, 1, 0};
            if (set >= 0 && ::semop(set, &release, 1) < 0) {
                ::semctl(set, 0, IPC_RMID);
                throw MasterError(std::string("no release: ") + std::strerror(errno));
            }
        }
        ::semctl(set, 0, IPC_RMID);
    }

    /// The simulators sleep for a second and then check; this one checks repeatedly.
    void await_sign() override {
        const auto until = std::chrono::steady_clock::now() + kPatience;
        while (!has_signed()) {
            check_alive();
            if (std::chrono::steady_clock::now() > until) {
                throw MasterError("no sign");
            }
            ::usleep(1000);
        }
    }
    bool is_welcomed() override {
        SemaphoreMaster::await_sign();
        return true;
    }
    [[nodiscard]] bool has_signed() const override { return ::semctl(set_, 1, GETVAL) == 0; }
    [[nodiscard]] std::optional<long> semaphore_key() const override { return key_; }
    void await_last_sign() override {}
    void send() override {
        sent_ = true;
        sembuf give{0, 1, 0};
        ::semop(set_, &give, 1);
    }
    std::string read() override {
        sembuf take{1, -1, 0};
        const timespec slice{0, 50'000'000};
        const auto until = std::chrono::steady_clock::now() + kPatience;
        while (::semtimedop(set_, &take, 1, &slice) != 0) {
            check_alive();
            if (errno != EAGAIN || std::chrono::steady_clock::now() > until) {
                throw MasterError("no answer");
            }
        }
        return reply();
    }
    void ask_for_next_chunk() override { send(); }

  protected:
    virtual std::string reply() = 0;
    [[nodiscard]] long key() const { return key_; }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    void spawn(std::vector<std::string> arguments, const std::vector<std::string>& words) {
        arguments.insert(arguments.end(), words.begin(), words.end());
        process_ = std::make_unique<Process>(QUASIMC_ENVIRONMENT, arguments, folder_);
    }

  private:
    /// The program may end after its last answer.
    [[nodiscard]] bool has_answer() const { return ::semctl(set_, 1, GETVAL) > 0 && sent_; }

    void make_semaphores() {
        for (key_ = 4L * ::getpid(); set_ < 0; key_ += set_ < 0 ? 65536 : 0) {
            set_ = ::semget(static_cast<key_t>(key_), 2, IPC_CREAT | IPC_EXCL | 0600);
            if (set_ < 0 && errno != EEXIST) {
                throw MasterError("no semaphores");
            }
        }
        SemaphoreArgument value{};
        ::semctl(set_, 0, SETVAL, value);
        value.value = 1;
        ::semctl(set_, 1, SETVAL, value);
    }
    void check_alive() {
        siginfo_t ending{};
        const auto id = static_cast<id_t>(process_->pid());
        const int options = WEXITED | WNOHANG | WNOWAIT;
        if (::waitid(P_PID, id, &ending, options) == 0 && ending.si_pid != 0 && !has_answer()) {
            throw MasterError("the program has ended");
        }
    }

    std::filesystem::path folder_;
    long key_ = 0;
    int set_ = -1;
    bool sent_ = false;
};

class FileMaster final : public SemaphoreMaster {
  public:
    FileMaster(Client client, const std::filesystem::path& folder)
        : SemaphoreMaster(folder), client_(client) {
        extension_ = client == Client::lpfg ? std::to_string(key()) + ".0"
                                            : std::to_string(::getpid()) + ".0";
    }
    void start(const std::vector<std::string>& words) override {
        const std::string k = std::to_string(key());
        spawn(
            client_ == Client::lpfg
                ? std::vector<std::string>{"-k", k, "-ext", extension_, "-e", "comm.e"}
                : std::vector<std::string>{"-e", "comm.e", "-k", k, "-ext", extension_},
            words);
    }
    void write(std::string_view text) override {
        std::ofstream(folder() / (".to_field" + extension_), std::ios::binary) << text;
    }
    void clean_up() override {
        std::filesystem::remove(folder() / (".to_field" + extension_));
        std::filesystem::remove(folder() / (".from_field" + extension_));
        SemaphoreMaster::clean_up();
    }

  protected:
    std::string reply() override {
        std::ifstream file(folder() / (".from_field" + extension_), std::ios::binary);
        if (!file) {
            throw MasterError("no file with an answer");
        }
        std::ostringstream text;
        text << file.rdbuf();
        return text.str().substr(0, message_end(text.str()));  // the simulators read no further
    }

  private:
    Client client_;
    std::string extension_;
};

class MemoryMaster final : public SemaphoreMaster {
  public:
    explicit MemoryMaster(const std::filesystem::path& folder) : SemaphoreMaster(folder) {
        id_ = ::shmget(
            static_cast<key_t>(key() - 1), kToField + kFromField, IPC_CREAT | IPC_EXCL | 0600);
        void* memory = ::shmat(id_, nullptr, 0);
        if (id_ < 0 || memory == reinterpret_cast<void*>(-1)) {
            throw MasterError("no shared memory");
        }
        bytes_ = static_cast<char*>(memory);
        std::memset(bytes_, 'x', kToField + kFromField);  // arbitrary content
    }
    ~MemoryMaster() override {
        ::shmdt(bytes_);
        ::shmctl(id_, IPC_RMID, nullptr);
    }
    void start(const std::vector<std::string>& words) override {
        spawn({"-e", "comm.e", "-k", std::to_string(key())}, words);
    }
    void write(std::string_view text) override {
        if (text.size() > kToField) {
            throw MasterError("too long for the memory");
        }
        std::memcpy(bytes_, text.data(), text.size());
    }

  protected:
    std::string reply() override {
        const std::string_view all(bytes_ + kToField, kFromField);
        return std::string(all.substr(0, message_end(all)));
    }

  private:
    static constexpr std::size_t kToField = 50000, kFromField = 10000;
    int id_ = -1;
    char* bytes_ = nullptr;
};

}  // namespace

std::string Master::read_all_chunks() {
    std::string all = read();
    while (!all.ends_with("Control: 5\n") && !all.ends_with("Control: 4\n")) {
        ask_for_next_chunk();
        all += read();
    }
    return all;
}

std::unique_ptr<Master> make_master(
    Transport transport, Client client, const std::filesystem::path& folder) {
    switch (transport) {
        case Transport::pipes:
            return std::make_unique<PipeMaster>(folder);
        case Transport::files:
            return std::make_unique<FileMaster>(client, folder);
        case Transport::memory:
            return std::make_unique<MemoryMaster>(folder);
        case Transport::sockets:
            break;
    }
    return std::make_unique<SocketMaster>(folder);
}

std::string name_of(Transport transport) {
    constexpr std::array<const char*, 4> kNames{"pipes", "files", "memory", "sockets"};
    return kNames[static_cast<std::size_t>(transport)];
}

std::string comm_text(Transport transport) {
    return "communication type: " + name_of(transport) +
           "\nexecutable: QuasiMC light.qmc\nturtle position: %f %f %f\n"
           "turtle heading: %f %f %f\nturtle left: %f %f %f\nturtle up: %f %f %f\n"
           "following module: on\n";
}

}  // namespace quasimc::test
