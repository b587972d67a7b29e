// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Intersector.h"

#include "tools/reference/Material.h"

#include <rtcore.h>

#include <algorithm>
#include <string>

namespace filament_core::reference {
namespace {

// Embree 4 renamed the context of a ray, and passes it among other arguments.
#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;

void intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& query) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &query, &arguments);
}

void occlude(RTCScene scene, EmbreeContext& context, RTCRay& query) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &query, &arguments);
}

void initialize(EmbreeContext& context) { rtcInitRayQueryContext(&context); }
#else
using EmbreeContext = RTCIntersectContext;

void intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& query) { rtcIntersect1(scene, &context, &query); }

void occlude(RTCScene scene, EmbreeContext& context, RTCRay& query) { rtcOccluded1(scene, &context, &query); }

void initialize(EmbreeContext& context) { rtcInitIntersectContext(&context); }
#endif

struct TraceContext {
    EmbreeContext embree; // first member, because Embree passes its address
    Ray const* ray;
};

bool wasPassed(PassedTriangles const& passed, uint32_t part, uint32_t triangle) {
    const auto end = passed.triangles.begin() + passed.count;
    return std::any_of(passed.triangles.begin(), end, [&](PassedTriangles::Triangle const& other) {
        return other.part == part && other.index == triangle;
    });
}

// Called for every candidate; valid[0] = 0 rejects it.
void refuseWhatIsNotThere(RTCFilterFunctionNArguments const* arguments) {
    auto const& part = *static_cast<Part const*>(arguments->geometryUserPtr);
    Ray const& ray = *reinterpret_cast<TraceContext const*>(arguments->context)->ray;
    const uint32_t triangle = RTCHitN_primID(arguments->hit, 1, 0), geometry = RTCHitN_geomID(arguments->hit, 1, 0);
    const TrianglePoint point{ triangle, RTCHitN_u(arguments->hit, 1, 0), RTCHitN_v(arguments->hit, 1, 0) };
    const bool isCulled = ray.skipsBackFaces && !part.material->doubleSided &&
                          glm::dot(faceNormal(part, triangle), ray.direction) > 0;
    if (isCulled || (ray.passed && wasPassed(*ray.passed, geometry, triangle)) || isMaskedOut(part, point)) {
        arguments->valid[0] = 0;
    }
}

bool needsFilter(assets::MaterialData const& material) {
    const bool isPassed = material.alphaMode != assets::AlphaMode::Opaque || material.transmission.isUsed();
    return !material.doubleSided || isPassed;
}

// Embree reads 16 bytes at the last vertex, so it gets its own buffers, which it pads.
bool attach(RTCDevice device, RTCScene scene, Part const& part, uint32_t id) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   sizeof(float3), part.positions.size());
    void* const indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                  3 * sizeof(uint32_t), part.indices.size() / 3);
    if (vertices && indices) {
        std::copy(part.positions.begin(), part.positions.end(), static_cast<float3*>(vertices));
        std::copy(part.indices.begin(), part.indices.end(), static_cast<uint32_t*>(indices));
        rtcSetGeometryUserData(geometry, const_cast<Part*>(&part));
        if (needsFilter(*part.material)) {
            rtcSetGeometryIntersectFilterFunction(geometry, refuseWhatIsNotThere);
            rtcSetGeometryOccludedFilterFunction(geometry, refuseWhatIsNotThere);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
    }
    rtcReleaseGeometry(geometry);
    return vertices && indices;
}

Error embreeFailure(RTCError reason) {
    switch (reason) {
    case RTC_ERROR_OUT_OF_MEMORY:
        return fail(ErrorCode::OutOfMemory, "not enough memory to trace rays in this scene; use a smaller model");
    case RTC_ERROR_UNSUPPORTED_CPU:
        return fail(ErrorCode::DeviceUnavailable, "Embree does not run on this processor");
    default:
        return fail(ErrorCode::Internal, "Embree could not build the scene");
    }
}

RTCRay embreeRay(Ray const& ray) {
    RTCRay result{};
    result.org_x = static_cast<float>(ray.origin.x);
    result.org_y = static_cast<float>(ray.origin.y);
    result.org_z = static_cast<float>(ray.origin.z);
    result.dir_x = static_cast<float>(ray.direction.x);
    result.dir_y = static_cast<float>(ray.direction.y);
    result.dir_z = static_cast<float>(ray.direction.z);
    result.tnear = static_cast<float>(ray.nearest);
    result.tfar = static_cast<float>(ray.farthest);
    result.mask = ~0u;
    return result;
}

TraceContext contextOf(Ray const& ray) {
    TraceContext context{ {}, &ray };
    initialize(context.embree);
    return context;
}

} // namespace

void Intersector::Deleter::operator()(void* scene) const { rtcReleaseScene(static_cast<RTCScene>(scene)); }

Result<Intersector> Intersector::build(std::span<const Part> parts) {
    // One thread: it builds the same tree on every machine with this instruction set.
    RTCDevice device = rtcNewDevice("threads=1");
    if (!device) return embreeFailure(rtcGetDeviceError(nullptr));
    Intersector intersector(rtcNewScene(device)); // keeps a reference to the device
    const auto scene = static_cast<RTCScene>(intersector.mScene.get());
    // Else a ray could slip between two triangles along their common edge.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    bool isComplete = true;
    for (uint32_t i = 0; i < parts.size(); ++i) {
        if (!parts[i].indices.empty()) isComplete = isComplete && attach(device, scene, parts[i], i);
    }
    rtcCommitScene(scene);
    const RTCError reason = rtcGetDeviceError(device);
    rtcReleaseDevice(device);
    if (!isComplete || reason != RTC_ERROR_NONE) return embreeFailure(reason);
    return intersector;
}

std::optional<Hit> Intersector::nearest(Ray const& ray) const {
    TraceContext context = contextOf(ray);
    RTCRayHit query{ embreeRay(ray), {} };
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(static_cast<RTCScene>(mScene.get()), context.embree, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return Hit{ query.hit.geomID, { query.hit.primID, query.hit.u, query.hit.v }, query.ray.tfar };
}

bool Intersector::isOccluded(Ray const& ray) const {
    TraceContext context = contextOf(ray);
    RTCRay query = embreeRay(ray);
    occlude(static_cast<RTCScene>(mScene.get()), context.embree, query);
    return query.tfar < 0; // Embree's way to report a hit: minus infinity
}

} // namespace filament_core::reference
