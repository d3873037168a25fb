#pragma once

#include <stop_token>
#include <vector>

#include "raster/projected_scene.h"
#include "raster/stored_blocks.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// A prepared scene as input of projections, with the data that it refers to. The scene must
/// outlive it.
class ProjectionInput {
  public:
    /// @param stop  checked while beams are prepared, if given; must outlive this
    explicit ProjectionInput(const PreparedScene& prepared, const std::stop_token* stop = nullptr);
    ~ProjectionInput() = default;
    ProjectionInput(const ProjectionInput&) = delete;
    ProjectionInput& operator=(const ProjectionInput&) = delete;

    /// Prepares for beams of many directions.
    void store_blocks();

    [[nodiscard]] const ProjectedScene& projected() const { return projected_; }

  private:
    std::vector<VisibilityRole> roles_;  // by triangle; none if all are opaque
    std::vector<StoredBlock> blocks_;
    ProjectedScene projected_;
};

}  // namespace quasimc
