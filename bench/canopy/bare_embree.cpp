#include "bare_embree.h"

namespace quasimc::bench {

BareEmbree::BareEmbree(const LocalMesh& mesh)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(), 0,
        3 * sizeof(float), mesh.vertex_count());
    rtcSetSharedGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.faces.data(), 0, sizeof(Face),
        mesh.faces.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
}

BareEmbree::~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

void BareEmbree::trace(const RayLog& log) const {
    for (const Packet& packet : log.packets) {
        trace_packet(packet);
    }
    for (const Ray& ray : log.rays) {
        trace_ray(ray);
    }
}

void BareEmbree::trace_packet(const Packet& packet) const {
    alignas(64) RTCRayHit16 query;
    alignas(64) std::array<int, kPacket> valid;
    for (std::size_t i = 0; i < kPacket; ++i) {
        valid[i] = packet.far[i] >= packet.near[i] ? -1 : 0;
        query.ray.org_x[i] = packet.origin_x[i];
        query.ray.org_y[i] = packet.origin_y[i];
        query.ray.org_z[i] = packet.origin_z[i];
        query.ray.tnear[i] = packet.near[i];
        query.ray.dir_x[i] = packet.direction_x[i];
        query.ray.dir_y[i] = packet.direction_y[i];
        query.ray.dir_z[i] = packet.direction_z[i];
        query.ray.time[i] = 0;
        query.ray.tfar[i] = packet.far[i];
        query.ray.mask[i] = 0xFFFFFFFFU;
        query.ray.id[i] = 0;
        query.ray.flags[i] = 0;
        query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid.data(), scene_, &query, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), scene_, &context, &query);
#endif
}

void BareEmbree::trace_ray(const Ray& ray) const {
    RTCRayHit query;
    query.ray.org_x = static_cast<float>(ray.origin.x);
    query.ray.org_y = static_cast<float>(ray.origin.y);
    query.ray.org_z = static_cast<float>(ray.origin.z);
    query.ray.tnear = ray.near;
    query.ray.dir_x = static_cast<float>(ray.direction.x);
    query.ray.dir_y = static_cast<float>(ray.direction.y);
    query.ray.dir_z = static_cast<float>(ray.direction.z);
    query.ray.time = 0;
    query.ray.tfar = ray.far;
    query.ray.mask = 0xFFFFFFFFU;
    query.ray.id = 0;
    query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene_, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &query);
#endif
}

}  // namespace quasimc::bench
