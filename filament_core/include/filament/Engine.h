// SPDX-License-Identifier: Apache-2.0
/// Engine: one device, its driver thread, its workers, and every object made from them.
///   Thread    one thread per engine (the app thread); several engines on several threads are fine.
///   Wait      creating never waits for the driver thread. create() and the destructor do.
///   Errors    create() says why there is no device and what to install. Later the device's own errors (out of memory,
///             a shader it rejects) come out of takeErrors(), one line each; what depends on them is not drawn.
///   Memory    when the host's runs out, what returns a Result returns OutOfMemory, what returns a handle returns none,
///             with a line in takeErrors(), and nothing else has changed. Destroying always works.
///   Bits      with the default options the same calls give the same image bits on Vulkan and OpenGL ES of Mesa's
///             CPU drivers, for any number of workers.
#pragma once

#include <filament/Backend.h>
#include <filament/Objects.h>
#include <filament/Result.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace filament {
namespace backend {
class FrameCapture;  // backend/layers/Captured.h
class FaultInjector; // backend/layers/Faulty.h
} // namespace backend

struct DeviceDescription {
    Backend backend = Backend::Null;
    std::string device{}; ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver{}; ///< name and version
    uint32_t maxTextureSize = 0;
    uint32_t maxSamples = 1;
};

/// Every device that createEngine could use now; backends without a driver installed are absent.
std::vector<DeviceDescription> listDevices();

/// Where the job threads of an engine run, within the cores that the process may use.
enum class ThreadAffinity : uint8_t {
    None,     ///< where the operating system likes
    Pin,      ///< each on one core; engines of one process share cores only when none is free
    BigCores, ///< on the cores of the most capable class, where there are several classes
};

/// Instruments for tools that look inside of a frame; none of them costs anything when it is not there.
struct EngineDebug {
    std::shared_ptr<backend::FrameCapture> capture{}; ///< shows every attachment of a frame, cuts it off after a draw
    std::shared_ptr<backend::FaultInjector> faults{}; ///< loses the device, refuses objects, slows the driver down
};

struct EngineOptions {
    Backend backend = Backend::Vulkan;
    std::string requireDevice{}; ///< case-insensitive part of the device's name; empty: the first usable
    int workers = -1;            ///< job threads besides the app thread; -1: one per remaining core; 0: none
    ThreadAffinity affinity = ThreadAffinity::None;
    int driverCore = -1;     ///< pin the driver thread to this core and keep job threads off it
    int avoidCore = -1;      ///< keep job threads off this core, too; -1: off none
    bool validation = false; ///< check every stream; Vulkan validation layers or KHR_debug on top
    /// The engine's own shaders spell their arithmetic out, so that both APIs draw the same bits. Off: the drivers
    /// choose, as other engines let them; materials that you compile yourself are as you told matc.
    bool exactShaders = true;
    bool traceJobs = false;                 ///< remember what every thread did when: Engine::writeJobTrace()
    bool hashFrames = false;                ///< FrameTimings::packetHash and streamHash, for tests; reads all twice
    std::filesystem::path traceFile{};      ///< write every command as text, for replay; empty: do not
    std::filesystem::path cacheDirectory{}; ///< baked environments, programs; empty: $XDG_CACHE_HOME/filament_core
    /// Keep what the device makes of programs in cacheDirectory for the next engine on it. For drivers without a cache
    /// of their own: Mesa has one (backend/gles/README.md has what this adds to it).
    bool cachePrograms = false;
    EngineDebug debug{};
};

/// How far the driver thread was behind, over the last 256 frames at most. Milliseconds.
struct FrameLatency {
    uint32_t frames = 0;
    double submitToReplayedMedian = 0, submitToReplayedP99 = 0; ///< from submit until the driver thread is done
    double backPressureMedian = 0, backPressureP99 = 0;         ///< the app waited for a free command buffer
};

/// Running totals of an engine.
struct EngineStatistics {
    uint64_t draws = 0;
    uint64_t pipelinesCreated = 0;
    uint64_t programsCreated = 0;
    uint64_t programsFromCache = 0; ///< of them, or of the pipelines: not compiled (EngineOptions::cachePrograms)
    uint64_t pipelinesCreatedInPasses = 0;
    uint64_t commands = 0;
    uint64_t deviceBytes = 0;
    uint64_t backPressureNanoseconds = 0; ///< the app has waited this long for the driver thread
    FrameLatency latency{};
};

template <class T>
class Owned;

class Engine {
public:
    static Result<Engine> create(EngineOptions const& options = {});
    Engine(Engine&&) noexcept;
    Engine& operator=(Engine&&) noexcept;
    /// Waits for the device; objects still alive are named in a warning and freed.
    ~Engine();

