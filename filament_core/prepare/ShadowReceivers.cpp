// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/ShadowReceivers.h"

#include "filament_core/prepare/ReduceRanges.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace filament_core::prepare {
namespace {

double nearPlane(ViewSpace const& space) {
    const double4x4 clip(space.clipFromView);
    const bool isOrdinary = clip[2][2] < 0; // of parallel ones: the depth at the near plane is 0
    const double near = clip[3][3] == 0 || clip[2][2] == 0 ? std::abs(clip[3][2])
                                                           : (clip[3][2] - (isOrdinary ? 0.0 : 1.0)) / clip[2][2];
    return std::max(near, 1e-6);
}

void addBox(ShadowReceivers& receivers, double3 const& center, double3 const& half, ViewSpace const& space,
            double nearMeters) {
    const double3 forward(space.forward);
    const double depth = glm::dot(center - space.cameraWorld, forward), reach = glm::dot(glm::abs(forward), half);
    if (!std::isfinite(depth + reach) || depth + reach < nearMeters) return;
    ++receivers.count;
    receivers.min = glm::min(receivers.min, center - half);
    receivers.max = glm::max(receivers.max, center + half);
    receivers.nearest = std::min(receivers.nearest, std::max(depth - reach, nearMeters));
    receivers.farthest = std::max(receivers.farthest, depth + reach);
}

/// Blocks as a light sees them, by more than all roundings too large. Minima and maxima are the same in any order, so
/// blocks inside of what is known need no look at their members.
class BlockExtents {
public:
    BlockExtents(scene::RestingBlocks const& blocks, double3x3 const& worldFromLight)
            : mBlocks(blocks), mWorldFromLight(worldFromLight) {}

    /// In each of six directions.
    std::array<uint32_t, 6> farthest() const {
        std::array<uint32_t, 6> found{};
        LightSpaceBox all;
        for (uint32_t block = 0; block < mBlocks.limit(); ++block) {
            const LightSpaceBox box = of(block);
            for (int axis = 0; axis < 3; ++axis) {
                if (box.min[axis] < all.min[axis]) found[static_cast<size_t>(axis)] = block;
                if (box.max[axis] > all.max[axis]) found[static_cast<size_t>(axis) + 3] = block;
            }
            all.add(box);
        }
        return found;
    }

    bool reachesBeyond(LightSpaceBox const& known, uint32_t block) const {
        const LightSpaceBox box = of(block);
        return glm::any(glm::lessThan(box.min, known.min)) || glm::any(glm::greaterThan(box.max, known.max));
    }

private:
    LightSpaceBox of(uint32_t block) const {
        if (mBlocks.members(block).empty()) return {};
        const double3 center = mBlocks.bounds().centerAt(block);
        const float3 half = mBlocks.bounds().halfExtentAt(block);
        LightSpaceBox box = inLightSpace(mWorldFromLight, center, half);
        const double margin = 1e-12 * glm::dot(glm::abs(center) + double3(half), double3(1));
        return { box.min - margin, box.max + margin };
    }

    scene::RestingBlocks const& mBlocks;
    double3x3 mWorldFromLight;
};

} // namespace

ShadowReceivers findReceivers(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                              ViewPacket const& view, ViewSpace const& space, ShadowFilter filter) {
    scene::Renderables const& renderables = scene.renderables;
    const double nearMeters = nearPlane(space);
    return reduceRanges<ShadowReceivers>(
            jobs, arena, view.objects.size(),
            [&](ShadowReceivers& part, size_t i) {
                const uint32_t at = view.objects.order[i].renderable;
                scene::Drawable const& drawable = renderables.drawables[renderables.drawable[at]];
                if (!drawable.properties.receivesShadows || !canReceiveShadows(*drawable.material->material, filter))
                    return;
                addBox(part, renderables.bounds.centerAt(at), double3(renderables.bounds.halfExtentAt(at)), space,
                       nearMeters);
            },
            [](ShadowReceivers& whole, ShadowReceivers const& part) {
                whole.count += part.count;
                whole.min = glm::min(whole.min, part.min);
                whole.max = glm::max(whole.max, part.max);
                whole.nearest = std::min(whole.nearest, part.nearest);
                whole.farthest = std::max(whole.farthest, part.farthest);
            });
}

void addFog(ShadowReceivers& receivers, ViewSpace const& space, float meters) {
    const double4x4 worldFromClip = glm::inverse(double4x4(space.clipFromWorld));
    const double nearMeters = nearPlane(space), farMeters = std::max(static_cast<double>(meters), nearMeters);
    const double3 forward(space.forward);
    ++receivers.count;
    receivers.nearest = std::min(receivers.nearest, nearMeters);
    receivers.farthest = std::max(receivers.farthest, farMeters);
    for (int corner = 0; corner < 4; ++corner) {
        const double2 place((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1);
        // Two points of the frustum's edge; the edge is a line, so that the others follow from them.
        const auto pointAt = [&](double depth) {
            const double4 point = worldFromClip * double4(place, depth, 1);
            return double3(point) / point.w;
        };
        const double3 a = pointAt(0.25), b = pointAt(0.75);
        const double depthOfA = glm::dot(a, forward), depthOfB = glm::dot(b, forward);
        for (const double depth : { nearMeters, farMeters }) {
            const double3 point = space.cameraWorld + a + (b - a) * ((depth - depthOfA) / (depthOfB - depthOfA));
            receivers.min = glm::min(receivers.min, point);
            receivers.max = glm::max(receivers.max, point);
        }
    }
}

LightSpaceBox sceneInLightSpace(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                                double3x3 const& worldFromLight, Layers visibleLayers) {
    constexpr int kNothing = scene::kNeverDrawn | scene::kCollapsed;
    const auto add = [&](LightSpaceBox& part, size_t i) {
        if ((renderables.flags[i] & kNothing) != 0 || (renderables.layers[i] & visibleLayers) == 0) return;
        part.add(inLightSpace(worldFromLight, renderables.bounds.centerAt(i), renderables.bounds.halfExtentAt(i)));
    };
    const auto join = [](LightSpaceBox& whole, LightSpaceBox const& part) { whole.add(part); };
    scene::RestingBlocks const& blocks = renderables.blocks;
    if (!blocks.holdMost()) return reduceRanges<LightSpaceBox>(jobs, arena, renderables.count(), add, join);

    const auto addMembers = [&](LightSpaceBox& part, uint32_t block) {
        for (const uint32_t i : blocks.members(block)) add(part, i);
    };
    LightSpaceBox known = reduceRanges<LightSpaceBox>(
            jobs, arena, blocks.words().size(),
            [&](LightSpaceBox& part, size_t word) {
                for (uint64_t left = blocks.words()[word].unsettled; left != 0; left &= left - 1)
                    add(part, word * 64 + static_cast<size_t>(std::countr_zero(left)));
            },
            join);
    const BlockExtents extents(blocks, worldFromLight);
    for (const uint32_t block : extents.farthest()) addMembers(known, block);
    const LightSpaceBox others = reduceRanges<LightSpaceBox>(
            jobs, arena, blocks.limit(),
            [&](LightSpaceBox& part, size_t block) {
                if (extents.reachesBeyond(known, static_cast<uint32_t>(block)))
                    addMembers(part, static_cast<uint32_t>(block));
            },
            join);
    known.add(others);
    return known;
}

} // namespace filament_core::prepare
