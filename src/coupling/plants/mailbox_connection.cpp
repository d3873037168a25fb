// Files and shared memory to an environment program, handed over with a pair of semaphores.

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <sstream>
#include <system_error>

#include <unistd.h>

#include <fmt/format.h>
#include <sys/ipc.h>
#include <sys/sem.h>
#include <sys/shm.h>

#include "base/checks.h"
#include "coupling/plants/program_connection.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

constexpr int kOwnerOnly = 0600;
constexpr long kBetweenKeys = 65536;

/// The argument of semctl, which the caller has to define.
union SemctlArgument {
    int value;
    semid_ds* status;
    unsigned short* values;
};

/// The pair of System V semaphores that the simulator makes: the first counts its messages, the
/// second the answers. It is 1 until the program has started.
class OwnSemaphores {
  public:
    enum class Number : unsigned short { messages, answers };

    OwnSemaphores() {
        constexpr int kCount = 2;
        // cpfg's key, unless other semaphores have it; 0 would be no key.
        key_ = 4L * ::getpid() % kBetweenKeys;
        key_ += key_ == 0 ? kBetweenKeys : 0;
        while ((set_ = ::semget(
                    static_cast<key_t>(key_), kCount, IPC_CREAT | IPC_EXCL | kOwnerOnly)) < 0) {
            if (errno != EEXIST) {
                throw ProgramNotStarted(
                    "there are no semaphores: " + std::generic_category().message(errno));
            }
            key_ += kBetweenKeys;
        }
        set(Number::messages, 0);
        set(Number::answers, 1);
    }
    ~OwnSemaphores() { ::semctl(set_, 0, IPC_RMID); }
    OwnSemaphores(const OwnSemaphores&) = delete;
    OwnSemaphores& operator=(const OwnSemaphores&) = delete;

    [[nodiscard]] long key() const { return key_; }
    [[nodiscard]] int value(Number number) const {
        return ::semctl(set_, static_cast<int>(number), GETVAL);
    }
    void post_message() const {
        sembuf give{static_cast<unsigned short>(Number::messages), 1, 0};
        while (::semop(set_, &give, 1) < 0 && errno == EINTR) {
        }
    }
    /// Waits for an answer for a short time. @returns whether there was one
    [[nodiscard]] bool take_answer() const {
        constexpr timespec kSlice{0, 50'000'000};
        sembuf take{static_cast<unsigned short>(Number::answers), -1, 0};
        return ::semtimedop(set_, &take, 1, &kSlice) == 0;
    }

  private:
    void set(Number number, int value) const {
        SemctlArgument argument{};
        argument.value = value;
        ::semctl(set_, static_cast<int>(number), SETVAL, argument);
    }

    long key_ = 0;
    int set_ = -1;
};

/// A pair of files in the working folder.
class OwnFiles {
  public:
    static constexpr std::size_t kCapacity = std::numeric_limits<std::size_t>::max();
    static constexpr std::size_t kDefaultChunk = 1000;

    /// The number of the environment follows from the key, as several have different ones.
    explicit OwnFiles(long key)
        : extension_(fmt::format("{}.{}", ::getpid(), key / kBetweenKeys)) {}
    ~OwnFiles() {
        std::remove(to_program().c_str());
        std::remove(from_program().c_str());
    }
    OwnFiles(const OwnFiles&) = delete;
    OwnFiles& operator=(const OwnFiles&) = delete;

    [[nodiscard]] std::vector<std::string> switches() const { return {"-ext", extension_}; }
    /// Returns whether the text was written.
    [[nodiscard]] bool write(std::string_view text) const {
        std::ofstream file(to_program(), std::ios::binary);
        file << text;
        file.close();
        return file.good();
    }
    [[nodiscard]] std::string read() const {
        const std::ifstream file(from_program(), std::ios::binary);
        std::ostringstream text;
        text << file.rdbuf();
        return text.str();
    }

  private:
    [[nodiscard]] std::string to_program() const { return ".to_field" + extension_; }
    [[nodiscard]] std::string from_program() const { return ".from_field" + extension_; }

    std::string extension_;
};