    DeviceDescription const& device() const;
    EngineStatistics statistics() const;
    /// Errors of device and driver since the last call, oldest first.
    std::vector<std::string> takeErrors();
    /// Waits until everything submitted has run.
    void waitIdle();
    /// With EngineOptions::traceJobs: the newest jobs, frames and replays of all threads as Chrome trace events, for
    /// chrome://tracing, Perfetto or tools/plot. InvalidArgument without that option; Unreadable names the file.
    Result<void> writeJobTrace(std::filesystem::path const& file) const;

    Texture create(TextureDesc const& desc);
    VertexBuffer create(VertexBufferDesc const& desc);
    IndexBuffer create(IndexBufferDesc const& desc);
    MorphTargets create(MorphTargetsDesc const& desc);
    IndirectLight create(IndirectLightDesc const& desc);
    Skybox create(SkyboxDesc const& desc);
    RenderTarget create(RenderTargetDesc const& desc);
    SwapChain create(SwapChainDesc const& desc);
    /// Corrupt or Unsupported package; an unknown constant is NotFound with the nearest name.
    Result<Material> create(MaterialDesc const& desc);
    /// Prepares programs and pipelines of a material before it is first drawn: on the driver thread, a slice with each
    /// frame, or with progress() when none is drawn; the app thread waits for none of it. Pipelines are made for the
    /// instances' raster states, the vertices of CompileDesc, and the passes of the frames drawn so far or announced
    /// by Renderer::expect(). InvalidArgument names material, variant and filter if a variant was filtered out.
    Result<Compilation> compile(Material material, CompileDesc const& desc = {});
    /// How far it is; hands out the next slice if the driver thread has nothing to do.
    CompileProgress progress(Compilation compilation);
    /// Parameters start at zero, textures at opaque white.
    MaterialInstance createInstance(Material material, std::string name = {});

    /// What the material declares, and what it was loaded with. Until it is destroyed.
    MaterialDescription const& describe(Material material) const;

    /// NotFound names the nearest parameter; InvalidArgument names the type it has and the one it was given.
    Result<void> set(MaterialInstance instance, std::string_view parameter, ParameterValue const& value);
    /// Elements [first, first + values.size()) of an array; the others stay. InvalidArgument also for those it lacks.
    Result<void> set(MaterialInstance instance, std::string_view parameter, ParameterArray const& values,
                     uint32_t first = 0);
    /// InvalidArgument also for a texture of another kind than the sampler's, or of another format: samplers of format
    /// int or uint take integers, and never filter.
    Result<void> set(MaterialInstance instance, std::string_view parameter, Texture texture, Sampler sampler = {});
    /// Draws and shades both sides, or what the material's `culling` leaves. InvalidArgument if the material was
    /// compiled without the property doubleSided.
    Result<void> setDoubleSided(MaterialInstance instance, bool doubleSided);
    /// Draws both sides; how they are shaded stays.
    void setCullingDisabled(MaterialInstance instance, bool disabled);
    /// Of this instance, instead of what the material says. What is drawn from the next frame on; a state that is new
    /// makes a pipeline, unless compile() knew an instance that had it.
    void setCulling(MaterialInstance instance, Culling culling);
    void setColorWrite(MaterialInstance instance, bool writes);
    void setDepthWrite(MaterialInstance instance, bool writes);
    void setDepthCulling(MaterialInstance instance, bool tests); ///< false: over whatever is there, and leaves no depth
    /// In [0, 1]; InvalidArgument for materials that are not masked.
    Result<void> setMaskThreshold(MaterialInstance instance, float threshold);

    void destroy(Texture texture);
    void destroy(VertexBuffer buffer);
    void destroy(IndexBuffer buffer);
    void destroy(MorphTargets targets);
    void destroy(Material material); ///< its instances must be destroyed first
    void destroy(MaterialInstance instance);
    void destroy(IndirectLight light);
    void destroy(Skybox skybox);
    void destroy(RenderTarget target);
    void destroy(SwapChain swapChain);

    template <class T>
    Owned<T> own(T object);

    struct Impl;
    Impl& impl() { return *mImpl; } ///< for the engine's own files; stays where it is when the Engine is moved
    static Engine& of(Impl& impl);  ///< the Engine that holds it now

private:
    explicit Engine(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> mImpl;
};

/// Owns one object: destroys it at the end of the scope. The engine must outlive it; it may be moved meanwhile.
template <class T>
class Owned {
public:
    Owned() = default;
    Owned(Engine& engine, T object) : mEngine(&engine.impl()), mObject(object) {}
    Owned(Owned&& other) noexcept : mEngine(other.mEngine), mObject(other.release()) {}
    Owned& operator=(Owned&& other) noexcept {
        if (this != &other) {
            reset();
            mEngine = other.mEngine;
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
        if (mObject) Engine::of(*mEngine).destroy(release());
    }

private:
    Engine::Impl* mEngine = nullptr;
    T mObject{};
};

template <class T>
Owned<T> Engine::own(T object) {
    return Owned<T>(*this, object);
}

} // namespace filament
