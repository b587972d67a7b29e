// SPDX-License-Identifier: Apache-2.0
/// Engine: one device, its driver thread, its workers, and every object created from them.
///   Thread    one thread per engine (the app thread): the one that creates it, unless useOnThisThread() says
///             otherwise. Several engines may run on several threads.
///   Wait      creating objects never waits for the driver thread. Engine::create() and the destructor do.
///   Errors    Engine::create() says why there is no device and what to install. Later, takeErrors() returns the errors
///             of the device (out of memory, a rejected shader), one line each; objects that depend on them are not
///             drawn.
///   Memory    if host memory runs out, functions that return a Result return OutOfMemory. Functions that return a
///             handle return none and add a line to takeErrors(). Nothing else changes. Destroying always works.
///   Life      an object may be destroyed at any time: its handle ends at once, and what it names lives on until
///             nothing uses it any more: no renderable, material instance, environment or render target.
///   Misuse    a null handle, one whose object was destroyed, one of another engine or scene, another thread, or an
///             argument out of its range ends the process with one line: the function that was called, what for, and
///             what is wrong. destroy() of a null handle does nothing.
///   Bits      with the default options the same calls give the same image bits with Mesa's CPU drivers for Vulkan and
///             OpenGL ES, for any number of workers.
#pragma once

#include <filament_core/Backend.h>
#include <filament_core/NativeWindow.h>
#include <filament_core/Objects.h>
#include <filament_core/Result.h>
#include <filament_core/Stencil.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace filament_core {
namespace backend {
class FrameCapture;  // backend/layers/Captured.h
class FaultInjector; // backend/layers/Faulty.h
} // namespace backend

struct DeviceDescription {
    Backend backend = Backend::Null;
    std::string device{};          ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver{};          ///< name and version
    uint32_t maxTextureSize = 0;   ///< texels a side
    uint32_t max3DTextureSize = 0; ///< texels a side of a 3D texture
    uint32_t maxSamples = 1;
};

/// Every device that Engine::create() could use now. Backends without an installed driver are absent.
std::vector<DeviceDescription> listDevices();

/// Where the job threads of an engine run, within the cores that the process may use.
enum class ThreadAffinity : uint8_t {
    None,     ///< the operating system decides
    Pin,      ///< each thread on one core; engines of one process share cores only if none is free
    BigCores, ///< on the cores of the most capable class, if there are several classes
};

/// Instruments for tools that look inside a frame. An instrument that is absent costs nothing.
struct EngineDebug {
    std::shared_ptr<backend::FrameCapture> capture{}; ///< reads every attachment of a frame, cuts it off after a draw
    std::shared_ptr<backend::FaultInjector> faults{}; ///< loses the device, refuses objects, slows the driver down
    /// The package of an engine material by its name, compiled with `matc --inexact`; the bytes live as long as the
    /// engine. Needed where EngineOptions::exactShaders is false; called by any thread.
    std::function<std::span<const std::byte>(std::string_view name)> plainMaterials{};
};

