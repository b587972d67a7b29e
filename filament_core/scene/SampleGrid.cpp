// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/SampleGrid.h"

#include <algorithm>
#include <cmath>

namespace filament_core::scene {
namespace {

constexpr float kBiasShare = 0.05f; // docs/irradiance-grids.md: walls that are thinner leak

float signOf(float x) { return x < 0 ? -1.0f : 1.0f; }

/// Beyond an edge of an octahedral map lies the same edge, from its other end.
float2 depthTexel(IrradianceProbes const& probes, size_t probe, int x, int y) {
    const auto size = static_cast<int>(probes.depthSize);
    if (x < 0 || x >= size) {
        x = std::clamp(x, 0, size - 1);
        y = size - 1 - y;
    }
    if (y < 0 || y >= size) {
        y = std::clamp(y, 0, size - 1);
        x = size - 1 - x;
    }
    return probes
            .depths[(probe * probes.depthSize + static_cast<size_t>(y)) * probes.depthSize + static_cast<size_t>(x)];
}

float2 depthIn(IrradianceProbes const& probes, size_t probe, float3 direction) {
    const float2 at = octahedralPlace(direction, probes.depthSize) - 0.5f;
    const float2 floor = glm::floor(at), share = at - floor;
    const int x = static_cast<int>(floor.x), y = static_cast<int>(floor.y);
    const float2 low = glm::mix(depthTexel(probes, probe, x, y), depthTexel(probes, probe, x + 1, y), share.x);
    const float2 high = glm::mix(depthTexel(probes, probe, x, y + 1), depthTexel(probes, probe, x + 1, y + 1), share.x);
    return glm::mix(low, high, share.y);
}

/// Along one axis: the probe below, and the share of the one above.
struct CellPlace {
    uint32_t first = 0;
    float share = 0;
};

CellPlace cellPlace(float local, float half, uint32_t count) {
    if (count == 1) return {};
    const auto last = static_cast<float>(count - 1);
    const float at = std::clamp((local / half * 0.5f + 0.5f) * last, 0.0f, last);
    const auto first = std::min(static_cast<uint32_t>(at), count - 2);
    return { first, at - static_cast<float>(first) };
}

} // namespace

float2 octahedralPlace(float3 direction, uint32_t size) {
    const float3 n = direction / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
    float2 place(n.x, n.y);
    if (n.z < 0) place = float2((1 - std::abs(n.y)) * signOf(n.x), (1 - std::abs(n.x)) * signOf(n.y));
    return (place * 0.5f + 0.5f) * static_cast<float>(size);
}

float3 octahedralDirection(float2 place, uint32_t size) {
    const float2 at = place / static_cast<float>(size) * 2.0f - 1.0f;
    float3 n(at, 1 - std::abs(at.x) - std::abs(at.y));
    if (n.z < 0) {
        const float2 folded = float2((1 - std::abs(at.y)) * signOf(at.x), (1 - std::abs(at.x)) * signOf(at.y));
        n.x = folded.x, n.y = folded.y;
    }
    return glm::normalize(n);
}

float3 spacingOf(GridRecord const& grid) {
    float3 spacing(0);
    for (int axis = 0; axis < 3; ++axis)
        spacing[axis] = 2 * grid.halfExtent[axis] / static_cast<float>(std::max(grid.probes->count[axis], 2u) - 1);
    return spacing;
}

float biasOf(GridRecord const& grid) {
    const float3 spacing = spacingOf(grid);
    return kBiasShare * std::min({ spacing.x, spacing.y, spacing.z });
}

float3 placeOf(GridRecord const& grid, uint3 probe) {
    float3 place(0);
    for (int axis = 0; axis < 3; ++axis) {
        const uint32_t count = grid.probes->count[axis];
        if (count > 1)
            place[axis] =
                    grid.halfExtent[axis] * (2 * static_cast<float>(probe[axis]) / static_cast<float>(count - 1) - 1);
    }
    return place;
}

float visibilityOf(IrradianceProbes const& probes, size_t probe, float3 toPoint, float biasMeters) {
    const float distance = glm::length(toPoint) - biasMeters;
    if (probes.depthSize == 0 || distance <= 0) return 1;
    const float2 seen = depthIn(probes, probe, toPoint);
    if (distance <= seen.x) return 1;
    const float beyond = distance - seen.x;
    const float variance = std::max(std::abs(seen.y - seen.x * seen.x), biasMeters * biasMeters * 0.0625f);
    const float chance = variance / (variance + beyond * beyond);
    return chance * chance * chance;
}

GridSample sampleGrid(GridRecord const& grid, float3 local, bool seesThroughWalls) {
    IrradianceProbes const& probes = *grid.probes;
    const uint3 count = probes.count;
    std::array<CellPlace, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
        cell[static_cast<size_t>(axis)] = cellPlace(local[axis], grid.halfExtent[axis], count[axis]);
    const float bias = biasOf(grid);
    GridSample sample;
    float outside = 0; // of geometry
    for (uint32_t corner = 0; corner < 8; ++corner) {
        float weight = 1;
        uint3 at(0);
        for (int axis = 0; axis < 3; ++axis) {
            const bool isUpper = (corner >> axis & 1) != 0;
            CellPlace const& place = cell[static_cast<size_t>(axis)];
            at[axis] = place.first + (isUpper ? 1 : 0);
            weight *= isUpper ? place.share : 1 - place.share;
        }
        if (weight <= 0) continue;
        const size_t probe = (size_t{ at.z } * count.y + at.y) * count.x + at.x;
        if (probes.probes[probe].isInside) continue;
        outside += weight;
        if (!seesThroughWalls) weight *= visibilityOf(probes, probe, local - placeOf(grid, at), bias);
        sample.weight += weight;
        for (size_t i = 0; i < sample.light.size(); ++i) sample.light[i] += grid.irradianceSh[probe][i] * weight;
    }
    if (sample.weight <= 1e-6f) return {};
    for (float3& coefficient : sample.light) coefficient /= sample.weight;
    sample.weight /= outside;
    return sample;
}

} // namespace filament_core::scene
