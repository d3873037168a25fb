// The only file that includes Embree; it compiles with Embree 3 and with Embree 4.

#ifndef QUASIMC_EMBREE_MAJOR
#if __has_include(<embree4/rtcore.h>)
#define QUASIMC_EMBREE_MAJOR 4
#else
#define QUASIMC_EMBREE_MAJOR 3
#endif
#endif

#include <new>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

#if QUASIMC_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "base/memory_need.h"
#include "base/stop.h"
#include "geometry/cast/intersector.h"
#include "geometry/cast/rounding.h"

namespace quasimc {

namespace {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseScene>;
using Geometry = std::unique_ptr<RTCGeometryTy, ReleaseGeometry>;

/// Throws if a call of this thread to Embree has failed. `device` may be null: then its
/// construction failed.
void throw_if_failed(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_OUT_OF_MEMORY) {
        throw std::bad_alloc();
    }
    if (error == RTC_ERROR_CANCELLED) {
        throw StopRequested();
    }
    if (error == RTC_ERROR_UNKNOWN) {  // by the system: a thread could not start
        throw OutOfMemory::for_threads();
    }
    if (error != RTC_ERROR_NONE) {
        throw std::runtime_error("Embree failed with error " + std::to_string(error));
    }
}

Device make_device() {
    Device device(rtcNewDevice(nullptr));
    if (!device) {
        throw_if_failed(nullptr);
        throw std::runtime_error("Embree could not be started");
    }
    return device;
}

/// @param vertices  3 numbers each, plus kVertexPadding
Geometry make_triangles(
    RTCDevice device, std::span<const float> vertices, std::span<const Face> faces) {
    Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    rtcSetSharedGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0,
        3 * sizeof(float), (vertices.size() - kVertexPadding) / 3);
    rtcSetSharedGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, faces.data(), 0, sizeof(Face),
        faces.size());
    throw_if_failed(device);
    return geometry;
}

/// Context of an any-hit query for the filter below; Embree returns a pointer to its first member.
struct OcclusionContext {
#if QUASIMC_EMBREE_MAJOR >= 4
    RTCRayQueryContext embree;
#else
    RTCIntersectContext embree;
#endif
    const LocalMesh* mesh;
    const Ray* ray;
    std::uint32_t except;
};

/// Instances precede the geometry of the other triangles in the scene, so that their indices are
/// those of LocalMesh::instances.
std::uint32_t triangle_number(const LocalMesh& mesh, unsigned instance, unsigned primitive) {
    return instance == RTC_INVALID_GEOMETRY_ID ? primitive
                                               : mesh.ranges.first(instance) + primitive;
}

/// Rejects the hit with the excepted triangle, and hits due to rounding. Rays are traced singly
/// here, so N is 1.
void refuse_excepted(const RTCFilterFunctionNArguments* arguments) {
    const auto* context = reinterpret_cast<const OcclusionContext*>(arguments->context);
    const std::uint32_t triangle = triangle_number(
        *context->mesh, RTCHitN_instID(arguments->hit, 1, 0, 0),
        RTCHitN_primID(arguments->hit, 1, 0));
    const float t = RTCRayN_tfar(arguments->ray, 1, 0);
    if (triangle == context->except || is_rounding(*context->mesh, *context->ray, triangle, t)) {
        arguments->valid[0] = 0;
    }
}

RTCRay to_embree(const Ray& ray) {
    RTCRay r;
    r.org_x = static_cast<float>(ray.origin.x);
    r.org_y = static_cast<float>(ray.origin.y);
    r.org_z = static_cast<float>(ray.origin.z);
    r.tnear = ray.near;
    r.dir_x = static_cast<float>(ray.direction.x);
    r.dir_y = static_cast<float>(ray.direction.y);
    r.dir_z = static_cast<float>(ray.direction.z);
    r.time = 0;
    r.tfar = ray.far;
    r.mask = 0xFFFFFFFFU;
    r.id = 0;
    r.flags = 0;
    return r;
}

/// Continues or stops the construction of a tree. @param stop  a std::stop_token
bool goes_on(void* stop, double /*part done*/) {
    return !static_cast<const std::stop_token*>(stop)->stop_requested();
}

/// Builds the tree of a complete scene.
void commit(RTCDevice device, RTCScene scene, std::stop_token stop) {
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    if (stop.stop_possible()) {
        rtcSetSceneProgressMonitorFunction(scene, goes_on, &stop);
    }
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    throw_if_failed(device);
}

class EmbreeIntersector final : public Intersector {
  public:
    EmbreeIntersector(const LocalMesh& mesh, const std::stop_token& stop)
        : mesh_(mesh), device_(make_device()), scene_(rtcNewScene(device_.get())) {
        try {
            attach_instances(stop);
            if (!mesh.faces.empty()) {
                attach_triangles(scene_.get(), mesh.vertices, mesh.faces);
            }
            commit(device_.get(), scene_.get(), stop);
        } catch (const std::bad_alloc&) {
            // Embree ends the program if a device is released that lacked memory for its threads.
            static_cast<void>(scene_.release());
            static_cast<void>(device_.release());
            throw;
        }
    }

