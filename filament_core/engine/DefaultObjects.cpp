// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/DefaultObjects.h"

#include "filament_core/assets/DfgTable.h"
#include "shaders/interface/ShaderInterface.h"

#include <array>
#include <numeric>

namespace filament {
namespace {

using namespace backend;

BufferHandle createInstanceIds(Engine::Impl& engine) {
    std::array<uint32_t, shader::kObjectsPerWindow> ids{};
    std::iota(ids.begin(), ids.end(), 0u);
    const BufferHandle handle = engine.stream->allocateBuffer();
    engine.pending.record(CmdCreateBuffer{ handle, { sizeof(ids), BufferUsage::Vertex, "instance ids" } });
    engine.pending.record(CmdUpdateBuffer{ handle, 0, std::as_bytes(std::span(ids)) });
    return handle;
}

Texture createDfg(Engine::Impl& engine) {
    static const assets::Image table = assets::bakeDfgTable(engine.jobs); // the same for every engine of the process
    return engine.createTexture({ .format = table.format,
                                  .width = table.width,
                                  .height = table.height,
                                  .pixels = table.data,
                                  .name = "dfg" });
}

} // namespace

void createDefaultObjects(Engine::Impl& engine) {
    constexpr std::array<uint8_t, 4> white{ 255, 255, 255, 255 };
    constexpr std::array<uint8_t, 24> black{};
    engine.defaults.white = engine.createTexture({ .pixels = std::as_bytes(std::span(white)), .name = "white" });
    engine.defaults.blackCube = engine.createTexture({ .kind = TextureKind::Cube,
                                                       .layers = 6,
                                                       .pixels = std::as_bytes(std::span(black)),
                                                       .name = "black cube" });
    engine.defaults.dfg = createDfg(engine);
    engine.defaults.instanceIds = createInstanceIds(engine);
}

void destroyDefaultObjects(Engine::Impl& engine) {
    for (Texture texture : { engine.defaults.white, engine.defaults.blackCube, engine.defaults.dfg }) {
        const TextureHandle handle = engine.textureHandle(texture);
        engine.pending.record(CmdDestroyTexture{ handle });
        engine.stream->free(handle);
        engine.textures.remove(texture);
    }
    engine.pending.record(CmdDestroyBuffer{ engine.defaults.instanceIds });
    engine.stream->free(engine.defaults.instanceIds);
    for (auto const& [key, material] : engine.engineMaterials) {
        engine.pipelines.forget(engine.pending, engine.materials.get(material));
        engine.materials.remove(material);
    }
    engine.engineMaterials.clear();
}

} // namespace filament
