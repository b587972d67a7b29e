// SPDX-License-Identifier: Apache-2.0
/// Rooms of boxes, for tests of irradiance grids: outer walls, and walls with doors between them, of random thickness.
#pragma once

#include "tests/tools/reference/TestScenes.h"

#include <random>
#include <vector>

namespace filament_core::bake::test {

struct RoomBox {
    float3 center{ 0 }, half{ 1 };
};

/// Closed, seen from outside.
inline assets::PrimitiveData boxesPrimitive(std::vector<RoomBox> const& boxes) {
    std::vector<reference::TestVertex> vertices;
    std::vector<uint32_t> indices;
    for (RoomBox const& box : boxes) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const float side : { -1.0f, 1.0f }) {
                float3 normal(0.0f), u(0.0f), v(0.0f);
                normal[axis] = side;
                u[(axis + 1) % 3] = 1;
                v[(axis + 2) % 3] = 1;
                const auto first = static_cast<uint32_t>(vertices.size());
                for (const float2 corner : { float2(-1, -1), float2(1, -1), float2(1, 1), float2(-1, 1) })
                    vertices.push_back(
                            { box.center + box.half * (normal + u * corner.x + v * corner.y), normal, u, corner });
                for (const uint32_t i : { 0u, 1u, 2u, 0u, 2u, 3u })
                    indices.push_back(first + (side > 0 ? i : (4 - i) % 4));
            }
        }
    }
    return reference::makePrimitive(vertices, indices);
}

struct GridRoom {
    std::vector<RoomBox> boxes;
    float3 half{ 1 };
    float thinnest = 1;
};

inline GridRoom makeRoom(uint32_t seed) {
    std::mt19937 random(seed);
    const auto within = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random() >> 8) / 16777216.0f;
    };
    GridRoom room;
    room.half = float3(within(1.5f, 3), within(1.1f, 1.5f), within(1.5f, 3));
    const auto wall = [&] {
        const float half = within(0.03f, 0.15f);
        room.thinnest = std::min(room.thinnest, 2 * half);
        return half;
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : { -1.0f, 1.0f }) {
            RoomBox box{ .half = room.half + 0.3f };
            const float half = wall();
            box.half[axis] = half;
            box.center[axis] = side * (room.half[axis] + half);
            room.boxes.push_back(box);
        }
    }
    const auto walls = static_cast<uint32_t>(1 + random() % 3);
    for (uint32_t i = 0; i < walls; ++i) { // across x or z, with a door at one end
        const int axis = random() % 2 == 0 ? 0 : 2, along = 2 - axis;
        RoomBox box{ .half = room.half };
        box.half[axis] = wall();
        box.center[axis] = within(-0.6f, 0.6f) * room.half[axis];
        const float door = within(0.15f, 0.35f);
        box.half[along] = room.half[along] * (1 - door);
        box.center[along] = (random() % 2 == 0 ? 1.0f : -1.0f) * room.half[along] * door;
        room.boxes.push_back(box);
    }
    return room;
}

} // namespace filament_core::bake::test
