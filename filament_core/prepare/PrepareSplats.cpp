// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareSplats.h"

#include "base/math/Frustum.h"
#include "base/math/Half.h"
#include "filament_core/prepare/SortItems.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace filament_core::prepare {
namespace {

using scene::Covariance;
using scene::kSplatReach;
using scene::SplatData;

constexpr size_t kSplatRange = 2048;
constexpr float kMostColor = 64; // decoded, it still is a half float
// These two as in the implementation of Kerbl et al. 2023, for which clouds are trained.
constexpr float kLowPass = 0.3f;    // square pixels
constexpr float kWidestLens = 1.3f; // the Jacobian is that of a point at most so far from the middle of the image

/// A cloud in view.
struct CloudView {
    SplatData const* data = nullptr;
    float3x3 viewFromObject{ 1.0f };
    float3 originView{ 0.0f };
    float3 eyeObject{ 0.0f };
    size_t first = 0; ///< of its splats among all of the list
};

float3x3 linearPartOf(scene::Placement const& placement) {
    return glm::transpose(float3x3(placement.rows[0], placement.rows[1], placement.rows[2]));
}

/// Where the camera is in the space of the object; the origin for an object without a volume.
float3 eyeIn(scene::Placement const& placement, double3 const& cameraWorld) {
    const double3x3 linear(linearPartOf(placement));
    const double volume = glm::determinant(linear);
    if (!(std::abs(volume) > 1e-300)) return float3(0);
    return float3(glm::inverse(linear) * (cameraWorld - placement.translation));
}

bool isShown(scene::SceneData const& scene, uint32_t at, ViewSpace const& space) {
    scene::Renderables const& renderables = scene.renderables;
    if (renderables.flags[at] & (scene::kHidden | scene::kCollapsed)) return false;
    if ((renderables.layers[at] & space.visibleLayers) == 0) return false;
    if (!(renderables.flags[at] & scene::kCulled)) return true;
    const float3 center(renderables.bounds.centerAt(at) - space.cameraWorld);
    return intersects(space.frustum, center, renderables.bounds.halfExtentAt(at));
}

CloudView viewOf(SplatData const& data, scene::Placement const& placement, ViewSpace const& space, size_t first) {
    const float3x3 viewFromWorld(space.viewFromWorld);
    return { .data = &data,
             .viewFromObject = viewFromWorld * linearPartOf(placement),
             .originView = viewFromWorld * float3(placement.translation - space.cameraWorld),
             .eyeObject = eyeIn(placement, space.cameraWorld),
             .first = first };
}

/// Symmetric, of the projected Gaussian in square pixels.
struct Spread {
    float xx = 0, xy = 0, yy = 0;
};

float3 times(Covariance const& c, float3 v) {
    return { c.xx * v.x + c.xy * v.y + c.xz * v.z, c.xy * v.x + c.yy * v.y + c.yz * v.z,
             c.xz * v.x + c.yz * v.y + c.zz * v.z };
}

/// J W Sigma W^T J^T of Zwicker et al. 2001, equation 31, and the low-pass.
Spread spreadOf(Covariance const& covariance, float3 alongX, float3 alongY) {
    const float3 bySpreadX = times(covariance, alongX), bySpreadY = times(covariance, alongY);
    return { glm::dot(alongX, bySpreadX) + kLowPass, glm::dot(alongX, bySpreadY),
             glm::dot(alongY, bySpreadY) + kLowPass };
}

/// Standard deviations along the axes of the ellipse, in pixels.
std::array<float2, 2> axesOf(Spread const& s) {
    const float mean = 0.5f * (s.xx + s.yy), half = 0.5f * (s.xx - s.yy);
    const float largest = std::max(std::abs(half), std::abs(s.xy)); // whose square may be too large for a float
    const float2 turn = largest > 0 ? float2(half, s.xy) / largest : float2(0);
    const float tilt = std::sqrt(glm::dot(turn, turn)), radius = largest * tilt;
    // The direction has half the angle of `turn`. Of its two forms, (cos + 1, sin) and (sin, 1 - cos), this takes the
    // one that does not cancel.
    const float2 along = half >= 0 ? float2(turn.x + tilt, turn.y) : float2(turn.y, tilt - turn.x);
    const float length = std::sqrt(glm::dot(along, along));
    const float2 unit = length > 0 ? along / length : float2(1, 0);
    const float longer = std::sqrt(mean + radius), shorter = std::sqrt(std::max(mean - radius, kLowPass));
    return { longer * unit, shorter * float2(-unit.y, unit.x) };
}

/// Projects the splats of a view.
class Projector {
public:
    Projector(ViewSpace const& space, uint2 size) : mSize(size), mClipFromView(space.clipFromView) {
        const float4x4 rows = glm::transpose(mClipFromView);
        for (int i = 0; i < 4; ++i) mRows[static_cast<size_t>(i)] = rows[i];
    }