struct EngineOptions {
    Backend backend = Backend::Vulkan;
    std::string requireDevice{}; ///< case-insensitive part of the device's name; empty: the first usable device
    int workers = -1;            ///< job threads besides the app thread; -1: one per remaining core; 0: none
    ThreadAffinity affinity = ThreadAffinity::None;
    int driverCore = -1; ///< pin the driver thread to this core and keep job threads off it
    int avoidCore = -1;  ///< also keep job threads off this core; -1: none
    /// Threads with cores of their own take them again each time they wake up: for systems that move processes between
    /// groups of cores, as Android does. One system call per wake-up.
    bool repinAfterWaits = false;
    /// Of the windows that the engine presents to (SwapChainDesc::window); none: it opens no window system. With one,
    /// only devices that can present to its windows are used.
    NativeDisplay display{};
    bool validation = false; ///< check every stream, and enable the Vulkan validation layers or KHR_debug
    /// The engine's own shaders write their arithmetic out, so that both APIs draw the same bits. Off: the drivers
    /// choose, as in other engines; for programs that measure the difference and bring such shaders along
    /// (EngineDebug::plainMaterials), without which Engine::create() fails with Unsupported. Materials that you compile
    /// yourself follow the options given to matc.
    bool exactShaders = true;
    bool traceJobs = false;            ///< record what every thread does and when: Engine::writeJobTrace()
    bool hashFrames = false;           ///< FrameTimings::packetHash and streamHash, for tests; reads the data twice
    std::filesystem::path traceFile{}; ///< write every command as text, for replay; empty: no trace
    std::filesystem::path cacheDirectory{}; ///< baked environments, programs; empty: $XDG_CACHE_HOME/filament_core
    /// Keep the device's compiled programs in cacheDirectory for the next engine. Useful for drivers without their own
    /// cache. Mesa has one; backend/gles/README.md says what this option adds to it.
    bool cachePrograms = false;
    /// Before its first use a driver draws 8 x 8 pixels whose values are known. Engine::create() fails with
    /// Unsupported if they are wrong, instead of an engine that draws wrong images. A file in cacheDirectory names
    /// the drivers that passed, which are not tested again.
    bool driverSelfTest = true;
    EngineDebug debug{};
};

/// How far the driver thread was behind, over at most the last 256 frames, in milliseconds.
struct FrameLatency {
    uint32_t frames = 0;
    double submitToReplayedMedian = 0, submitToReplayedP99 = 0; ///< from submission until the driver thread is done
    double backPressureMedian = 0, backPressureP99 = 0;         ///< the app waited for a free command buffer
};

/// Running totals of an engine.
struct EngineStatistics {
    uint64_t draws = 0;
    uint64_t pipelinesCreated = 0;
    uint64_t programsCreated = 0;
    uint64_t programsFromCache = 0; ///< programs or pipelines not compiled (EngineOptions::cachePrograms)
    uint64_t pipelinesCreatedInPasses = 0;
    uint64_t commands = 0;
    uint64_t deviceBytes = 0;
    uint64_t backPressureNanoseconds = 0; ///< time that the app waited for the driver thread
    uint64_t presents = 0;                ///< images that windows have taken
    double lastPresentSeconds = 0;        ///< when they took the last one, since the engine started; 0: none
    FrameLatency latency{};
};

template <class T>
class Owned;

class Engine {
public:
    static Result<Engine> create(EngineOptions const& options = {});
    Engine(Engine&&) noexcept;
    Engine& operator=(Engine&&) noexcept;
    /// Waits for the device. A warning names objects that are still alive, and they are freed. What outlives its engine
    /// may still be destroyed, but not be used.
    ~Engine();

    /// The calling thread becomes the app thread, for this engine and all that belongs to it. The one before must have
    /// stopped using them.
    void useOnThisThread();

    DeviceDescription const& device() const;
    EngineStatistics statistics() const;
    /// Errors of the device and driver since the last call, oldest first.
    std::vector<std::string> takeErrors();
    /// Waits until everything submitted has run.
    void waitIdle();
    /// With EngineOptions::traceJobs: writes the newest jobs, frames and replays of all threads as Chrome trace events,
    /// for chrome://tracing, Perfetto or tools/plot. InvalidArgument without that option; Unreadable names the file.
    Result<void> writeJobTrace(std::filesystem::path const& file) const;

