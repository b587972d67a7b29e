// SPDX-License-Identifier: Apache-2.0
// Objects that the app destroyed while in use, and their end.
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/SceneImpl.h"

#include <new>

namespace filament_core {
namespace engine {

void Uses::clear() {
    mObjects.clear();
    mBuffers.clear();
    mTextures.clear();
}

void Uses::add(scene::SceneData const& scene) {
    scene::Drawables const& drawables = scene.renderables.drawables;
    for (uint32_t i = 0; i < drawables.limit(); ++i) {
        if (drawables.use(i).users == 0) continue;
        mObjects.push_back(drawables[i].material);
        mBuffers.insert(mBuffers.end(), { drawables[i].geometry.vertices.bits, drawables[i].geometry.indices.bits });
    }
    for (scene::Deformation const& deformation : scene.deformations.all())
        if (deformation.renderable && deformation.morph) mObjects.push_back(deformation.morph);
    add(scene.indirectLight.specular);
    add(scene.indirectLight.irradiance);
    add(scene.skybox.cube);
    for (scene::ProbeRecord const& probe : scene.probes.records) add(probe.cube);
}

void Uses::add(scene::MaterialInstance const& instance) {
    for (scene::TextureBinding const& bound : instance.textures) add(bound.texture);
}

void Uses::sort() {
    std::ranges::sort(mObjects);
    std::ranges::sort(mBuffers);
    std::ranges::sort(mTextures);
}

namespace {

/// Of all users of textures except scenes.
void addUsesOfTextures(Engine::Impl& engine, Uses& uses) {
    engine.instances.forEachHeld([&](MaterialInstance, scene::MaterialInstance& instance) { uses.add(instance); });
    engine.indirectLights.forEach([&](IndirectLightState const& state) {
        uses.add(state.light.specular);
        uses.add(state.light.irradiance);
    });
    engine.skyboxes.forEach([&](SkyboxState const& state) { uses.add(state.cube); });
    engine.renderTargets.forEach([&](RenderTargetState const& state) {
        uses.add(engine.textures.held(state.color).handle);
        if (state.depth) uses.add(engine.textures.held(state.depth).handle);
        for (const Texture other : state.others) uses.add(engine.textures.held(other).handle);
    });
}

/// Users before what they use: an instance before its material, morph targets before their texture.
class Release {
public:
    Release(Engine::Impl& engine, backend::CommandBuffer& commands) : mEngine(engine), mCommands(commands) {}

    void run() {
        // Searched from the scenes now and then instead of counted at each change: scenes change each frame, and
        // objects end rarely.
        findUses();
        instances();
        materials();
        buffers(mEngine.vertexBuffers);
        buffers(mEngine.indexBuffers);
        morphTargets();
        textures();
    }

private:
    void findUses() {
        mEngine.uses.clear();
        for (Scene::Impl const* scene : mEngine.scenes) mEngine.uses.add(scene->data);
        mEngine.uses.sort();
    }

    void instances() {
        mEngine.instances.releaseRetired(
                [&](scene::MaterialInstance const& instance) { return mEngine.uses.hasObject(&instance); },
                [&](MaterialInstance handle, scene::MaterialInstance& instance) {
                    std::erase(mEngine.dirtyInstances, handle);
                    mEngine.destroyGroups(instance, mCommands);
                    if (instance.buffer) mEngine.stream->destroy(mCommands, instance.buffer);
                    --instance.material->instanceCount;
                });
    }

    void materials() {
        mEngine.materials.releaseRetired([](scene::Material const& material) { return material.instanceCount > 0; },
                                         [&](Material, scene::Material& material) {
                                             // The queue first: it would still make pipelines of the material.
                                             mEngine.compilations.forget(material);
                                             mEngine.pipelines.forget(mCommands, material);
                                             mEngine.materialNumbers.giveBack(material.id); // every cache forgot it
                                         });
    }

    template <class Table>
    void buffers(Table& table) {
        table.releaseRetired([&](auto const& state) { return mEngine.uses.has(state.handle); },
                             [&](auto, auto& state) {
                                 mEngine.stream->destroy(mCommands, state.handle);
                                 if constexpr (requires { state.streams; }) {
                                     for (const backend::BufferHandle stream : state.streams)
                                         if (stream) mEngine.stream->destroy(mCommands, stream);
                                 }
                             });
    }

    void morphTargets() {
        mEngine.morphTargets.releaseRetired(
                [&](MorphTargetsState const& state) { return mEngine.uses.hasObject(&state.targets); },
                [&](MorphTargets, MorphTargetsState& state) { mEngine.retire(mEngine.textures, state.texture); });
    }

    void textures() {
        if (!mEngine.textures.hasRetired()) return;
        // Only if a texture waits: this walks all instances. By now those that were released no longer count.
        addUsesOfTextures(mEngine, mEngine.uses);
        mEngine.morphTargets.forEachHeld(
                [&](MorphTargets, MorphTargetsState& state) { mEngine.uses.add(state.targets.deltas); });
        mEngine.uses.sort();
        mEngine.textures.releaseRetired([&](TextureState const& state) { return mEngine.uses.has(state.handle); },
                                        [&](Texture, TextureState& state) {
                                            if (state.handle) mEngine.stream->destroy(mCommands, state.handle);
                                        });
    }

    Engine::Impl& mEngine;
    backend::CommandBuffer& mCommands;
};

} // namespace
} // namespace engine

void Engine::destroy(EngineObject object) {
    const engine::PublicCall call(mImpl, "Engine::destroy(EngineObject)");
    std::visit([&](auto handle) { mImpl->destroy(handle); }, object);
}

void Engine::Impl::releaseRetired(backend::CommandBuffer& commands) {
    if (!aUseEnded) return;
    const bool hasRetired = instances.hasRetired() || materials.hasRetired() || vertexBuffers.hasRetired() ||
                            indexBuffers.hasRetired() || morphTargets.hasRetired() || textures.hasRetired();
    try {
        if (hasRetired) engine::Release(*this, commands).run();
        // Only after the whole run: what memory did not suffice for is tried again in the next frame.
        aUseEnded = false;
    } catch (std::bad_alloc const&) { // what is left waits for the next frame
    }
}

} // namespace filament_core
