// SPDX-License-Identifier: Apache-2.0
/// Engine::Impl: the rooms of one engine, connected, and the tables behind the public handles.
///   Thread  the app thread.
///   Fails   create...() and set() throw std::bad_alloc and change nothing; Engine's functions of the same names turn
///           this into an error. Functions that end or destroy something never fail.
///   Stream  creations are recorded into `pending` and travel with the next frame or the next flush(): nothing waits.
#pragma once

#include "backend/api/WindowGate.h"
#include "backend/stream/CommandStream.h"
#include "filament_core/engine/HandleTable.h"
#include "filament_core/engine/LoadTask.h"
#include "filament_core/engine/PublicCall.h"
#include "filament_core/engine/SamplerCache.h"
#include "filament_core/engine/Uses.h"
#include "filament_core/engine/materials/CompileQueue.h"
#include "filament_core/engine/materials/MaterialNumbers.h"
#include "filament_core/passes/DispatchCache.h"
#include "filament_core/passes/PipelineCache.h"
#include "filament_core/scene/SceneData.h"
#include "jobsystem/Affinity.h"
#include "jobsystem/JobSystem.h"

#include <filament_core/Engine.h>
#include <filament_core/Quality.h>
#include <filament_core/Scene.h>
#include <filament_core/View.h>

#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace filament_core::assets {
struct IesFile;
}
namespace filament_core::passes {
struct FullScreenInterface;
}

namespace filament_core {
namespace engine {

class TextureStreamer; // TextureStreamer.h

struct TextureState {
    backend::TextureHandle handle;     ///< none: rejected, see createTexture()
    backend::DeviceTextureDesc desc{}; ///< debugName is empty: see `name`
    std::string name;
    bool hasContents = false; ///< something was uploaded or drawn
};

struct VertexBufferState {
    backend::BufferHandle handle; ///< of stream 0
    scene::VertexStreams streams; ///< the others
    backend::VertexLayout layout{};
    uint32_t vertexCount = 0;
    scene::MinMax bounds;       ///< around all positions that it had since all of it was given; empty: it has none
    uint64_t boundsVersion = 0; ///< grows when they change
    std::string name;
};

struct IndexBufferState {
    backend::BufferHandle handle;
    IndexFormat format = IndexFormat::UInt16;
    uint32_t indexCount = 0;
    std::string name;
};

struct MorphTargetsState {
    Texture texture; ///< none: too large for the device
    scene::MorphTargets targets{};
    std::string name;
};

struct IndirectLightState {
    scene::IndirectLightRecord light{};
    std::string name;
};

struct SkyboxState {
    backend::TextureHandle cube;
    bool isRgbm = false;
    float3x3 worldFromCube{ 1.0f };
    std::string name;
};

struct LightProfileState {
    std::shared_ptr<const std::vector<uint32_t>> words; ///< see shader::kProfileHeaderWords; lights share them
    LightProfileDescription description{};
    std::string name;
};

struct LightImageState {
    std::shared_ptr<const std::vector<uint32_t>> words; ///< see shader::kImageHeaderWords; lights share them
    float aspect = 1;                                   ///< height over width
    LightImageDescription description{};
    std::string name;
};

struct RenderTargetState {
    Texture color, depth; ///< depth: optional. The app may have destroyed them: HandleTable::held()
    bool generateMips = false;
    uint8_t level = 0;
    uint16_t layer = 0;
    std::vector<Texture> others;
    bool hasContents = false; ///< the level and layer
    std::string name;
};

struct SwapChainState {
    std::vector<Texture> images;
    uint32_t current = 0; ///< the one rendered last
    uint2 size{};
    Format format = Format::RGBA8;
    backend::SurfaceHandle surface{};          ///< of its window; none: headless
    std::array<uint64_t, 2> presents{};        ///< the submissions of the last ones, the older one first
    std::shared_ptr<backend::WindowGate> gate; ///< of the surface
    uint64_t submitted = 0;                    ///< presents
    bool isAsleep = false;                     ///< the window took no image for long: nothing waits for it