    Texture create(TextureDesc const& desc);
    VertexBuffer create(VertexBufferDesc const& desc);
    IndexBuffer create(IndexBufferDesc const& desc);
    MorphTargets create(MorphTargetsDesc const& desc);
    IndirectLight create(IndirectLightDesc const& desc);
    Skybox create(SkyboxDesc const& desc);
    /// Fails: Corrupt or Unsupported, with the name, the line of the file, and what was expected there. From a path:
    /// loadLightProfile() of <filament_core/LightProfile.h>.
    Result<LightProfile> create(LightProfileDesc const& desc);
    /// Fails: InvalidArgument for a size that does not fit the shape. From a path: loadLightImage() of
    /// <filament_core/LightImage.h>.
    Result<LightImage> create(LightImageDesc const& desc);
    RenderTarget create(RenderTargetDesc const& desc);
    SwapChain create(SwapChainDesc const& desc);
    /// How windows can read what they show (SwapChainDesc::outputSpace); Srgb at least. Waits for the driver thread.
    /// Ask before a swap chain has the window. Fails: as takeErrors() says where a window cannot be opened; DeviceLost.
    Result<std::vector<OutputSpace>> outputSpaces(NativeWindow window);
    /// Fails: Corrupt or Unsupported for the package; NotFound with the nearest name for an unknown constant.
    Result<Material> create(MaterialDesc const& desc);
    /// Prepares the programs and pipelines of a material before it is first drawn. The driver thread does this in
    /// slices, one with each frame, or with progress() when no frame is drawn; the app thread never waits. Pipelines
    /// are created for the raster states of the instances, the vertices of CompileDesc, and the passes of frames drawn
    /// so far or announced by Renderer::prewarm(). InvalidArgument names material, variant and filter if a variant was
    /// filtered out.
    Result<Compilation> compile(Material material, CompileDesc const& desc = {});
    /// Returns the progress, and sends the next slice if the driver thread is idle.
    CompileProgress progress(Compilation compilation);
    /// Parameters start at zero, textures at opaque white.
    MaterialInstance createInstance(Material material, std::string name = {});

    // New contents, from the next frame on; frames before it show the old ones. Copied before the call returns,
    // uploaded in the order of the calls; nothing waits. Data out of range ends the process; if memory runs out, the
    // object keeps its contents, and takeErrors() reports it.

    /// `data`: whole vertices. Bounds that renderables did not name follow.
    void update(VertexBuffer buffer, std::span<const std::byte> data, uint32_t firstVertex = 0, uint32_t stream = 0);
    void update(IndexBuffer buffer, std::span<const std::byte> data, uint32_t firstIndex = 0);
    void update(Texture texture, TextureUpdate const& update);

    /// New images of another size, without contents; a window keeps its image until the next present(). Pixels that
    /// were requested arrive.
    void resize(SwapChain swapChain, uint2 size);

    /// The textures of a render target, for parameters of materials. They are the app's own; depthOf() may be none.
    Texture colorOf(RenderTarget target) const;
    Texture depthOf(RenderTarget target) const;

    /// What the material declares, and the values it was loaded with. Valid until the material is destroyed.
    MaterialDescription const& describe(Material material) const;
    LightProfileDescription describe(LightProfile profile) const;
    LightImageDescription describe(LightImage image) const;

