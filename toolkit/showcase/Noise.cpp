// SPDX-License-Identifier: Apache-2.0
#include "toolkit/showcase/Noise.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>

namespace filament_core::showcase {
namespace {

int wrapped(int value, int period) {
    const int rest = value % period;
    return rest < 0 ? rest + period : rest;
}

int2 wrapped(int2 cell, int2 period) { return { wrapped(cell.x, period.x), wrapped(cell.y, period.y) }; }

float smooth(float t) { return t * t * (3 - 2 * t); }

} // namespace

float cellRandom(int2 cell, uint32_t seed) {
    // Multiply, shift, xor; constants of Wellons 2018, "Prospecting for Hash Functions" (lowbias32).
    uint32_t hash = static_cast<uint32_t>(cell.x) * 0x9e3779b9u ^ (static_cast<uint32_t>(cell.y) + seed * 0x85ebca6bu);
    hash = (hash ^ (hash >> 16)) * 0x7feb352du;
    hash = (hash ^ (hash >> 15)) * 0x846ca68bu;
    hash ^= hash >> 16;
    return static_cast<float>(hash >> 8) * 0x1p-24f;
}

float valueNoise(float2 point, int2 period, uint32_t seed) {
    const float2 base = glm::floor(point);
    const int2 cell(base);
    const auto corner = [&](int x, int y) { return cellRandom(wrapped(cell + int2(x, y), period), seed); };
    const float tx = smooth(point.x - base.x), ty = smooth(point.y - base.y);
    const float top = glm::mix(corner(0, 0), corner(1, 0), tx), bottom = glm::mix(corner(0, 1), corner(1, 1), tx);
    return glm::mix(top, bottom, ty);
}

float fractalNoise(float2 point, int2 period, uint32_t octaves, uint32_t seed) {
    float sum = 0, weight = 1, total = 0;
    for (uint32_t octave = 0; octave < octaves; ++octave) {
        sum += weight * valueNoise(point, period, seed + octave);
        total += weight;
        weight *= 0.5f;
        point *= 2.0f;
        period *= 2;
    }
    return sum / total;
}

CellularSample cellularNoise(float2 point, int2 period, uint32_t seed) {
    const int2 cell(glm::floor(point));
    std::array<float2, 25> offsets; // from the point to the random points around it
    CellularSample result{ .distance = 1e9f };
    float2 nearest{ 0 };
    for (int i = 0; i < 25; ++i) {
        const int2 neighbour = cell + int2(i % 5 - 2, i / 5 - 2), key = wrapped(neighbour, period);
        offsets[i] = float2(neighbour) + float2(cellRandom(key, seed), cellRandom(key, seed + 1)) - point;
        const float distance = length(offsets[i]);
        if (distance < result.distance) {
            result = { .distance = distance, .random = cellRandom(key, seed + 2) };
            nearest = offsets[i];
        }
    }
    result.edgeDistance = 1e9f;
    for (float2 other : offsets) {
        if (other == nearest) continue;
        const float2 across = normalize(other - nearest);
        result.edgeDistance = std::min(result.edgeDistance, dot((nearest + other) * 0.5f, across));
    }
    return result;
}

} // namespace filament_core::showcase
