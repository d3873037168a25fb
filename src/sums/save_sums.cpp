// The bytes of sums: a mark with version and byte order, then every field in the order of its
// declaration, each list after its length, then a checksum of all before it.

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "sums/sum_data.h"

namespace quasimc {
namespace {

constexpr std::uint64_t kMark = 0x39534D5553434D51;  // "QMCSUMS9", read as a little-endian number

/// FNV-1a of words of 8 bytes, the last filled up with zeros; high bits are mixed into low ones
/// after each. Every step can be turned back: bytes that differ in one word have other checksums.
std::uint64_t checksum(std::string_view bytes) {
    std::uint64_t hash = 0xcbf29ce484222325U ^ bytes.size();
    for (std::size_t at = 0; at < bytes.size(); at += sizeof hash) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
        hash = (hash ^ word) * 0x100000001b3U;
        hash ^= hash >> 32U;
    }
    return hash;
}

template <typename T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <typename Visit, typename ColumnOrConst>
void visit_column(Visit& visit, ColumnOrConst& column) {
    visit(column.of), visit(column.index);
}
template <typename Visit, typename BlockOrConst>
void visit_block(Visit& visit, BlockOrConst& block) {
    visit(block.name), visit(block.rows), visit(block.columns), visit(block.origins);
}
template <typename Visit, typename OriginOrConst>
void visit_origin(Visit& visit, OriginOrConst& origin) {
    visit(origin.name), visit(origin.has_suns), visit(origin.spectra), visit(origin.emitted_flux);
}
template <typename Visit, typename BoundOrConst>
void visit_bound(Visit& visit, BoundOrConst& bound) {
    visit(bound.quantity), visit(bound.largest), visit(bound.scale);
}
template <typename Visit, typename StrategyOrConst>
void visit_strategy(Visit& visit, StrategyOrConst& strategy) {
    visit(strategy.by), visit(strategy.has_suns), visit(strategy.spectra), visit(strategy.flux);
    visit(strategy.reach), visit(strategy.sunlit_reach), visit(strategy.step);
    visit(strategy.many), visit(strategy.unseen_reach);
}

class Writer {
  public:
    /// @param bytes  approximate size
    explicit Writer(std::size_t bytes) { bytes_.reserve(bytes); }
    template <Plain T>
    void operator()(const T& value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void operator()(const std::string& text) {
        (*this)(std::uint64_t{text.size()});
        bytes_ += text;
    }
    template <typename T>
    void operator()(const std::vector<T>& values) {
        (*this)(std::uint64_t{values.size()});
        for (const T& value : values) {
            (*this)(value);
        }
    }
    void operator()(const SumLayout& layout) {
        (*this)(std::uint64_t{layout.regions()}), (*this)(layout.blocks());
    }
    void operator()(const SumColumn& column) { visit_column(*this, column); }
    void operator()(const SumBlock& block) { visit_block(*this, block); }
    void operator()(const SumOrigin& origin) { visit_origin(*this, origin); }
    void operator()(const ContributionBound& bound) { visit_bound(*this, bound); }
    void operator()(const SamplingStrategy& strategy) { visit_strategy(*this, strategy); }
    void operator()(const ExactBins& bins) {
        (*this)(std::uint64_t{bins.size()});
        for (std::size_t i = 0; i < bins.size(); ++i) {
            const ExactBins::Quanta quanta = bins.quanta(i);
            (*this)(quanta.carries), (*this)(quanta.low);
        }
    }
    [[nodiscard]] std::string take() {
        (*this)(checksum(bytes_));
        return std::move(bytes_);
    }

  private:
    std::string bytes_;
};

class Reader {
  public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}