    /// Whether a present would wait neither for the driver thread nor for the window.
    bool takesImage() const { return !gate || gate->allowed.load(std::memory_order_acquire) > submitted; }
    std::string name;
};

/// Input of a table of colours: a tone mapper with its options, and the grading before it.
struct ToneTableKey {
    DisplayTransform display{}; ///< without fields that change no entry
    uint32_t size = 0;
    std::optional<ColorGrading> grading{};
    friend bool operator==(ToneTableKey const&, ToneTableKey const&) = default;
};

struct ToneTable {
    ToneTableKey key;
    Texture texture;
};

/// Of bytes that travel to the device without a copy: shared until the driver thread has taken them. None: the bytes
/// are the caller's, and are copied.
using BytesOwner = std::shared_ptr<const void>;

/// Something with device objects of its own that may outlive the engine.
class Dependent {
public:
    virtual void release() noexcept = 0; ///< destroys them; once, while the engine lives

protected:
    ~Dependent() = default;
};

/// Objects of every engine.
struct Defaults {
    Texture blackCube; ///< 1x1, for scenes without an environment
    /// 1x1, see unsetTexture().
    std::map<std::pair<ParameterType, shader::SamplerFormat>, Texture> standIns;
    std::map<uint32_t, Texture> dfg; ///< split-sum tables by their size
    std::vector<ToneTable> toneTables;
    backend::BufferHandle instanceIds; ///< see passes::kFirstPairId
    backend::BufferHandle noFogCells;  ///< FrameResources::noFogCells
};

} // namespace engine

struct Engine::Impl {
    Impl(EngineOptions engineOptions, std::unique_ptr<backend::CommandStream> commandStream);
    ~Impl();
    Impl(Impl const&) = delete;
    Impl& operator=(Impl const&) = delete;

    /// Before the end of the engine is visible: loads and renderers release their device objects.
    void endDependents() noexcept;
    /// Sends everything pending to the driver thread.
    void flush();
    /// Records everything pending, including changed parameters, before a frame.
    void drainPending(backend::CommandBuffer& commands);
    /// The next slice of the requests to compile(), after a frame or when there is none. Never waits.
    void recordCompilations(backend::CommandBuffer& commands);
    void advanceCompilation();
    void collectErrors();
    /// Adds a line to takeErrors(), if there is memory for it.
    void report(std::string_view line) noexcept;
    void reportOutOfMemory(std::string_view doing, std::string_view object = {},
                           std::bad_alloc const& cause = {}) noexcept;
    /// Frees unused objects that the app destroyed, if a use ended since the last call.
    void releaseRetired(backend::CommandBuffer& commands);
    /// Returns what `make` returns; none, and a line for takeErrors(), if memory runs out.
    template <class F>
    void orReport(std::string_view doing, std::string_view object, F&& run);
    template <class F>
    auto orNone(std::string_view doing, std::string_view object, F&& make) -> std::invoke_result_t<F&>;
    double secondsSinceStart(int64_t steadyNanoseconds) const;

