// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/UpdateTransforms.h"

#include "filament_core/scene/SceneNodes.h"
#include "filament_core/scene/SceneSkins.h"

#include <span>

namespace filament_core::prepare {
namespace {

// A skin of 50 bones takes about 3 us.
constexpr size_t kSkinGrain = 4;

// A level with too little work for two threads stays on this thread; deep trees have thousands of such levels.
template <class Body>
void forRanges(jobs::JobSystem& jobs, size_t count, Body&& body) {
    if (count <= kTransformGrain) return body(0, count);
    jobs::parallelFor<"transforms">(jobs, count, kTransformGrain, body);
}

void placeAll(scene::SceneData& scene, std::span<const uint32_t> slots) {
    for (const uint32_t slot : slots) scene::placeAttached(scene, slot);
}

void updateNodes(jobs::JobSystem& jobs, scene::SceneData& scene) {
    scene::Transforms& transforms = scene.transforms;
    if (scene.deformations.hasSkins()) scene.deformations.beginMoving(transforms.slotLimit());
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

// Runs after the nodes, because bones follow joints. An unmoved skin costs a check of its joints, and only if anything
// moved at all.
void updateSkins(jobs::JobSystem& jobs, scene::SceneData& scene) {
    scene::Deformations& deformations = scene.deformations;
    if (!deformations.isMoving() && !deformations.hasStale()) return;
    const std::span<scene::SkinRecord> skins = deformations.skins();
    jobs::parallelFor<"skins">(jobs, skins.size(), kSkinGrain, [&](size_t begin, size_t end) {
        for (scene::SkinRecord& skin : skins.subspan(begin, end - begin)) {
            const bool moved = deformations.isMoving() && scene::hasMoved(scene, skin);
            if (skin.isStale || moved) scene::updateSkin(scene, skin);
        }
    });
    deformations.endMoving();
}

} // namespace

void updateTransforms(jobs::JobSystem& jobs, scene::SceneData& scene) {
    if (scene.transforms.isStale()) updateNodes(jobs, scene);
    if (scene.deformations.hasSkins()) updateSkins(jobs, scene);
}

} // namespace filament_core::prepare
