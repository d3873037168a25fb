#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "quasimc/error.h"

namespace quasimc {

enum class NetcdfType { real, integer, text };

/// Text attributes of a variable or of the file.
using NetcdfAttributes = std::vector<std::pair<std::string, std::string>>;

/// Position of a block of numbers in a variable, along each dimension.
struct NetcdfBlock {
    std::vector<std::size_t> start, count;
};

/// A netCDF-4 file under construction. Variables are defined before their values are written. The
/// file has no name, so that it disappears if the program ends early.
class NetcdfFile {
  public:
    /// @throws InputError  if the disk is full, like all functions here
    NetcdfFile();
    ~NetcdfFile();
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;
    NetcdfFile(NetcdfFile&&) = delete;
    NetcdfFile& operator=(NetcdfFile&&) = delete;

    /// @returns the number of the dimension
    int add_dimension(const std::string& name, std::size_t size);
    /// @param chunk  sizes of the compressed chunks of reals that are written block by block (NaN
    ///        until then), empty for a single number; none: the variable is written at once
    /// @returns the number of the variable
    int add_variable(
        const std::string& name,
        NetcdfType type,
        const std::vector<int>& dimensions,
        const NetcdfAttributes& attributes,
        const std::optional<std::vector<std::size_t>>& chunk = {});
    void add_attributes(const NetcdfAttributes& attributes);

    void put(int variable, const NetcdfBlock& block, std::span<const double> values);
    // Writes a whole variable.
    void put(int variable, std::span<const double> values);
    void put(int variable, std::span<const std::int64_t> values);
    void put(int variable, const std::vector<std::string>& values);

    /// Completes the file and sends its bytes.
    void copy_to(const TextSink& sink);

  private:
    void close();

    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Closer> bytes_;
    int id_ = 0;
    bool is_open_ = false;
};

}  // namespace quasimc
