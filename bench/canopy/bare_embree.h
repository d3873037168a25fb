#pragma once

#include <vector>

#include "geometry/cast/intersector.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace quasimc::bench {

/// The rays that the intersector received.
struct RayLog {
    std::vector<Packet> packets;
    std::vector<Ray> rays;

    [[nodiscard]] std::size_t count() const { return rays.size() + kPacket * packets.size(); }
};

/// Embree alone: a lower bound of the cost of tracing.
class BareEmbree {
  public:
    explicit BareEmbree(const LocalMesh& mesh);
    ~BareEmbree();
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;

    /// Casts all rays of the log: packets with the coherent flag, then single rays.
    void trace(const RayLog& log) const;

  private:
    void trace_packet(const Packet& packet) const;
    void trace_ray(const Ray& ray) const;

    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace quasimc::bench