/// Shared memory: first the simulator's part, then the answers.
class OwnMemory {
  public:
    static constexpr std::size_t kToProgram = 50000, kFromProgram = 10000;
    /// Bytes that stay free, as in the simulators.
    static constexpr std::size_t kReserve = 25;
    static constexpr std::size_t kCapacity = kToProgram - kReserve;
    static constexpr std::size_t kDefaultChunk = kToProgram;

    explicit OwnMemory(long key) {
        errno = 0;
        id_ = ::shmget(
            static_cast<key_t>(key - 1), kToProgram + kFromProgram,
            IPC_CREAT | IPC_EXCL | kOwnerOnly);
        void* memory = id_ < 0 ? nullptr : ::shmat(id_, nullptr, 0);
        if (errno != 0) {  // both set it when they fail, and only then
            const std::string why = std::generic_category().message(errno);
            ::shmctl(id_, IPC_RMID, nullptr);
            throw ProgramNotStarted("there is no shared memory: " + why);
        }
        bytes_ = static_cast<char*>(memory);
    }
    ~OwnMemory() {
        ::shmdt(bytes_);
        ::shmctl(id_, IPC_RMID, nullptr);
    }
    OwnMemory(const OwnMemory&) = delete;
    OwnMemory& operator=(const OwnMemory&) = delete;

    [[nodiscard]] static std::vector<std::string> switches() { return {}; }
    [[nodiscard]] bool write(std::string_view text) const {
        EXPECT(text.size() <= kToProgram);
        std::memcpy(bytes_, text.data(), text.size());
        return true;
    }
    [[nodiscard]] std::string read() const { return {bytes_ + kToProgram, kFromProgram}; }

  private:
    int id_ = -1;
    char* bytes_ = nullptr;
};

template <typename Mailbox>
class MailboxConnection final : public ProgramConnection {
  public:
    explicit MailboxConnection(const ProgramCommand& command)
        : ProgramConnection(command.patience), mailbox_(semaphores_.key()) {
        std::vector<std::string> switches{"-k", std::to_string(semaphores_.key())};
        for (std::string& word : mailbox_.switches()) {
            switches.push_back(std::move(word));
        }
        start(command.with(switches), -1, -1);
        await_sign([&] {
            constexpr useconds_t kPause = 1000;
            const bool has_sign = semaphores_.value(OwnSemaphores::Number::answers) == 0;
            return has_sign || (::usleep(kPause), false);
        });
    }
    ~MailboxConnection() override { stop(); }
    MailboxConnection(const MailboxConnection&) = delete;
    MailboxConnection& operator=(const MailboxConnection&) = delete;

    void send(std::string_view message) override {
        if (has_ended()) {
            fail_as_ended();
        }
        if (!mailbox_.write(message)) {
            fail("no message can be written to it", std::generic_category().message(errno));
        }
        request_chunk();
    }
    std::string_view receive_line() override {
        if (!has_text_) {
            await_answer();
        }
        if (!lines_.next()) {
            fail("its reply is incomplete", "it must end with a line 'Control: 5'");
        }
        return lines_.line();
    }
    void request_chunk() override {
        has_text_ = false;
        semaphores_.post_message();
    }
    [[nodiscard]] std::size_t capacity() const override { return Mailbox::kCapacity; }
    [[nodiscard]] std::size_t default_chunk() const override { return Mailbox::kDefaultChunk; }

  private:
    void await_answer() {
        while (!semaphores_.take_answer()) {
            if (has_ended()) {
                fail_as_ended();
            }
        }
        // Programs that end before their time leave many answers, so that no simulator waits.
        if (semaphores_.value(OwnSemaphores::Number::answers) > 1) {
            fail_as_ended();
        }
        text_ = mailbox_.read();
        lines_ = LineScanner(text_);
        has_text_ = true;
    }
    void send_last(std::string_view message) override {
        if (!has_ended() && mailbox_.write(message)) {
            request_chunk();
        }
    }

    OwnSemaphores semaphores_;
    Mailbox mailbox_;
    std::string text_;
    LineScanner lines_{""};
    bool has_text_ = false;
};

}  // namespace

std::unique_ptr<ProgramConnection> connect_by_files(const ProgramCommand& command) {
    return std::make_unique<MailboxConnection<OwnFiles>>(command);
}

std::unique_ptr<ProgramConnection> connect_by_memory(const ProgramCommand& command) {
    return std::make_unique<MailboxConnection<OwnMemory>>(command);
}

}  // namespace quasimc
