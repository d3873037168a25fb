#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "quasimc/error.h"

namespace quasimc {

enum class NetcdfType { real, integer, text };

/// Attributes of a variable or of the file, all of them texts.
using NetcdfAttributes = std::vector<std::pair<std::string, std::string>>;

/// Where a block of numbers stands in a variable: along each of its dimensions.
struct NetcdfBlock {
    std::vector<std::size_t> start, count;
};

/// A netCDF-4 file that is being made. First everything is defined, then values are put. It has no
/// name, so that nothing is left of it if the program ends before it does.
class NetcdfFile {
  public:
    /// @throws InputError  if there is no room for it; as all functions here do
    NetcdfFile();
    ~NetcdfFile();
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;
    NetcdfFile(NetcdfFile&&) = delete;
    NetcdfFile& operator=(NetcdfFile&&) = delete;

    /// @returns the number of the dimension
    int add_dimension(const std::string& name, std::size_t size);
    /// @param chunk  of reals that are put block by block, NaN until then: sizes of the pieces that
    ///        are compressed together. Empty: all is put at once
    /// @returns the number of the variable
    int add_variable(
        const std::string& name,
        NetcdfType type,
        const std::vector<int>& dimensions,
        const NetcdfAttributes& attributes,
        const std::vector<std::size_t>& chunk = {});
    void add_attributes(const NetcdfAttributes& attributes);

    void put(int variable, const NetcdfBlock& block, std::span<const double> values);
    // The whole of a variable.
    void put(int variable, std::span<const double> values);
    void put(int variable, std::span<const std::int64_t> values);
    void put(int variable, const std::vector<std::string>& values);

    /// Ends the file and gives its bytes.
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
