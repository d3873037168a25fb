// Rationale: ranks of a machine read the same scene. Arrays of the same bytes must be there once,
// and nobody may ever see other bytes than its own.
//
// Expected behaviour: processes that keep the same bytes make them once, whoever comes first and
// however many come at the same time; they keep what they have when its maker gives it up or is
// killed; what can't be shared is refused, and an array keeps its own memory then.

#include "io/node_memory.h"

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "base/frozen_array.h"

namespace quasimc::test {
namespace {

/// Numbers that tell arrays apart.
std::vector<std::uint32_t> numbers(std::uint32_t first, std::size_t count = 100'000) {
    std::vector<std::uint32_t> all(count);
    for (std::size_t i = 0; i < count; ++i) {
        all[i] = first + static_cast<std::uint32_t>(i);
    }
    return all;
}

std::span<const std::byte> bytes_of(const std::vector<std::uint32_t>& values) {
    return std::as_bytes(std::span(values));
}

bool has_bytes(const std::shared_ptr<const std::byte>& kept, const std::vector<std::uint32_t>& of) {
    return kept && std::memcmp(kept.get(), of.data(), bytes_of(of).size()) == 0;
}

class NodeMemoryTest : public ::testing::Test {
  protected:
    /// What processes that are forked from here share: some numbers, and the list.
    struct Shared {
        std::atomic<std::uint64_t> given, taken, step;
    };
    static constexpr std::size_t kListPlace = 64;