    /// Nothing for a splat that is not seen. `key`: smaller is farther.
    std::optional<SplatQuad> project(CloudView const& cloud, size_t i, uint32_t& key) const {
        SplatData const& data = *cloud.data;
        if (!(data.opacities[i] > 0)) return std::nullopt;
        const float3 position = data.positions[i];
        const float3 centerView = cloud.viewFromObject * position + cloud.originView;
        const float4 clip = mClipFromView * float4(centerView, 1);
        if (!(clip.w > 0)) return std::nullopt;
        const float3 ndc = float3(clip) / clip.w;
        if (!(ndc.z >= 0 && ndc.z <= 1)) return std::nullopt;
        const float2 pixels = 0.5f * float2(mSize);
        const auto gradient = [&](int axis) {
            const float at = std::clamp(ndc[axis], -kWidestLens, kWidestLens);
            const float3 ofLens(mRows[static_cast<size_t>(axis)] - at * mRows[3]);
            return (ofLens * cloud.viewFromObject) * (pixels[axis] / clip.w);
        };
        const Spread spread = spreadOf(data.covariances[i], gradient(0), gradient(1));
        const float2 reach = kSplatReach * glm::sqrt(float2(spread.xx, spread.yy)) / pixels;
        const bool isSeen = std::abs(ndc.x) - reach.x < 1 && std::abs(ndc.y) - reach.y < 1;
        if (!isSeen || !std::isfinite(reach.x + reach.y)) return std::nullopt;
        // By distance, not by depth: a camera that turns in its place changes no order, so nothing pops. The bits of
        // positive floats have the order of their values, and a square that of its root.
        key = ~std::bit_cast<uint32_t>(glm::dot(centerView, centerView));
        return quadOf(cloud, i, ndc, spread);
    }

private:
    SplatQuad quadOf(CloudView const& cloud, size_t i, float3 ndc, Spread const& spread) const {
        SplatData const& data = *cloud.data;
        SplatQuad quad{ .center = ndc, .axes = axesOf(spread) };
        for (float2& axis : quad.axes) axis *= kSplatReach * 2.0f / float2(mSize);
        const float3 towards = data.positions[i] - cloud.eyeObject;
        const float length = std::sqrt(glm::dot(towards, towards));
        const size_t perSplat = size_t{ data.degree + 1 } * (data.degree + 1);
        const uint32_t degree = length > 0 && std::isfinite(length) ? data.degree : 0;
        const float3 color =
                splatColor(std::span(data.harmonics).subspan(i * perSplat, perSplat), degree, towards / length);
        for (size_t c = 0; c < 3; ++c)
            quad.color[c] = halfFromFloat(std::clamp(color[static_cast<int>(c)], 0.0f, kMostColor));
        quad.color[3] = halfFromFloat(data.opacities[i]);
        return quad;
    }

