// SPDX-License-Identifier: Apache-2.0
/// Engine::Impl: the rooms of one engine, wired together, and the tables behind the public handles.
///   Thread  the app thread.
///   Stream  creations are recorded into `pending` and travel with the next frame or the next flush(): nothing waits.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/engine/ObjectTable.h"
#include "filament_core/engine/SamplerCache.h"
#include "filament_core/passes/Pipelines.h"
#include "filament_core/scene/SceneData.h"
#include "jobsystem/Affinity.h"
#include "jobsystem/JobSystem.h"

#include <filament/Engine.h>
#include <filament/Quality.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace filament {
namespace engine {

struct TextureState {
    backend::TextureHandle handle;
    backend::TextureDesc desc{}; ///< debugName is empty: see `name`
    std::string name;
};

struct VertexBufferState {
    backend::BufferHandle handle;
    backend::VertexLayout layout{};
    uint32_t vertexCount = 0;
    std::string name;
};

struct IndexBufferState {
    backend::BufferHandle handle;
    backend::IndexType type = backend::IndexType::UInt16;
    uint32_t indexCount = 0;
    std::string name;
};

struct IndirectLightState {
    scene::IndirectLightState light{};
    std::string name;
};

struct SkyboxState {
    backend::TextureHandle cube;
    std::string name;
};

struct RenderTargetState {
    Texture color;
    std::string name;
};

struct SwapChainState {
    std::vector<Texture> images;
    uint32_t current = 0; ///< the one rendered last
    uint2 size{};
    std::string name;
};

/// Objects that every engine has.
struct Defaults {
    Texture white;                     ///< 1x1 opaque white, for textures that a material leaves unset
    Texture blackCube;                 ///< 1x1, for scenes without an environment
    std::map<uint32_t, Texture> dfg;   ///< split-sum tables by their size
    backend::BufferHandle instanceIds; ///< 0, 1, 2, ... kObjectsPerWindow - 1
};

} // namespace engine

struct Engine::Impl {
    Impl(EngineOptions engineOptions, std::unique_ptr<backend::CommandStream> commandStream);
    ~Impl();
    Impl(Impl const&) = delete;
    Impl& operator=(Impl const&) = delete;

    /// Hands everything pending to the driver thread.
    void flush();
    /// Moves everything pending, dirty parameters included, in front of a frame.
    void drainPending(backend::CommandBuffer& commands);
    void collectErrors();
    double secondsSinceStart(int64_t steadyNanoseconds) const;

    Texture createTexture(TextureDesc const& desc);
    /// The split-sum table of a size in [16, 256]; baked when first asked for, then kept.
    Texture dfgTable(uint32_t size);
    Result<Material> createMaterial(MaterialDesc const& desc);
    /// A post-process or sky material of the engine with an int and a bool constant, made once.
    Material engineMaterial(std::string_view package, std::vector<MaterialConstant> constants);
    void useTextureFilter(TextureFilter filter);
    void updateInstance(scene::MaterialInstance& instance, backend::CommandBuffer& commands);
    void markDirty(MaterialInstance instance);
    backend::TextureHandle textureHandle(Texture texture) const { return textures.get(texture).handle; }

    Engine* self = nullptr; ///< follows moves of the Engine
    EngineOptions options;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::unique_ptr<backend::CommandStream> stream;
    jobs::CorePins driverPin; ///< before `jobs`, so that no worker is pinned there
    jobs::JobSystem jobs;
    DeviceDescription device;
    backend::CommandBuffer pending;
    std::vector<std::string> errors;

    scene::GeometryLayouts layouts;
    passes::PipelineCache pipelines;
    engine::SamplerCache samplers;

    engine::ObjectTable<TextureObject, engine::TextureState> textures;
    engine::ObjectTable<VertexBufferObject, engine::VertexBufferState> vertexBuffers;
    engine::ObjectTable<IndexBufferObject, engine::IndexBufferState> indexBuffers;
    engine::ObjectTable<MaterialObject, scene::Material> materials;
    engine::ObjectTable<MaterialInstanceObject, scene::MaterialInstance> instances;
    engine::ObjectTable<IndirectLightObject, engine::IndirectLightState> indirectLights;
    engine::ObjectTable<SkyboxObject, engine::SkyboxState> skyboxes;
    engine::ObjectTable<RenderTargetObject, engine::RenderTargetState> renderTargets;
    engine::ObjectTable<SwapChainObject, engine::SwapChainState> swapChains;

    engine::Defaults defaults;
    std::map<std::string, Material> engineMaterials; ///< by package and constants
    std::vector<MaterialInstance> dirtyInstances;
    TextureFilter textureFilter = TextureFilter::AsAuthored; ///< of the frame recorded last
    uint32_t nextMaterialId = 0, nextInstanceId = 0;
};

} // namespace filament
