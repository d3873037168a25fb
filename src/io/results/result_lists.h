#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/results/json_scanner.h"
#include "quasimc/sums.h"

namespace quasimc {

/// Where a list of organs or groups stands in a JSON result.
struct ResultListPlace {
    std::string part = {};   ///< "moments", "days" or "total"; empty without [time]
    std::size_t index = 0;   ///< of the moment or the day
    std::string label = {};  ///< its time or date, if that is told before the list
};

/// A part of a text: where it begins, and where it ends.
using TextRange = std::pair<std::size_t, std::size_t>;

/// Goes once through the text of a JSON result, and calls `visit` at each list of that name; it
/// must read the list or skip it.
/// @param name   "organs" or "groups"
/// @param point  of a sweep, from 0; nothing else is visited
/// @returns  the lists, and the points but `point`, in the order of the text
/// @throws InputError  if it is not JSON
std::vector<TextRange> for_each_result_list(
    std::string_view text,
    std::string_view path,
    std::string_view name,
    const std::optional<std::size_t>& point,
    const std::function<void(const ResultListPlace&, JsonScanner&)>& visit);

/// What leads to each kind of numbers that is wanted, as a tree of names.
class EstimateTree {
  public:
    /// @param columns  of each, the names that lead to it: a quantity and a band. None of them is
    ///                 the beginning of another
    explicit EstimateTree(const std::vector<std::vector<std::string>>& columns);

    /// Takes an estimate: number of the element of the list, of the column, and what it is, NaN
    /// where it says nothing or null.
    using Take = std::function<void(std::size_t, std::size_t, const Estimate&)>;

    /// Reads a list of organs or groups. @returns how many it has
    std::size_t read(JsonScanner& json, const Take& take) const;

  private:
    struct Node {
        std::vector<std::pair<std::string, std::size_t>> below =
            {};                                 ///< names and numbers of nodes
        std::vector<std::size_t> columns = {};  ///< whose estimate it is
    };
    void read_below(JsonScanner& json, const Node& node, std::size_t index, const Take& take) const;

    std::vector<Node> nodes_;
};

}  // namespace quasimc
