// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/NumberObjects.h"

#include "filament_core/prepare/ObjectData.h"

#include <algorithm>

namespace filament_core::prepare {
namespace {

scene::MaterialInstance const* instanceAt(scene::Renderables const& renderables, uint32_t at) {
    return renderables.drawables[renderables.drawable[at]].material;
}

/// Of objects, or of what they are drawn with.
class SceneNumbers {
public:
    SceneNumbers(scene::Renderables const& renderables, DebugView view) : mRenderables(renderables), mView(view) {
        if (view == DebugView::MaterialInstanceIds) mInstances = instancesOf(renderables);
        if (view == DebugView::MaterialIds) mMaterials = materialsOf(renderables);
    }

    /// Of the renderable at a position in the scene.
    float at(uint32_t position) const {
        uint32_t before = mRenderables.index.handleAt(position).index();
        scene::MaterialInstance const* const instance = instanceAt(mRenderables, position);
        if (mView == DebugView::MaterialInstanceIds) {
            const auto found = std::ranges::lower_bound(mInstances, instance->id, {}, &scene::MaterialInstance::id);
            before = static_cast<uint32_t>(found - mInstances.begin());
        }
        if (mView == DebugView::MaterialIds)
            before = static_cast<uint32_t>(std::ranges::find(mMaterials, instance->material) - mMaterials.begin());
        return static_cast<float>(before + 1);
    }

private:
    scene::Renderables const& mRenderables;
    DebugView mView;
    std::vector<scene::MaterialInstance const*> mInstances;
    std::vector<scene::Material const*> mMaterials;
};

/// Objects follow in the order of the draws.
std::span<const DrawCall> numbered(Arena& arena, std::span<const DrawCall> draws, uint32_t& objects) {
    const std::span<DrawCall> copies = arena.copy(draws);
    for (DrawCall& draw : copies) {
        draw.firstField = objects;
        objects += draw.instanceCount;
    }
    return copies;
}

} // namespace

std::optional<uint32_t> positionOf(scene::Renderables const& renderables, uint32_t object) {
    for (uint32_t at = 0; at < renderables.count(); ++at)
        if (renderables.index.handleAt(at).index() + 1 == object) return at;
    return std::nullopt;
}

std::vector<scene::MaterialInstance const*> instancesOf(scene::Renderables const& renderables) {
    std::vector<scene::MaterialInstance const*> instances;
    instances.reserve(renderables.count());
    for (uint32_t at = 0; at < renderables.count(); ++at) instances.push_back(instanceAt(renderables, at));
    std::ranges::sort(instances, {}, &scene::MaterialInstance::id);
    const auto last = std::unique(instances.begin(), instances.end());
    instances.erase(last, instances.end());
    return instances;
}

std::vector<scene::Material const*> materialsOf(scene::Renderables const& renderables) {
    std::vector<scene::Material const*> materials;
    for (scene::MaterialInstance const* instance : instancesOf(renderables)) {
        if (std::ranges::find(materials, instance->material) == materials.end())
            materials.push_back(instance->material);
    }
    return materials;
}

void numberObjects(Arena& arena, scene::SceneData const& scene, FramePacket& packet) {
    const std::span<ViewPacket> views = arena.copy(packet.views);
    ViewPacket& main = views[0];
    uint32_t objects = 0;
    main.opaque = numbered(arena, main.opaque, objects);
    main.blended = numbered(arena, main.blended, objects);
    packet.views = views;
    const SceneNumbers numbers(scene.renderables, packet.settings.debugView);
    const auto records = arena.array<shader::IrradianceField>(objects);
    for (const std::span<const DrawCall> draws : { main.opaque, main.blended }) {
        for (DrawCall const& draw : draws) {
            for (uint32_t nth = 0; nth < draw.instanceCount; ++nth) {
                const uint32_t at = main.objects.order[draw.firstObject + nth].renderable;
                shader::IrradianceField& record = records[draw.firstField + nth];
                record.object = objectData(scene.renderables.placement[at], main.objects.cameraWorld);
                record.object.flags.w = main.objects.poseBegin(at);
                record.center.w = numbers.at(at);
            }
        }
    }
    packet.numbered = records;
}

} // namespace filament_core::prepare