    uint2 mSize;
    float4x4 mClipFromView;
    std::array<float4, 4> mRows;
};

/// Clouds in view, by the encoding of their colours, and how many splats they have.
struct CloudsInView {
    std::array<std::span<CloudView>, 2> clouds;
    std::array<size_t, 2> splats{};
};

CloudsInView findClouds(Arena& arena, scene::SceneData const& scene, ViewSpace const& space) {
    CloudsInView found;
    std::array<size_t, 2> counts{};
    for (auto& clouds : found.clouds) clouds = arena.array<CloudView>(scene.splats.size());
    for (scene::SplatRecord const& record : scene.splats) {
        const uint32_t at = scene.renderables.index.at(record.renderable);
        if (!isShown(scene, at, space)) continue;
        const auto kind = static_cast<size_t>(record.data->colors);
        found.clouds[kind][counts[kind]++] =
                viewOf(*record.data, scene.renderables.placement[at], space, found.splats[kind]);
        found.splats[kind] += record.data->count();
    }
    for (size_t kind = 0; kind < 2; ++kind) found.clouds[kind] = found.clouds[kind].first(counts[kind]);
    return found;
}

/// Projects splats [begin, end) of the list. Returns how many items it has written, to `items` from the front.
size_t projectRange(Projector const& projector, std::span<const CloudView> clouds, size_t begin, size_t end,
                    std::span<SplatQuad> quads, SortItem* items) {
    auto cloud = std::ranges::upper_bound(clouds, begin, {}, &CloudView::first) - 1;
    size_t written = 0;
    for (size_t i = begin; i < end; ++i) {
        while (i - cloud->first >= cloud->data->count()) ++cloud;
        uint32_t key = 0;
        const std::optional<SplatQuad> quad = projector.project(*cloud, i - cloud->first, key);
        if (!quad) continue;
        quads[i] = *quad;
        items[written++] = { key, static_cast<uint32_t>(i), static_cast<uint32_t>(i) };
    }
    return written;
}

SplatList listOf(jobs::JobSystem& jobs, Arena& arena, Projector const& projector, std::span<const CloudView> clouds,
                 size_t count) {
    if (count == 0) return {};
    const size_t ranges = (count + kSplatRange - 1) / kSplatRange;
    const auto quads = arena.arrayForOverwrite<SplatQuad>(count);
    const auto items = arena.arrayForOverwrite<SortItem>(count);
    const auto counts = arena.array<size_t>(ranges);
    jobs::parallelFor<"project splats">(jobs, count, kSplatRange, [&](size_t begin, size_t end) {
        counts[begin / kSplatRange] = projectRange(projector, clouds, begin, end, quads, &items[begin]);
    });
    size_t visible = 0;
    for (size_t range = 0; range < ranges; ++range) {
        // In the order of ranges, so that splats of equal distances keep that of the scene: the sort is stable.
        SortItem const* const from = items.data() + range * kSplatRange;
        SortItem* const to = items.data() + visible;
        if (from != to) std::copy(from, from + counts[range], to);
        visible += counts[range];
    }
    const std::span<const SortItem> order = sortItems(jobs, arena, items.first(visible));
    return { quads, order.last(std::min(order.size(), kMaxVisibleSplats)) };
}

} // namespace

// The functions of the specification's appendix A, with x, y and z of the direction.
float3 splatColor(std::span<const float3> harmonics, uint32_t degree, float3 direction) {
    const float x = direction.x, y = direction.y, z = direction.z;
    float3 sum = 0.2820947917738781f * harmonics[0];
    if (degree >= 1) {
        constexpr float k = 0.4886025119029199f;
        sum += k * (z * harmonics[2] - y * harmonics[1] - x * harmonics[3]);
    }
    if (degree >= 2) {
        sum += 1.092548430592079f * (x * y * harmonics[4] - y * z * harmonics[5] - x * z * harmonics[7]);
        sum += 0.31539156525252f * (2 * z * z - x * x - y * y) * harmonics[6];
        sum += 0.5462742152960395f * (x * x - y * y) * harmonics[8];
    }
    if (degree >= 3) {
        const float ring = 4 * z * z - x * x - y * y;
        sum -= 0.5900435899266435f * (y * (3 * x * x - y * y) * harmonics[9] + x * (x * x - 3 * y * y) * harmonics[15]);
        sum += 2.890611442640554f * (x * y * z) * harmonics[10];
        sum -= 0.4570457994644657f * ring * (y * harmonics[11] + x * harmonics[13]);
        sum += 0.3731763325901154f * (z * (2 * z * z - 3 * x * x - 3 * y * y)) * harmonics[12];
        sum += 1.445305721320277f * (z * (x * x - y * y)) * harmonics[14];
    }
    return glm::max(sum + 0.5f, float3(0));
}

SplatPacket prepareSplats(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewSpace const& space,
                          uint2 size) {
    SplatPacket packet{ .inScene = static_cast<uint32_t>(scene.splats.size()) };
    if (scene.splats.empty()) return packet;
    const CloudsInView found = findClouds(arena, scene, space);
    const Projector projector(space, size);
    for (size_t kind = 0; kind < 2; ++kind)
        packet.lists[kind] = listOf(jobs, arena, projector, found.clouds[kind], found.splats[kind]);
    return packet;
}

void writeSplatVertices(jobs::JobSystem& jobs, SplatList const& list, std::span<SplatVertex> vertices) {
    const uint16_t above = halfFromFloat(kSplatReach), below = halfFromFloat(-kSplatReach);
    jobs::parallelFor<"write splats">(jobs, list.size(), kSplatRange, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            SplatQuad const& quad = list.quads[list.order[i].draw];
            const float2 center(quad.center), u = quad.axes[0], v = quad.axes[1];
            const auto corner = [&](float2 place, uint16_t x, uint16_t y) {
                return SplatVertex{ float3(place, quad.center.z), quad.color, { x, y } };
            };
            vertices[4 * i + 0] = corner(center - u - v, below, below);
            vertices[4 * i + 1] = corner(center + u - v, above, below);
            vertices[4 * i + 2] = corner(center + u + v, above, above);
            vertices[4 * i + 3] = corner(center - u + v, below, above);
        }
    });
}

} // namespace filament_core::prepare
