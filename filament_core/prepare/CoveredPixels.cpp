// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/CoveredPixels.h"

#include "filament_core/prepare/ReduceRanges.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

PixelBox allOf(uint2 view) { return { float2(0.0f), float2(view) }; }

/// Whether its vertices stay in its box, which culling goes by, too.
bool isBounded(scene::Renderables const& renderables, uint32_t renderable) {
    const shader::VertexDomain domain =
            renderables.drawables[renderables.drawable[renderable]].material->material->package.vertexDomain;
    const bool isInWorld = domain == shader::VertexDomain::Object || domain == shader::VertexDomain::World;
    return isInWorld && (renderables.flags[renderable] & scene::kCulled) != 0;
}

bool holds(PixelBox const& box, PixelBox const& other) {
    return box.least.x <= other.least.x && box.least.y <= other.least.y && box.most.x >= other.most.x &&
           box.most.y >= other.most.y;
}

struct PixelSpan {
    uint32_t first, end;
};

/// Around [least, most], of `size` pixels.
PixelSpan spanAround(float least, float most, uint32_t size) {
    const auto pixelAt = [size](float at) {
        return static_cast<uint32_t>(std::clamp(std::floor(at), 0.0f, static_cast<float>(size)));
    };
    // At even pixels: a texel of ambient occlusion at half the resolution is two pixels wide.
    const uint32_t first = std::min(pixelAt(least - static_cast<float>(kCoverMargin)), size - 1) & ~1u;
    const uint32_t end = (pixelAt(most + static_cast<float>(kCoverMargin)) + 2) & ~1u;
    return { first, std::clamp(end, first + 1, size) };
}

} // namespace

PixelBox coveredBy(scene::Renderables const& renderables, uint32_t renderable, ViewSpace const& space, uint2 view) {
    if (!isBounded(renderables, renderable)) return allOf(view);
    const float3 center(renderables.bounds.centerAt(renderable) - space.cameraWorld);
    return projectedBox(space.clipFromWorld, center, renderables.bounds.halfExtentAt(renderable), view);
}

backend::Rect coveredPixels(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewPacket const& view,
                            ViewSpace const& space, uint2 size) {
    struct Covered {
        PixelBox box{ float2(HUGE_VALF), float2(-HUGE_VALF) };
    };
    const Covered all = reduceRanges<Covered>(
            jobs, arena, view.objects.size(),
            [&](Covered& part, size_t i) {
                if (holds(part.box, allOf(size))) return;
                const uint32_t at = view.objects.order[i].renderable;
                part.box = unionOf(part.box, coveredBy(scene.renderables, at, space, size));
            },
            [](Covered& whole, Covered const& part) { whole.box = unionOf(whole.box, part.box); });
    const PixelSpan x = spanAround(all.box.least.x, all.box.most.x, size.x);
    const PixelSpan y = spanAround(all.box.least.y, all.box.most.y, size.y);
    return { static_cast<int32_t>(x.first), static_cast<int32_t>(y.first), x.end - x.first, y.end - y.first };
}

} // namespace filament_core::prepare