    /// `holder`: of the bytes of the description.
    Texture createTexture(TextureDesc const& desc, engine::BytesOwner const& holder = {});
    /// `bounds`: what scene::boundsOf() says of the vertices, if the caller knows it.
    VertexBuffer createVertexBuffer(VertexBufferDesc const& desc, engine::BytesOwner const& holder = {},
                                    std::optional<scene::MinMax> const& bounds = {});
    IndexBuffer createIndexBuffer(IndexBufferDesc const& desc, engine::BytesOwner const& holder = {});
    MorphTargets createMorphTargets(MorphTargetsDesc const& desc);
    SwapChain createSwapChain(SwapChainDesc const& desc);
    Result<std::vector<OutputSpace>> outputSpaces(NativeWindow window);
    void resize(engine::SwapChainState& state, uint2 size);
    void present(engine::SwapChainState& state);
    void updateBuffer(backend::BufferHandle buffer, uint64_t offset, std::span<const std::byte> data);
    void update(engine::VertexBufferState& state, std::span<const std::byte> data, uint32_t firstVertex, uint32_t part);
    void update(engine::IndexBufferState const& state, std::span<const std::byte> data, uint32_t firstIndex);
    void update(engine::TextureState& state, TextureUpdate const& update);
    LightProfile createLightProfile(assets::IesFile const& file, std::string name);
    MaterialInstance createInstance(Material material, std::string name);
    Result<void> set(MaterialInstance instance, ParameterKey const& parameter, ParameterValue const& value);
    Result<void> set(MaterialInstance instance, ParameterKey const& parameter, ParameterArray const& values,
                     uint32_t first);
    Result<void> set(MaterialInstance instance, ParameterKey const& parameter, Texture texture, Sampler sampler);
    /// Invalidates the handle. Null: no effect.
    template <class Tag, class State>
    void retire(engine::HandleTable<Tag, State>& table, ObjectHandle<Tag> handle);
    /// Likewise for objects that scenes copy.
    template <class Tag, class State>
    void removeNow(engine::HandleTable<Tag, State>& table, ObjectHandle<Tag> handle);
    void destroy(Texture texture) { retire(textures, texture); }
    void destroy(VertexBuffer buffer) { retire(vertexBuffers, buffer); }
    void destroy(IndexBuffer buffer) { retire(indexBuffers, buffer); }
    void destroy(MorphTargets targets) { retire(morphTargets, targets); }
    void destroy(Material material) { retire(materials, material); }
    void destroy(MaterialInstance instance) { retire(instances, instance); }
    void destroy(IndirectLight light) { removeNow(indirectLights, light); }
    void destroy(Skybox skybox) { removeNow(skyboxes, skybox); }
    void destroy(LightProfile profile) { removeNow(lightProfiles, profile); }
    void destroy(LightImage image) { removeNow(lightImages, image); }
    void destroy(RenderTarget target) { removeNow(renderTargets, target); }
    void destroy(SwapChain swapChain);
    /// The split-sum table of a size in [16, 256]; baked at its first use and kept.
    Texture dfgTable(uint32_t size);
    /// The colours of a tone mapper as a table (ToneTable.h); baked at its first use and kept. Of tables with a
    /// grading, a look or other numbers the last ones are kept.
    Texture toneTable(engine::ToneTableKey const& key);
    Result<Compilation> compile(Material material, CompileDesc const& desc);
    Result<Material> createMaterial(MaterialDesc const& desc);
    /// Its second half: gives the result of loadMaterial() a handle, if this device can draw it.
    Result<Material> addMaterial(scene::Material loaded);
    void removeMaterial(Material material) noexcept;
    /// The package of an engine material, exact or plain as EngineOptions::exactShaders says.
    std::span<const std::byte> enginePackage(std::string_view name) const { return enginePackages()(name); }
    /// The same for threads that may outlive the engine.
    std::function<std::span<const std::byte>(std::string_view)> enginePackages() const;
    /// A post-process or sky material of the engine with an int and a bool constant, made once.
    Material engineMaterial(std::string_view package, std::vector<MaterialConstant> constants);
    /// Of the material `motion`, created once: for objects whose materials have no motion variant.
    scene::MaterialInstance const* motionInstance();
    /// Of the material `level_fade`, created once: of front faces and of both.
    scene::MaterialInstance const* levelFadeInstance(bool hasBothSides);
    /// Of the material `debug_draw`, created once: with and without depth test.
    scene::MaterialInstance const* debugDrawInstance(bool isTested);
    /// Of the material `splats`, created once.
    MaterialInstance splatInstance();
    /// engineMaterial() for a full-screen pass; asserts that they fit.
    scene::Material const& fullScreenMaterial(std::string_view package, std::vector<MaterialConstant> constants,
                                              passes::FullScreenInterface const& given);
    /// From the next drainPending() on every instance has a bind group for views of this filter, too. Views of several
    /// filters take turns at no cost; a filter that was used once keeps its groups.
    void useTextureFilter(TextureFilter filter);
    void updateInstance(scene::MaterialInstance& instance, backend::CommandBuffer& commands);
    void makeGroups(scene::MaterialInstance& instance, backend::CommandBuffer& commands);
    backend::BindGroupHandle makeGroup(scene::MaterialInstance const& instance, TextureFilter filter,
                                       backend::CommandBuffer& commands);
    void destroyGroups(scene::MaterialInstance& instance, backend::CommandBuffer& commands);
    void markDirty(MaterialInstance instance);
    template <class Write>
    void changeRaster(MaterialInstance instance, Write&& write);
    template <class Write>
    Result<void> change(MaterialInstance instance, ParameterKey const& parameter, Write&& write);
    /// The texture of a sampler that the app has not set: opaque white (integers: 1), of the sampler's kind. Created at
    /// its first use.
    Texture unsetTexture(shader::Parameter const& sampler);
    /// Made at its first use.
    engine::TextureStreamer& streamerOf();
    /// None: the texture is larger than the device allows.
    backend::TextureHandle textureHandle(Texture texture) const { return textures.get(texture).handle; }