    template <Plain T>
    void operator()(T& value) {
        std::memcpy(&value, take(sizeof value), sizeof value);
    }
    void operator()(std::string& text) {
        const std::size_t size = length(1);
        text.assign(take(size), size);
    }
    template <typename T>
    void operator()(std::vector<T>& values) {
        values.resize(length(1));
        for (T& value : values) {
            (*this)(value);
        }
    }
    void operator()(SumLayout& layout) {
        std::uint64_t regions = 0;
        SumBlocks blocks;
        (*this)(regions), (*this)(blocks);
        layout = SumLayout(regions, std::move(blocks));
    }
    void operator()(SumColumn& column) { visit_column(*this, column); }
    void operator()(SumBlock& block) { visit_block(*this, block); }
    void operator()(SumOrigin& origin) { visit_origin(*this, origin); }
    void operator()(ContributionBound& bound) { visit_bound(*this, bound); }
    void operator()(SamplingStrategy& strategy) { visit_strategy(*this, strategy); }
    void operator()(ExactBins& bins) {
        bins = ExactBins(length(2 * sizeof(std::int64_t)));
        for (std::size_t i = 0; i < bins.size(); ++i) {
            ExactBins::Quanta quanta;
            (*this)(quanta.carries), (*this)(quanta.low);
            bins.add(i, quanta);
        }
    }
    [[nodiscard]] bool is_at_end() const { return rest_.empty(); }

  private:
    /// A number of items that take at least the given number of bytes each.
    std::size_t length(std::size_t bytes_each) {
        std::uint64_t size = 0;
        (*this)(size);
        if (size > rest_.size() / bytes_each) {
            throw std::invalid_argument("sums are cut off");
        }
        return size;
    }
    const char* take(std::size_t size) {
        if (size > rest_.size()) {
            throw std::invalid_argument("sums are cut off");
        }
        const char* bytes = rest_.data();
        rest_.remove_prefix(size);
        return bytes;
    }

    std::string_view rest_;
};

/// Visits every field.
template <typename Visit, typename SumsOrConst>
void visit_fields(Visit& visit, SumsOrConst& sums) {
    auto& units = sums.units;
    visit(sums.layout), visit(units.flux), visit(units.sunlit_area), visit(units.region_scale);
    visit(sums.bounds), visit(sums.strategies), visit(sums.spectra), visit(sums.sun_spectra);
    visit(sums.emitted_flux);
    visit(sums.measured), visit(sums.escaped), visit(sums.origins);
    visit(sums.replicates);
    visit(sums.paths), visit(sums.samples), visit(sums.per_contribution), visit(sums.digest);
}

void check_sizes(const SumData& sums) {
    for (const ExactBins& bins : sums.replicates) {
        if (bins.size() != sums.layout.bins()) {
            throw std::invalid_argument("sums do not fit their layout");
        }
    }
}

}  // namespace

std::string save_sums(const Sums& sums) {
    constexpr std::size_t kRest = 4096;
    constexpr std::size_t kBytesOfBin = 2 * sizeof(std::int64_t);
    Writer writer(
        kRest + sums->replicates.size() * (sums->layout.bins() * kBytesOfBin + sizeof kMark));
    writer(kMark);
    visit_fields(writer, *sums);
    return writer.take();
}

Sums load_sums(std::string_view bytes) {
    std::uint64_t mark = 0;
    std::uint64_t expected = 0;
    if (bytes.size() < sizeof mark + sizeof expected) {
        throw std::invalid_argument("sums are cut off");
    }
    std::memcpy(&mark, bytes.data(), sizeof mark);
    if (mark != kMark) {
        throw std::invalid_argument("not sums of this version and byte order");
    }
    std::memcpy(&expected, bytes.data() + bytes.size() - sizeof expected, sizeof expected);
    bytes.remove_suffix(sizeof expected);
    if (checksum(bytes) != expected) {
        throw std::invalid_argument("sums were changed or are cut off");
    }
    Reader reader(bytes.substr(sizeof mark));
    SumData sums;
    visit_fields(reader, sums);
    if (!reader.is_at_end()) {
        throw std::invalid_argument("sums have extra bytes at their end");
    }
    check_sizes(sums);
    return Sums(std::move(sums));
}

}  // namespace quasimc
