#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/result.h"
#include "results/where_expression.h"
#include "scene/scene.h"

namespace quasimc {

/// The values of organs that conditions compare: labels, and id, name, material (that of the
/// largest part), area, height (of the centroid) and layer (from 1 below, if layers are requested).
/// A label of one of these names comes first.
class OrganValues {
  public:
    /// @param scene  must outlive this
    OrganValues(const Scene& scene, const GroupSpec& spec);

    /// The value of an organ; empty if it has none.
    [[nodiscard]] std::optional<WhereValue> value(const Organ& organ, std::string_view name) const;
    [[nodiscard]] bool holds(const WhereExpression& where, const Organ& organ) const;
    /// layer_boundaries()
    [[nodiscard]] const std::vector<double>& boundaries() const { return boundaries_; }
    /// All names, labels first.
    [[nodiscard]] std::vector<std::string_view> names() const;

  private:
    const Scene& scene_;
    std::vector<double> boundaries_;  // of layers
};

}  // namespace quasimc