    [[nodiscard]] Hit closest(const Ray& ray) const override {
        RTCRayHit query;
        query.ray = to_embree(ray);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        query.hit.primID = kNoTriangle;
        query.hit.u = query.hit.v = 0;
        query.hit.Ng_x = query.hit.Ng_y = query.hit.Ng_z = 0;
#if QUASIMC_EMBREE_MAJOR >= 4
        rtcIntersect1(scene_.get(), &query, nullptr);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_.get(), &context, &query);
#endif
        const RTCHit& hit = query.hit;
        Hit found{hit.primID, query.ray.tfar, hit.u, hit.v, {hit.Ng_x, hit.Ng_y, hit.Ng_z}};
        if (hit.instID[0] != RTC_INVALID_GEOMETRY_ID) [[unlikely]] {
            found.triangle = triangle_number(mesh_, hit.instID[0], hit.primID);
            found.normal = normal_of(found.triangle);
        }
        return found;
    }

    void closest(Packet& packet) const override;

    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t except) const override {
        RTCRay query = to_embree(ray);
        OcclusionContext context;
        context.mesh = &mesh_;
        context.ray = &ray;
        context.except = except;
#if QUASIMC_EMBREE_MAJOR >= 4
        rtcInitRayQueryContext(&context.embree);
        RTCOccludedArguments arguments;
        rtcInitOccludedArguments(&arguments);
        arguments.context = &context.embree;
        rtcOccluded1(scene_.get(), &query, &arguments);
#else
        rtcInitIntersectContext(&context.embree);
        rtcOccluded1(scene_.get(), &context.embree, &query);
#endif
        return query.tfar < 0;
    }

  private:
    void attach_triangles(
        RTCScene scene, std::span<const float> vertices, std::span<const Face> faces) {
        const Geometry geometry = make_triangles(device_.get(), vertices, faces);
        rtcSetGeometryOccludedFilterFunction(geometry.get(), refuse_excepted);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometry(scene, geometry.get());
    }

    void attach_instances(const std::stop_token& stop) {
        for (const LocalPrototype& prototype : mesh_.prototypes) {
            const EmbreeScene& scene =
                prototypes_.emplace_back(EmbreeScene(rtcNewScene(device_.get())));
            attach_triangles(scene.get(), prototype.vertices, prototype.mesh->faces);
            commit(device_.get(), scene.get(), stop);
        }
        for (const LocalInstance& instance : mesh_.instances) {
            const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
            rtcSetGeometryInstancedScene(geometry.get(), prototypes_[instance.prototype].get());
            rtcSetGeometryTransform(
                geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, instance.matrix.data());
            rtcCommitGeometry(geometry.get());
            rtcAttachGeometry(scene_.get(), geometry.get());
        }
    }

    /// Embree gives normals of instanced triangles before the transform.
    [[nodiscard]] std::array<float, 3> normal_of(std::uint32_t triangle) const {
        const Vec3 n = mesh_.across(triangle);
        return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
    }
    /// Sets indices and normals of the hits with instances.
    void resolve_instances(const RTCHit16& hits, Packet& packet) const;

    const LocalMesh& mesh_;
    Device device_;
    std::vector<EmbreeScene> prototypes_;
    EmbreeScene scene_;
};

void EmbreeIntersector::resolve_instances(const RTCHit16& hits, Packet& packet) const {
    for (std::size_t i = 0; i < kPacket; ++i) {
        const unsigned instance = hits.instID[0][i];
        if (packet.triangle[i] == kNoTriangle || instance == RTC_INVALID_GEOMETRY_ID) {
            continue;
        }
        packet.triangle[i] = triangle_number(mesh_, instance, packet.triangle[i]);
        const std::array<float, 3> normal = normal_of(packet.triangle[i]);
        packet.normal_x[i] = normal[0];
        packet.normal_y[i] = normal[1];
        packet.normal_z[i] = normal[2];
    }
}

void EmbreeIntersector::closest(Packet& packet) const {
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
        query.ray.tfar[i] = packet.far[i];
        query.ray.time[i] = 0;
        query.ray.mask[i] = 0xFFFFFFFFU;
        query.ray.id[i] = 0;
        query.ray.flags[i] = 0;
        query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        query.hit.primID[i] = kNoTriangle;
        query.hit.u[i] = query.hit.v[i] = 0;
        query.hit.Ng_x[i] = query.hit.Ng_y[i] = query.hit.Ng_z[i] = 0;
    }
#if QUASIMC_EMBREE_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid.data(), scene_.get(), &query, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), scene_.get(), &context, &query);
#endif
    for (std::size_t i = 0; i < kPacket; ++i) {
        packet.triangle[i] = query.hit.primID[i];
        packet.t[i] = query.ray.tfar[i];
        packet.u[i] = query.hit.u[i];
        packet.v[i] = query.hit.v[i];
        packet.normal_x[i] = query.hit.Ng_x[i];
        packet.normal_y[i] = query.hit.Ng_y[i];
        packet.normal_z[i] = query.hit.Ng_z[i];
    }
    if (!mesh_.instances.empty()) {
        resolve_instances(query.hit, packet);
    }
}

}  // namespace

std::unique_ptr<Intersector> make_embree_intersector(
    const LocalMesh& mesh, const std::stop_token& stop) {
    return std::make_unique<EmbreeIntersector>(mesh, stop);
}

}  // namespace quasimc