    /// For set() in every frame, without the search by name. NotFound names the nearest parameter.
    Result<ParameterId> findParameter(Material material, std::string_view name) const;
    /// `parameter`: its name, or an id of the instance's material. NotFound names the nearest parameter;
    /// InvalidArgument names the parameter's type and the type given.
    Result<void> set(MaterialInstance instance, ParameterKey const& parameter, ParameterValue const& value);
    /// A number, or a value of any type of ParameterValue. Parameters of float take doubles, rounded, and integers;
    /// integer parameters take integers of any type. InvalidArgument if the parameter cannot hold the number: 1e39 or
    /// 2^24 + 1 in a float, -1 in an unsigned one.
    template <class T>
    requires(!std::is_constructible_v<ParameterArray, T const&> && !std::is_convertible_v<T const&, Texture> &&
             !std::is_same_v<T, ParameterValue>) Result<void> set(MaterialInstance instance,
                                                                  ParameterKey const& parameter, T const& value) {
        static_assert(std::is_arithmetic_v<T> || std::is_constructible_v<ParameterValue, T const&>,
                      "a material's parameter takes a bool, a number, a vector or a matrix: see ParameterValue");
        if constexpr (!std::is_arithmetic_v<T> || std::is_same_v<T, bool> || std::is_same_v<T, float>)
            return set(instance, parameter, ParameterValue(value));
        else if constexpr (std::is_floating_point_v<T>)
            return setNumber(instance, parameter, static_cast<double>(value));
        else if constexpr (std::is_signed_v<T>)
            return setNumber(instance, parameter, static_cast<int64_t>(value));
        else
            return setNumber(instance, parameter, static_cast<uint64_t>(value));
    }
    /// Sets elements [first, first + values.size()) of an array. InvalidArgument also if the array is too short.
    Result<void> set(MaterialInstance instance, ParameterKey const& parameter, ParameterArray const& values,
                     uint32_t first = 0);
    /// InvalidArgument also if the texture's kind or format does not match the sampler: samplers of format int or uint
    /// take integer textures, and never filter.
    Result<void> set(MaterialInstance instance, ParameterKey const& parameter, Texture texture, Sampler sampler = {});
    /// True draws and shades both sides; false applies the material's `culling`. InvalidArgument if the material was
    /// compiled without the property doubleSided.
    Result<void> setDoubleSided(MaterialInstance instance, bool doubleSided);
    /// Draws both sides without changing how they are shaded.
    void setCullingDisabled(MaterialInstance instance, bool disabled);
    /// These override the material's own state for one instance, from the next frame on. A new combination of states
    /// creates a pipeline, unless an instance had it when compile() was called.
    void setCulling(MaterialInstance instance, Culling culling);
    /// Faces that are culled in shadow maps. Unset, the default: the faces that are not drawn.
    void setShadowCulling(MaterialInstance instance, std::optional<Culling> culling);
    void setColorWrite(MaterialInstance instance, bool writes);
    void setDepthWrite(MaterialInstance instance, bool writes);
    void setDepthCulling(MaterialInstance instance, bool tests); ///< false: draws over everything and writes no depth
    /// Unset, the default: neither tests nor changes stencil values.
    void setStencil(MaterialInstance instance, std::optional<StencilState> state);
    /// In [0, 1]; InvalidArgument if the material is not masked.
    Result<void> setMaskThreshold(MaterialInstance instance, float threshold);

    /// The handle ends at once; what still uses the object keeps it: a material its instances, a light its profile and
    /// its image. A null handle: nothing happens.
    void destroy(EngineObject object);

    template <class T>
    Owned<T> own(T object);

    struct Impl;
    Impl& impl() { return *mImpl; } ///< for the engine's own files; its address stays when the Engine is moved
    static Engine& of(Impl& impl);  ///< the Engine that holds it now
    std::weak_ptr<Impl> share() const { return mImpl; }

private:
    explicit Engine(std::shared_ptr<Impl> impl);
    Result<void> setNumber(MaterialInstance instance, ParameterKey const& parameter, ParameterNumber const& number);

    std::shared_ptr<Impl> mImpl; ///< not shared; weak references detect its end
};

/// Owns one object and destroys it at the end of the scope. The engine may be moved, and may end before it.
template <class T>
class Owned {
public:
    Owned() = default;
    Owned(Engine& engine, T object) : mEngine(engine.share()), mObject(object) {}
    Owned(Owned&& other) noexcept : mEngine(std::move(other.mEngine)), mObject(other.release()) {}
    Owned& operator=(Owned&& other) noexcept {
        if (this != &other) {
            reset();
            mEngine = std::move(other.mEngine);
            mObject = other.release();
        }
        return *this;
    }
    ~Owned() { reset(); }

    T get() const { return mObject; }
    operator T() const { return mObject; }
    T release() {
        const T object = mObject;
        mObject = {};
        return object;
    }
    void reset() {
        const T object = release();
        if (const std::shared_ptr<Engine::Impl> engine = mEngine.lock(); engine && object)
            Engine::of(*engine).destroy(object);
    }

private:
    std::weak_ptr<Engine::Impl> mEngine;
    T mObject{};
};

template <class T>
Owned<T> Engine::own(T object) {
    return Owned<T>(*this, object);
}

} // namespace filament_core
