// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/UpdateTransforms.h"

#include "filament_core/scene/SceneNodes.h"

#include <span>

namespace filament::prepare {
namespace {

// A level without enough work for two threads stays on this one; deep trees have thousands of them.
template <class Body>
void forRanges(jobs::JobSystem& jobs, size_t count, Body&& body) {
    if (count <= kTransformGrain) return body(0, count);
    jobs::parallelFor<"transforms">(jobs, count, kTransformGrain, body);
}

void placeAll(scene::SceneData& scene, std::span<const uint32_t> slots) {
    for (const uint32_t slot : slots) scene::placeAttached(scene, slot);
}

} // namespace

void updateTransforms(jobs::JobSystem& jobs, scene::SceneData& scene) {
    scene::Transforms& transforms = scene.transforms;
    if (!transforms.isStale()) return;
    transforms.beginUpdate();
    while (transforms.nextLevel()) {
        forRanges(jobs, transforms.levelSize(), [&](size_t begin, size_t end) {
            placeAll(scene, transforms.recompute(static_cast<uint32_t>(begin), static_cast<uint32_t>(end)));
        });
    }
    const std::span<const uint32_t> unplaced = transforms.takeUnplaced();
    forRanges(jobs, unplaced.size(),
              [&](size_t begin, size_t end) { placeAll(scene, unplaced.subspan(begin, end - begin)); });
}

} // namespace filament::prepare