    NodeMemoryTest()
        : bytes_(kListPlace + NodeMemory::bytes_of_list()),
          start_(
              ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
          shared_(new (start_) Shared) {
        NodeMemory::make_list(list());
    }
    ~NodeMemoryTest() override { ::munmap(start_, bytes_); }

    [[nodiscard]] void* list() const { return static_cast<std::byte*>(start_) + kListPlace; }

    /// Starts a process. @param work  @returns whether all went well
    [[nodiscard]] pid_t start(const std::function<bool(NodeMemory& memory)>& work) const {
        const pid_t child = ::fork();
        if (child == 0) {
            NodeMemory memory(list());
            const bool is_well = work(memory);
            shared_->given += memory.bytes_given();
            shared_->taken += memory.bytes_taken();
            std::_Exit(is_well ? EXIT_SUCCESS : EXIT_FAILURE);
        }
        return child;
    }
    static bool ended_well(pid_t child) {
        int status = -1;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
    }
    void wait_for_step(std::uint64_t step) const {
        while (shared_->step < step) {
            ::usleep(200);
        }
    }

    std::size_t bytes_;
    void* start_;
    Shared* shared_;
};

TEST_F(NodeMemoryTest, HasTheSameBytesOnce) {
    NodeMemory memory(list());
    const auto values = numbers(7);
    const auto kept = memory.keep(bytes_of(values));
    ASSERT_TRUE(has_bytes(kept, values));
    EXPECT_EQ(memory.bytes_given(), bytes_of(values).size());
    EXPECT_TRUE(ended_well(start([&](NodeMemory& other) {
        return has_bytes(other.keep(bytes_of(numbers(7))), values) &&
               other.bytes_taken() == bytes_of(values).size() && other.bytes_given() == 0;
    })));
    const auto again = memory.keep(bytes_of(values));  // by its maker as well
    EXPECT_TRUE(has_bytes(again, values));
    EXPECT_EQ(memory.bytes_given(), bytes_of(values).size());
}

TEST_F(NodeMemoryTest, KeepsOtherBytesApart) {
    NodeMemory memory(list());
    const auto one = numbers(7);
    auto other = one;
    other.back() += 1;
    const auto first = memory.keep(bytes_of(one)), second = memory.keep(bytes_of(other));
    EXPECT_TRUE(has_bytes(first, one));
    EXPECT_TRUE(has_bytes(second, other));
    const auto shorter = memory.keep(bytes_of(one).first(4096));
    ASSERT_TRUE(shorter);
    EXPECT_EQ(memory.bytes_taken(), 0U);
}

TEST_F(NodeMemoryTest, CannotBeChanged) {
    NodeMemory memory(list());
    const auto values = numbers(1);
    const auto kept = memory.keep(bytes_of(values));
    ASSERT_TRUE(kept);
    const auto page = const_cast<std::byte*>(kept.get());
    EXPECT_NE(::mprotect(page, 4096, PROT_READ | PROT_WRITE), 0);
}

/// Six processes read the same forty arrays at the same time, each in an order of its own.
TEST_F(NodeMemoryTest, IsFilledOnceByManyAtATime) {
    constexpr std::uint32_t kArrays = 40, kProcesses = 6;
    std::vector<pid_t> children;
    for (std::uint32_t process = 0; process < kProcesses; ++process) {
        children.push_back(start([&, process](NodeMemory& memory) {
            std::vector<std::shared_ptr<const std::byte>> all;
            bool is_well = true;
            for (std::uint32_t i = 0; i < kArrays; ++i) {
                const auto values = numbers((i + process / 2) % kArrays);
                all.push_back(memory.keep(bytes_of(values)));
                is_well = is_well && has_bytes(all.back(), values);
            }
            ++shared_->step;
            wait_for_step(kProcesses);  // nobody gives up anything before
            return is_well;
        }));
    }
    for (const pid_t child : children) {
        EXPECT_TRUE(ended_well(child));
    }
    const std::uint64_t all = kArrays * bytes_of(numbers(0)).size();
    EXPECT_EQ(shared_->given, all);
    EXPECT_EQ(shared_->taken, (kProcesses - 1) * all);
}

TEST_F(NodeMemoryTest, StaysWhenItsMakerHasGone) {
    const auto values = numbers(3);
    for (const bool is_killed : {false, true}) {
        shared_->step = 0;
        const pid_t maker = start([&](NodeMemory& memory) {
            const auto kept = memory.keep(bytes_of(values));
            shared_->step = 1;
            wait_for_step(2);
            while (is_killed) {
                ::pause();
            }
            return true;
        });
        wait_for_step(1);
        NodeMemory memory(list());
        const auto kept = memory.keep(bytes_of(values));
        EXPECT_EQ(memory.bytes_taken(), bytes_of(values).size());
        shared_->step = 2;
        if (is_killed) {
            ::kill(maker, SIGKILL);
        }
        EXPECT_EQ(ended_well(maker), !is_killed);
        EXPECT_TRUE(has_bytes(kept, values));
        // Who comes now makes them anew.
        EXPECT_TRUE(ended_well(start([&](NodeMemory& late) {
            return has_bytes(late.keep(bytes_of(values)), values) && late.bytes_taken() == 0;
        })));
    }
}

TEST_F(NodeMemoryTest, RefusesWhatHasNoRoom) {
    NodeMemory memory(list());
    std::vector<std::shared_ptr<const std::byte>> all;
    std::uint32_t first = 0;
    do {
        all.push_back(memory.keep(bytes_of(numbers(++first, 1024))));
    } while (all.back() && first < 100'000);
    EXPECT_FALSE(all.back());
    all.front().reset();  // and takes what has room again
    EXPECT_TRUE(memory.keep(bytes_of(numbers(0, 1024))));
}

/// Each array takes a file descriptor. Results must find one, too.
TEST_F(NodeMemoryTest, LeavesFilesThatMayBeOpened) {
    EXPECT_TRUE(ended_well(start([&](NodeMemory& memory) {
        rlimit limit{};
        ::getrlimit(RLIMIT_NOFILE, &limit);
        limit.rlim_cur = 64;
        ::setrlimit(RLIMIT_NOFILE, &limit);
        std::vector<std::shared_ptr<const std::byte>> all;
        for (std::uint32_t i = 0; i < 100; ++i) {
            all.push_back(memory.keep(bytes_of(numbers(i, 1024))));
        }
        int opened = 0;
        for (; opened < 40 && ::open("/dev/null", O_RDONLY) >= 0; ++opened) {
        }
        return all.front() && !all.back() && opened == 40;
    })));
}

TEST_F(NodeMemoryTest, IsWhereLargeFrozenArraysAre) {
    const auto values = numbers(11);
    const FrozenArray<std::uint32_t> own(values), small(numbers(12, 100));
    FrozenArray<std::uint32_t> common;
    {
        NodeMemory memory(list());
        common = own.in(&memory);
        EXPECT_EQ(memory.bytes_given(), bytes_of(values).size());
        EXPECT_EQ(small.in(&memory).data(), small.data());
        EXPECT_EQ(memory.bytes_given(), bytes_of(values).size());
        memory.close();
        EXPECT_FALSE(memory.keep(bytes_of(values)));
    }
    // It lives longer than the list.
    EXPECT_NE(common.data(), own.data());
    EXPECT_EQ(common, own);
    EXPECT_EQ(own.in(nullptr).data(), own.data());
}

}  // namespace
}  // namespace quasimc::test
