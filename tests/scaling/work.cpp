#include "scaling/work.h"

#include <atomic>
#include <cstdlib>
#include <new>

#include "samplers/catalogue.h"
#include "scene/scene.h"
#include "solvers/catalogue.h"

namespace {

// Of this test program alone: what all its allocations add up to.
std::atomic<std::uint64_t> bytes_so_far{
    0};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void* counted(std::size_t size) {
    bytes_so_far.fetch_add(size, std::memory_order_relaxed);
    if (void* memory = std::malloc(size)) {  // NOLINT(cppcoreguidelines-no-malloc)
        return memory;
    }
    throw std::bad_alloc();
}

void* counted(std::size_t size, std::align_val_t alignment) {
    bytes_so_far.fetch_add(size, std::memory_order_relaxed);
    const auto step = static_cast<std::size_t>(alignment);
    if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) {
        return memory;
    }
    throw std::bad_alloc();
}

}  // namespace

// NOLINTBEGIN(cppcoreguidelines-no-malloc)
void* operator new(std::size_t size) {
    return counted(size);
}
void* operator new[](std::size_t size) {
    return counted(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size, alignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return counted(size, alignment);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
// NOLINTEND(cppcoreguidelines-no-malloc)

namespace quasimc::test {
namespace {

/// Counts the numbers that are drawn.
class CountingSampler final : public Sampler {
  public:
    explicit CountingSampler(const std::string& name) : sampler_(make_sampler(name)) {}
    [[nodiscard]] double coordinate(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const override {
        ++drawn_;
        return sampler_->coordinate(stream, point, dimension);
    }
    void coordinates(
        const Stream& stream,
        std::uint64_t point,
        std::uint32_t dimension,
        std::span<double> out) const override {
        drawn_ += out.size();
        sampler_->coordinates(stream, point, dimension, out);
    }
    [[nodiscard]] bool needs_power_of_two() const override {
        return sampler_->needs_power_of_two();
    }
    [[nodiscard]] std::uint64_t drawn() const { return drawn_; }

  private:
    std::unique_ptr<Sampler> sampler_;
    mutable std::uint64_t drawn_ = 0;  // one thread
};

}  // namespace

double bytes_allocated_by(const std::function<void()>& work) {
    const std::uint64_t before = bytes_so_far;
    work();
    return static_cast<double>(bytes_so_far - before);
}

Work work_of(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    const CountingSampler sampler(spec.sampler);
    Work work;
    work.bytes = bytes_allocated_by([&] {
        const PreparedScene prepared(
            scene, sources, spec.start_area,
            std::make_shared<const RayCaster>(
                data_of(scene).geometry, scene.cell(), spec.accelerator));
        Sums sums = empty_sums(prepared, spec);
        Executor executor(1);
        make_solver({prepared, sampler, spec})->solve({0, spec.paths}, executor, sums);
        work.rays = static_cast<double>(sums.rays());
    });
    work.numbers = static_cast<double>(sampler.drawn());
    return work;
}

}  // namespace quasimc::test
