#include "copies.h"

#include <cmath>

#if QUASIMC_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace quasimc::bench {

struct Copies::Scene {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene all = rtcNewScene(device);
    unsigned center = 0;  // the unmoved copy

    Scene() = default;
    ~Scene() {
        rtcReleaseScene(all);
        rtcReleaseDevice(device);
    }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    static unsigned attach(RTCScene scene, RTCGeometry geometry) {
        rtcCommitGeometry(geometry);
        const unsigned id = rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        return id;
    }

    [[nodiscard]] RTCScene make_original(const LocalMesh& mesh) const {
        const RTCScene original = rtcNewScene(device);
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(), 0,
            3 * sizeof(float), mesh.vertex_count());
        rtcSetSharedGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.faces.data(), 0,
            sizeof(Face), mesh.faces.size());
        attach(original, geometry);
        rtcCommitScene(original);
        return original;
    }

    void add_copy(RTCScene original, const Vec3& shift) {
        const RTCGeometry copy = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(copy, original);
        const std::array<float, 12> transform{
            1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(shift.x), static_cast<float>(shift.y), 0};
        rtcSetGeometryTransform(copy, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
        const unsigned id = attach(all, copy);
        center = shift == Vec3{} ? id : center;
    }

    [[nodiscard]] RTCRayHit trace(const BenchRay& ray, float near) const {
        RTCRayHit query;
        query.ray.org_x = static_cast<float>(ray.origin.x);
        query.ray.org_y = static_cast<float>(ray.origin.y);
        query.ray.org_z = static_cast<float>(ray.origin.z);
        query.ray.dir_x = static_cast<float>(ray.direction.x);
        query.ray.dir_y = static_cast<float>(ray.direction.y);
        query.ray.dir_z = static_cast<float>(ray.direction.z);
        query.ray.tnear = near;
        query.ray.tfar = INFINITY;
        query.ray.time = 0;
        query.ray.mask = 0xFFFFFFFFU;
        query.ray.flags = 0;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.primID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if QUASIMC_EMBREE_MAJOR >= 4
        rtcIntersect1(all, &query, nullptr);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(all, &context, &query);
#endif
        return query;
    }
};

Copies::Copies(const std::vector<Triangle>& triangles, int reach)
    : mesh_(make_local_mesh(triangles)), scene_(std::make_unique<Scene>()) {
    const RTCScene original = scene_->make_original(mesh_);
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            scene_->add_copy(original, mesh_.scale * Vec3{double(x), double(y), 0});
        }
    }
    rtcCommitScene(scene_->all);
    rtcReleaseScene(original);
}

Copies::~Copies() = default;

bool Copies::cast(const BenchRay& ray) const {
    float near = 0x1p-22F;
    while (true) {
        const RTCRayHit query = scene_->trace(ray, near);
        const bool is_self = query.hit.primID == ray.self && query.hit.instID[0] == scene_->center;
        if (ray.self == kNoTriangle || !is_self) {
            return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
        near = std::nextafter(query.ray.tfar, INFINITY);
    }
}

}  // namespace quasimc::bench
