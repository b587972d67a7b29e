// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/ObjectData.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

constexpr size_t kRange = 1024;
// Placements lie in the order of the scene: fetch early what the order of drawing jumps to.
constexpr size_t kAhead = 12;

// Writes directly to the destination, a row at a time: a temporary object would be stored twice.
inline void write(shader::ObjectData& object, scene::Placement const& placement, double3 const& cameraWorld,
                  LevelFade fade = 0) {
    const float3 origin(placement.translation - cameraWorld);
    object.row0 = float4(placement.rows[0], origin.x);
    object.row1 = float4(placement.rows[1], origin.y);
    object.row2 = float4(placement.rows[2], origin.z);
    object.flags = float4(std::copysign(1.0f, placement.side), std::abs(placement.side) - 1.0f, fade, 0);
}

} // namespace

shader::ObjectData objectData(scene::Placement const& placement, double3 const& cameraWorld) {
    shader::ObjectData object;
    write(object, placement, cameraWorld);
    return object;
}

void writeObjects(jobs::JobSystem& jobs, ObjectList const& list, std::span<shader::ObjectData> objects) {
    FILAMENT_ASSERT(objects.size() == list.size(), "writeObjects: one place for each object of the list");
    const bool hasBones = !list.places.empty();
    jobs::parallelFor<"objects">(jobs, objects.size(), kRange, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            __builtin_prefetch(&list.placements[list.order[std::min(i + kAhead, end - 1)].renderable]);
            SortItem const& item = list.order[i];
            write(objects[i], list.placements[item.renderable], list.cameraWorld, fadeOf(item.draw));
            if (hasBones) objects[i].flags.w = list.poseBegin(item.renderable);
        }
    });
}

} // namespace filament_core::prepare
