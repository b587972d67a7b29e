// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PreparePick.h"

#include "filament_core/prepare/DeformationData.h"
#include "filament_core/prepare/ViewConstants.h"
#include "filament_core/scene/SceneNodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace filament_core::prepare {
namespace {

/// In clip space, from the left and from the top.
double2 centerOf(uint2 pixel, uint2 size) { return 2.0 * (double2(pixel) + 0.5) / double2(size) - 1.0; }

/// The view of a pixel and those around it, as a projection: everything that the pixel shows is in its frustum.
ViewInput aroundPixel(ViewInput view, uint2 pixel) {
    const float4x4 whole = makeViewSpace(view).clipFromView;
    const double2 center = centerOf(pixel, view.size), scale = double2(view.size) / 2.0;
    float4x4 clip = whole;
    for (int column = 0; column < 4; ++column) {
        const double2 moved = double2(whole[column].x, whole[column].y) - center * static_cast<double>(whole[column].w);
        clip[column].x = static_cast<float>(moved.x * scale.x), clip[column].y = static_cast<float>(moved.y * scale.y);
    }
    view.clipFromView = clip;
    return view;
}

struct PickCandidate {
    DrawCall draw;
    uint32_t renderable = 0;
};

/// Transparent objects are drawn by another material; a background is no surface.
bool isPickable(DrawCall const& draw) {
    scene::Material const& material = *draw.material->material;
    return draw.pass != DrawPass::Second &&
           (material.isBlended() || material.package.findVariant(shader::kVariantDepth) != nullptr);
}

size_t candidatesIn(std::span<const DrawCall> draws) {
    size_t count = 0;
    for (DrawCall const& draw : draws) count += isPickable(draw) ? draw.instanceCount : 0;
    return count;
}

bool isHit(scene::SceneData const& scene, uint32_t renderable, PickAim aim) {
    if (scene.atNodes.pickRules.empty()) return true;
    return scene::isPickable(scene, scene::nodeOf(scene, scene.renderables.index.handleAt(renderable)), aim);
}

std::span<PickCandidate> candidatesOf(Arena& arena, scene::SceneData const& scene, ViewPacket const& view,
                                      PickAim aim) {
    const auto candidates = arena.array<PickCandidate>(candidatesIn(view.opaque) + candidatesIn(view.blended));
    size_t count = 0;
    for (const std::span<const DrawCall> draws : { view.opaque, view.blended }) {
        for (DrawCall const& draw : draws) {
            if (!isPickable(draw)) continue;
            for (uint32_t i = 0; i < draw.instanceCount; ++i) {
                const uint32_t renderable = view.objects.order[draw.firstObject + i].renderable;
                if (!isHit(scene, renderable, aim)) continue;
                PickCandidate& candidate = candidates[count++];
                candidate = { draw, renderable };
                candidate.draw.firstObject += i;
                candidate.draw.instanceCount = 1;
                candidate.draw.pass = DrawPass::Only;
            }
        }
    }
    return candidates.first(count);
}

/// Those whose boxes begin nearest, in their order.
std::span<PickCandidate> nearestOf(Arena& arena, std::span<PickCandidate> all, scene::Renderables const& renderables,
                                   ViewSpace const& space) {
    if (all.size() <= kMostCandidates) return all;
    const auto begins = arena.arrayForOverwrite<float>(all.size());
    for (size_t i = 0; i < all.size(); ++i) {
        const uint32_t at = all[i].renderable;
        const float3 center(renderables.bounds.centerAt(at) - space.cameraWorld);
        const float begin = glm::dot(space.forward, center) -
                            glm::dot(glm::abs(space.forward), renderables.bounds.halfExtentAt(at));
        begins[i] = std::isfinite(begin) ? begin : 0.0f;
    }
    const auto order = arena.arrayForOverwrite<uint32_t>(all.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::nth_element(order, order.begin() + kMostCandidates,
                             [&](uint32_t a, uint32_t b) { return std::pair(begins[a], a) < std::pair(begins[b], b); });
    // Back in the order of drawing, which decides between equal depths, as it does in the image.
    std::ranges::sort(order.first(kMostCandidates));
    for (size_t i = 0; i < kMostCandidates; ++i) all[i] = all[order[i]];
    return all.first(kMostCandidates);
}

/// As many as there is room for.
std::span<const uint32_t> frontsOf(Arena& arena, std::span<const PickCandidate> candidates,
                                   SectionPlanes const& section) {
    if (!section.isUsed() || !section.caps) return {};
    const auto fronts = arena.array<uint32_t>(candidates.size());
    size_t count = 0;
    for (uint32_t i = 0; i < candidates.size() && candidates.size() + count < kMostCandidates; ++i)
        if (candidates[i].draw.material->material->package.sectionPlanes) fronts[count++] = i;
    return fronts.first(count);
}

} // namespace

PreparedPick preparePick(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                         uint2 pixel, PickAim aim, std::span<const DrawnLevel> last) {
    ViewInput reversed = view;
    // pickedPoint() computes the distance from a reversed depth, which is also the more precise one.
    reversed.quality.depthRange = DepthRange::Reversed;
    const FrameSettings settings = resolve(reversed);
    // Culling sees the few pixels around the picked one, but levels of detail are chosen by the whole view: in the
    // magnified one they would be finer than what the user sees and clicks.
    PreparedView prepared =
            prepareView(jobs, arena, scene, aroundPixel(reversed, pixel), settings, LevelChoice(scene, reversed, last));
    const ViewSpace space = makeViewSpace(reversed);
    const std::span<const PickCandidate> candidates =
            nearestOf(arena, candidatesOf(arena, scene, prepared.packet, aim), scene.renderables, space);
    const auto packets = arena.array<ViewPacket>(1);
    ViewPacket& packet = packets[0];
    packet.kind = ViewKind::Depth; // nothing is lit
    writeFrameUniforms(packet.uniforms, space, reversed, scene);
    packet.objects = prepared.packet.objects;
    const std::span<const uint32_t> fronts = frontsOf(arena, candidates, view.section);
    const auto draws = arena.array<DrawCall>(candidates.size() + fronts.size());
    const auto renderables = arena.array<uint32_t>(candidates.size());
    for (size_t i = 0; i < candidates.size(); ++i) {
        draws[i] = candidates[i].draw;
        renderables[i] = candidates[i].renderable;
    }
    for (size_t i = 0; i < fronts.size(); ++i) {
        DrawCall& front = draws[candidates.size() + i];
        front = candidates[fronts[i]].draw;
        front.pass = DrawPass::Second;
    }
    packet.opaque = draws;
    PreparedPick pick{ .renderables = renderables, .fronts = fronts };
    pick.packet.views = packets;
    pick.packet.settings = settings;
    pick.packet.deformations = placeDeformations(arena, scene, std::span(&prepared.visible, 1));
    packet.objects.places = pick.packet.deformations.places;
    return pick;
}

PickedPoint pickedPoint(Camera const& camera, uint2 size, uint2 pixel, float depth) {
    Lens const& lens = camera.lens;
    const double near = static_cast<double>(lens.nearMeters), far = static_cast<double>(lens.farMeters);
    const double distance =
            lens.isOrthographic() ? far - (far - near) * static_cast<double>(depth) : near / static_cast<double>(depth);
    const double aspect = static_cast<double>(size.x) / size.y;
    const double3 view = camera.viewFromPicture(centerOf(pixel, size), distance, aspect);
    return { distance, double3(camera.worldFromView * double4(view, 1)) };
}

// shaders/material/surface/section.glsl has the same in floats.
std::optional<PickedPoint> pickedCap(SectionPlanes const& section, Camera const& camera, PickedPoint const& point) {
    constexpr double kEndless = 1e300;
    const double3 eye = camera.position(), forward = -double3(camera.worldFromView[2]);
    const bool isParallel = camera.lens.isOrthographic();
    const double3 along = isParallel ? forward : glm::normalize(point.positionWorld - eye);
    const bool isCorner = section.cut == SectionCut::Corner;
    double entry = isCorner ? -kEndless : kEndless, leaves = kEndless;
    bool exists = false;
    for (double4 const& plane : section.planes) {
        if (!SectionPlanes::isPlane(plane)) continue;
        const double slope = dot(double3(plane), along);
        const double back = (dot(double3(plane), point.positionWorld) + plane.w) / slope;
        const bool beginsBehind = isParallel ? slope > 0 : dot(double3(plane), eye) + plane.w < 0;
        if (beginsBehind && slope > 0) {
            entry = isCorner ? std::max(entry, back) : std::min(entry, back);
            exists = true;
        } else if (isCorner && !beginsBehind) {
            leaves = slope < 0 ? std::min(leaves, back) : -kEndless;
        }
    }
    if (!exists || (isCorner && !(leaves > entry && leaves + entry > 0))) return {};
    const double3 cap = point.positionWorld - along * entry;
    const double distance = dot(cap - eye, forward);
    if (distance < static_cast<double>(camera.lens.nearMeters)) return {};
    return PickedPoint{ distance, cap };
}

bool isBehindSection(SectionPlanes const& section, Camera const& camera, PickedPoint const& point) {
    constexpr double kSlack = 4e-6; // kSectionSlack
    const double3 fromEye = point.positionWorld - camera.position();
    const double3 along = camera.lens.isOrthographic() ? -double3(camera.worldFromView[2]) : fromEye;
    const double slack = kSlack * (std::abs(fromEye.x) + std::abs(fromEye.y) + std::abs(fromEye.z));
    return std::ranges::any_of(section.planes, [&](double4 const& plane) {
        if (!SectionPlanes::isPlane(plane) || dot(double3(plane), along) > 0) return false;
        return dot(double3(plane), point.positionWorld) + plane.w < slack * glm::length(double3(plane));
    });
}

uint32_t primitiveOf(scene::SceneData const& scene, Renderable renderable) {
    scene::Attachments<RenderableObject> const& attached = scene.atNodes.renderables;
    if (!attached.isAttached(renderable)) return 0;
    uint32_t later = 0, count = 0; // the newest is the first of the list
    attached.forEach(attached.nodeOf(renderable), [&](Renderable other) {
        if (other == renderable) later = count;
        ++count;
    });
    return count - 1 - later;
}

} // namespace filament_core::prepare
