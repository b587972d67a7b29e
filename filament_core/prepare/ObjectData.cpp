// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/ObjectData.h"

#include <algorithm>

namespace filament::prepare {
namespace {

constexpr size_t kRange = 1024;
constexpr size_t kAhead =
        12; // placements lie in the order of the scene: fetch early what the order of drawing jumps to

} // namespace

shader::ObjectData objectData(scene::Placement const& placement, double3 const& cameraWorld) {
    const float3 origin(placement.translation - cameraWorld);
    return { float4(placement.rows[0], origin.x), float4(placement.rows[1], origin.y),
             float4(placement.rows[2], origin.z), float4(placement.side, 0, 0, 0) };
}

void writeObjects(jobs::JobSystem& jobs, ObjectList const& list, std::span<shader::ObjectData> objects) {
    FILAMENT_ASSERT(objects.size() == list.size(), "writeObjects: one place for each object of the list");
    jobs::parallelFor<"objects">(jobs, objects.size(), kRange, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            __builtin_prefetch(&list.placements[list.order[std::min(i + kAhead, end - 1)].renderable]);
            objects[i] = objectData(list.placements[list.order[i].renderable], list.cameraWorld);
        }
    });
}

} // namespace filament::prepare
