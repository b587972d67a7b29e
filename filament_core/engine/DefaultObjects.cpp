// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/DefaultObjects.h"

#include "backend/stream/RecordingGuards.h"
#include "base/Assert.h"
#include "base/Result.h"
#include "filament_core/assets/tables/DfgTable.h"
#include "filament_core/assets/tables/ToneTable.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/materials/TextureParameters.h"
#include "filament_core/passes/DrawRecorder.h"
#include "shaders/interface/ShaderInterface.h"

#include <array>
#include <map>
#include <mutex>
#include <numeric>

namespace filament_core {
namespace {

using namespace backend;

BufferHandle createInstanceIds(Engine::Impl& engine) {
    std::array<uint32_t, passes::kFirstPairId + shader::kObjectsPerWindow / 2> ids{};
    std::iota(ids.begin(), ids.begin() + passes::kFirstPairId, 0u);
    for (uint32_t pair = 0; pair < shader::kObjectsPerWindow / 2; ++pair) ids[passes::kFirstPairId + pair] = 2 * pair;
    NewHandle handle(*engine.stream, engine.stream->allocateBuffer());
    AllOrNothing both(engine.pending);
    engine.pending.record(CmdCreateBuffer{ handle, { sizeof(ids), BufferUsage::Vertex, "instance ids" } });
    engine.pending.record(CmdUpdateBuffer{ handle, 0, std::as_bytes(std::span(ids)) });
    both.complete();
    return handle.keep();
}

BufferHandle createNoFogCells(Engine::Impl& engine) {
    NewHandle handle(*engine.stream, engine.stream->allocateBuffer());
    engine.pending.record(CmdCreateBuffer{ handle, { sizeof(float4), BufferUsage::Storage, "no fog cells" } });
    return handle.keep();
}

// Shared by all engines of the process.
assets::Image const& bakedDfg(Engine::Impl& engine, uint32_t size) {
    static std::mutex mutex; // engines may live on several threads
    static std::map<uint32_t, assets::Image> tables;
    const std::lock_guard lock(mutex);
    const auto found = tables.find(size);
    return found != tables.end() ? found->second
                                 : tables.emplace(size, assets::bakeDfgTable(engine.jobs, size)).first->second;
}

Texture createDfg(Engine::Impl& engine, uint32_t size) {
    assets::Image const& table = bakedDfg(engine, size);
    return engine.createTexture({ .format = table.format,
                                  .width = table.width,
                                  .height = table.height,
                                  .pixels = table.data,
                                  .name = fmt::format("dfg {}", size) });
}

/// One of few: without numbers of its user.
bool isPlain(engine::ToneTable const& table) {
    return !table.key.grading && table.key.display == DisplayTransform{ .toneMapper = table.key.display.toneMapper,
                                                                        .agxLook = table.key.display.agxLook };
}

} // namespace

Texture Engine::Impl::dfgTable(uint32_t size) {
    FILAMENT_ASSERT(size >= 16 && size <= 256, "Quality::dfgTableSize is a number from 16 to 256");
    Texture& table = defaults.dfg[size];
    // Made at the first use: most apps use one size.
    if (!table) table = createDfg(*this, size);
    return table;
}

Texture Engine::Impl::unsetTexture(shader::Parameter const& parameter) {
    using enum ParameterType;
    using shader::SamplerFormat;
    Texture& texture = defaults.standIns[{ parameter.type, parameter.format }];
    if (texture) return texture;
    const bool isFloat = parameter.format == SamplerFormat::Float;
    std::array<uint8_t, 4 * 6> texels;
    texels.fill(isFloat ? 255 : 1);
    const TextureKind kind = engine::textureKindOf(parameter.type);
    const uint32_t layers = kind == TextureKind::Cube || kind == TextureKind::CubeArray ? 6 : 1;
    texture = createTexture({ .kind = kind,
                              .format = isFloat                                  ? Format::RGBA8
                                        : parameter.format == SamplerFormat::Int ? Format::RGBA8I
                                                                                 : Format::RGBA8UI,
                              .layers = layers,
                              .pixels = std::as_bytes(std::span(texels)).first(4 * layers),
                              .name = "white" });
    return texture;
}

Texture Engine::Impl::toneTable(engine::ToneTableKey const& key) {
    constexpr std::ptrdiff_t kMostOfUsers = 4;
    std::vector<engine::ToneTable>& tables = defaults.toneTables;
    const auto known = std::ranges::find(tables, key, &engine::ToneTable::key);
    if (known != tables.end()) return known->texture;
    const auto isOfUser = [](engine::ToneTable const& table) { return !isPlain(table); };
    if (isOfUser({ .key = key, .texture = {} }) && std::ranges::count_if(tables, isOfUser) == kMostOfUsers) {
        const auto oldest = std::ranges::find_if(tables, isOfUser);
        destroy(oldest->texture);
        tables.erase(oldest);
    }
    const assets::Image colors =
            assets::bakeToneTable(jobs, key.display, key.size, key.grading ? &*key.grading : nullptr);
    tables.push_back({ .key = key, .texture = {} }); // found again only with its texture
    try {
        tables.back().texture =
                createTexture({ .format = colors.format,
                                .width = colors.width,
                                .height = colors.height,
                                .pixels = colors.data,
                                .name = fmt::format("tone table {} {}", toString(key.display.toneMapper), key.size) });
    } catch (std::bad_alloc const&) {
        tables.pop_back();
        throw;
    }
    return tables.back().texture;
}

void createDefaultObjects(Engine::Impl& engine) {
    constexpr std::array<uint8_t, 24> black{};
    engine.defaults.blackCube = engine.createTexture({ .kind = TextureKind::Cube,
                                                       .layers = 6,
                                                       .pixels = std::as_bytes(std::span(black)),
                                                       .name = "black cube" });
    engine.dfgTable(Quality{}.dfgTableSize);
    engine.defaults.instanceIds = createInstanceIds(engine);
    engine.defaults.noFogCells = createNoFogCells(engine);
}

void destroyDefaultObjects(Engine::Impl& engine) {
    for (auto const& [which, texture] : engine.defaults.standIns) {
        if (texture) engine.destroy(texture);
    }
    engine.destroy(engine.defaults.blackCube);
    for (auto const& [size, table] : engine.defaults.dfg) {
        if (table) engine.destroy(table); // null: there was no memory for it
    }
    for (engine::ToneTable const& table : engine.defaults.toneTables) engine.destroy(table.texture);
    engine.stream->destroy(engine.pending, engine.defaults.instanceIds);
    engine.stream->destroy(engine.pending, engine.defaults.noFogCells);
    engine.dispatches.destroy(engine.pending);
    if (engine.drawingMotion) engine.destroy(std::exchange(engine.drawingMotion, {}));
    if (engine.drawingSplats) engine.destroy(std::exchange(engine.drawingSplats, {}));
    for (Scene::Impl const* scene : engine.scenes) engine::destroyLightShapes(engine, scene->data);
    engine.destroy(std::exchange(engine.lightShapeVertices, {}));
    engine.destroy(std::exchange(engine.lightShapeIndices, {}));
    for (MaterialInstance& instance : engine.fadingLevels)
        if (instance) engine.destroy(std::exchange(instance, {}));
    for (MaterialInstance& instance : engine.drawingDebug)
        if (instance) engine.destroy(std::exchange(instance, {}));
    for (auto const& [key, material] : engine.engineMaterials) engine.retire(engine.materials, material);
    engine.engineMaterials.clear();
}

} // namespace filament_core