    Engine* self = nullptr; ///< follows moves of the Engine
    uint16_t owner = scene::ownerTag(scene::newOwnerSerial());
    const void* appThread = engine::thisThread();
    EngineOptions options;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::unique_ptr<backend::CommandStream> stream;
    jobs::CorePins driverPin; ///< before `jobs`, so that no worker is pinned to its core
    jobs::JobSystem jobs;
    DeviceDescription device;
    backend::CommandBuffer pending;
    std::vector<std::string> errors;
    uint32_t untoldErrors = 0; ///< errors whose lines found no memory

    scene::GeometryLayouts layouts;
    scene::ContentVersions contentVersions;
    uint64_t boundsChanges = 0; ///< of vertex buffers
    passes::PipelineCache pipelines;
    passes::DispatchCache dispatches;
    engine::CompileQueue compilations;
    engine::SamplerCache samplers;

    engine::HandleTable<TextureObject, engine::TextureState> textures{ owner };
    engine::HandleTable<VertexBufferObject, engine::VertexBufferState> vertexBuffers{ owner };
    engine::HandleTable<IndexBufferObject, engine::IndexBufferState> indexBuffers{ owner };
    engine::HandleTable<MorphTargetsObject, engine::MorphTargetsState> morphTargets{ owner };
    engine::HandleTable<MaterialObject, scene::Material> materials{ owner };
    engine::HandleTable<MaterialInstanceObject, scene::MaterialInstance> instances{ owner };
    engine::HandleTable<IndirectLightObject, engine::IndirectLightState> indirectLights{ owner };
    engine::HandleTable<SkyboxObject, engine::SkyboxState> skyboxes{ owner };
    engine::HandleTable<LightProfileObject, engine::LightProfileState> lightProfiles{ owner };
    engine::HandleTable<LightImageObject, engine::LightImageState> lightImages{ owner };
    uint32_t lastLightImage = 0; ///< its number: shader::kImageHeaderWords
    engine::HandleTable<RenderTargetObject, engine::RenderTargetState> renderTargets{ owner };
    engine::HandleTable<SwapChainObject, engine::SwapChainState> swapChains{ owner };

    std::vector<engine::Dependent*> dependents;
    std::vector<Scene::Impl const*> scenes; ///< that show objects of this engine
    engine::Uses uses;                      ///< of the last search
    bool aUseEnded = false;                 ///< something was destroyed, removed or replaced since

    engine::Defaults defaults;
    MaterialInstance drawingMotion;               ///< none: no frame needed motion vectors
    std::array<MaterialInstance, 2> fadingLevels; ///< by whether both faces are drawn; none: none faded yet
    std::array<MaterialInstance, 2> drawingDebug; ///< by whether surfaces hide it; none: no view had a DebugDraw
    MaterialInstance drawingSplats;               ///< none: no scene had splats
    VertexBuffer lightShapeVertices;              ///< none: no light was drawn
    IndexBuffer lightShapeIndices;
    std::map<std::string, Material> engineMaterials; ///< by package and constants
    uint64_t rasterChanges = 0;                      ///< of instances; they change the order in which scenes draw
    uint64_t instanceChanges = 0;                    ///< by the app: parameters, textures, raster states
    std::vector<MaterialInstance> dirtyInstances;
    std::array<bool, scene::kTextureFilters> filtersInUse{ true }; ///< by TextureFilter: that of any frame so far
    engine::MaterialNumbers materialNumbers;
    uint32_t nextInstanceId = 0;
    engine::LoadTasks loads;                           ///< of LoadTickets
    std::unique_ptr<engine::TextureStreamer> streamer; ///< none: no texture was ever streamed
};

template <class F>
void Engine::Impl::orReport(std::string_view doing, std::string_view object, F&& run) {
    try {
        run();
    } catch (std::bad_alloc const& cause) {
        reportOutOfMemory(doing, object, cause);
    }
}

template <class F>
auto Engine::Impl::orNone(std::string_view doing, std::string_view object, F&& make) -> std::invoke_result_t<F&> {
    try {
        return make();
    } catch (std::bad_alloc const& cause) {
        reportOutOfMemory(doing, object, cause);
        return {};
    }
}

template <class Tag, class State>
void Engine::Impl::retire(engine::HandleTable<Tag, State>& table, ObjectHandle<Tag> handle) {
    if (!handle) return;
    table.retire(handle);
    aUseEnded = true;
}

template <class Tag, class State>
void Engine::Impl::removeNow(engine::HandleTable<Tag, State>& table, ObjectHandle<Tag> handle) {
    if (!handle) return;
    table.remove(handle);
    aUseEnded = true;
}

} // namespace filament_core
