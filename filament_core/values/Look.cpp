// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Look.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace filament_core {
namespace {

/// Between which entries a value lies, and where between them.
struct Place {
    size_t index = 0; ///< of the lower one
    float fraction = 0;
};

Place placeOf(float value, float least, float most, uint32_t size) {
    const float last = static_cast<float>(size - 1);
    const float at = (value - least) / (most - least) * last;
    if (!(at > 0)) return {}; // NaN too
    const float inside = std::min(at, last);
    const size_t index = std::min(static_cast<size_t>(inside), size_t{ size } - 2);
    return { index, inside - static_cast<float>(index) };
}

/// From the corner along the axes, the largest fraction first: Sakamoto and Itooka, US patent 4 275 413 (1978).
float3 inCube(Look const& look, std::array<Place, 3> const& places) {
    std::array<size_t, 3> order{ 0, 1, 2 };
    std::ranges::stable_sort(order, [&](size_t a, size_t b) { return places[a].fraction > places[b].fraction; });
    const std::array<size_t, 3> steps{ 1, look.size, size_t{ look.size } * look.size };
    size_t at = places[0].index + places[1].index * steps[1] + places[2].index * steps[2];
    float3 color = look.entries[at];
    for (const size_t axis : order) {
        const float3 before = look.entries[at];
        at += steps[axis];
        color += (look.entries[at] - before) * places[axis].fraction;
    }
    return color;
}

float3 inCurve(std::vector<float3> const& entries, float3 least, float3 most, float3 color) {
    float3 result;
    for (int c = 0; c < 3; ++c) {
        const auto [index, fraction] = placeOf(color[c], least[c], most[c], static_cast<uint32_t>(entries.size()));
        const float low = entries[index][c], high = entries[index + 1][c];
        result[c] = low + (high - low) * fraction;
    }
    return result;
}

} // namespace

float3 lookedUp(Look const& look, float3 color) {
    if (!look.isCube) return inCurve(look.entries, look.domainMin, look.domainMax, color);
    if (!look.shaper.empty()) color = inCurve(look.shaper, look.shaperMin, look.shaperMax, color);
    std::array<Place, 3> places;
    for (int c = 0; c < 3; ++c)
        places[static_cast<size_t>(c)] = placeOf(color[c], look.domainMin[c], look.domainMax[c], look.size);
    return inCube(look, places);
}

} // namespace filament_core
