// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Engine.h>

#include "backend/create/CreateDriver.h"
#include "backend/layers/Captured.h"
#include "backend/layers/Faulty.h"
#include "backend/layers/Traced.h"
#include "backend/layers/Validated.h"
#include "base/Log.h"
#include "base/OutOfMemory.h"
#include "base/Result.h"
#include "filament_core/assets/environment/Environment.h"
#include "filament_core/engine/DefaultObjects.h"
#include "filament_core/engine/DeviceNeeds.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/TextureStreamer.h"
#include "jobsystem/JobTrace.h"
#include "shaders/package/EngineMaterials.h"

namespace filament_core {
namespace {

using namespace backend;
using engine::PublicCall;
using engine::thisThread;

DeviceDescription descriptionOf(DeviceInfo const& info) {
    return { info.backend,
             info.deviceName,
             info.driverName,
             info.limits.maxTextureSize,
             info.limits.max3DTextureSize,
             info.limits.maxSamples };
}

FrameLatency latencyOf(LatencyStatistics const& latency) {
    const auto milliseconds = [](int64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-6; };
    return { latency.frames, milliseconds(latency.submitToEnd.median), milliseconds(latency.submitToEnd.p99),
             milliseconds(latency.backPressure.median), milliseconds(latency.backPressure.p99) };
}

std::filesystem::path cacheDirectory(EngineOptions const& options) {
    return assets::environmentCacheDirectory({ .cacheDirectory = options.cacheDirectory });
}

// Makes the driver, wrapped in the layers that the options request.
DriverFactory driverFactory(EngineOptions const& options) {
    return [options](ResultSink& sink) -> Result<std::unique_ptr<Driver>> {
        const auto innermost = [&options](ResultSink& results) {
            const DriverOptions driverOptions{ .requireDevice = options.requireDevice,
                                               .validation = options.validation,
                                               .display = options.display,
                                               .cacheDirectory = options.cachePrograms ? cacheDirectory(options)
                                                                                       : std::filesystem::path(),
                                               .selfTest = options.driverSelfTest,
                                               .selfTestNotes = cacheDirectory(options) };
            // From the inside out: faults strike what the device would get; captures change a stream below the trace,
            // which keeps what the app recorded; the validator stops a stream before any of them sees it.
            auto device = createDriver(options.backend, driverOptions, results);
            if (device && options.debug.faults) device = faulty(std::move(*device), options.debug.faults, results);
            return device;
        };
        auto driver = options.debug.capture ? captured(options.debug.capture, sink, innermost) : innermost(sink);
        if (!driver) return driver.error();
        std::unique_ptr<Driver> outermost = std::move(*driver);
        if (!options.traceFile.empty()) {
            auto traced = trace(std::move(outermost), options.traceFile);
            if (!traced) return traced.error();
            outermost = std::move(*traced);
        }
        if (options.validation) outermost = validate(std::move(outermost), sink);
        return outermost;
    };
}

Result<void> checkCores(EngineOptions const& options) {
    const std::pair<int, const char*> choices[] = { { options.driverCore, "EngineOptions::driverCore" },
                                                    { options.avoidCore, "EngineOptions::avoidCore" } };
    for (auto const& [core, option] : choices) {
        if (core == -1) continue;
        if (Result<void> there = jobs::requireCore(core, option); !there) return there;
    }
    return {};
}

jobs::AffinityPolicy affinityPolicy(EngineOptions const& options) {
    jobs::AffinityPolicy policy;
    if (options.affinity == ThreadAffinity::Pin) policy = jobs::AffinityPolicy::pin();
    if (options.affinity == ThreadAffinity::BigCores) policy = jobs::AffinityPolicy::bigCores();
    for (int core : { options.driverCore, options.avoidCore }) {
        if (core != -1) policy = policy.avoiding(core);
    }
    policy.repinsAfterWaits = options.repinAfterWaits;
    return policy;
}

jobs::JobSystemOptions jobOptions(EngineOptions const& options) {
    return { .workers = options.workers, .affinity = affinityPolicy(options), .trace = options.traceJobs };
}

/// A frame of a window is several submissions: its views, and the presentation. present() keeps the app close.
uint32_t framesAhead(EngineOptions const& options) {
    return options.display.system == WindowSystem::None ? CommandStreamOptions{}.maxFramesAhead : 8;
}

template <class Table>
void reportLeaks(Table const& table, const char* what) {
    table.forEach([&](auto const& state) {
        log(Severity::Warning, "{} '{}' was not destroyed before its engine", what, state.name);
    });
}

} // namespace

std::vector<DeviceDescription> listDevices() {
    std::vector<DeviceDescription> devices;
    for (DeviceInfo const& info : backend::listDevices()) devices.push_back(descriptionOf(info));
    return devices;
}

Engine::Impl::Impl(EngineOptions engineOptions, std::unique_ptr<CommandStream> commandStream)
        : options(std::move(engineOptions)), stream(std::move(commandStream)),
          driverPin(jobs::CoreRegistry::ofProcess().reserve(options.driverCore)), jobs(jobOptions(options)),
          device(descriptionOf(stream->info())), pipelines(*stream, layouts),
          dispatches(*stream, shader::engineDispatch), compilations(pipelines), samplers(*stream) {
    createDefaultObjects(*this);
}

Engine::Impl::~Impl() {
    // First: what these objects use must not seem to be a leak of the app.
    destroyDefaultObjects(*this);
    streamer.reset();
    scenes.clear(); // they show nothing without it
    aUseEnded = true;
    releaseRetired(pending);
    reportLeaks(swapChains, "swap chain");
    reportLeaks(renderTargets, "render target");
    reportLeaks(indirectLights, "indirect light");
    reportLeaks(skyboxes, "skybox");
    reportLeaks(lightProfiles, "light profile");
    reportLeaks(lightImages, "light image");
    reportLeaks(instances, "material instance");
    reportLeaks(materials, "material");
    reportLeaks(morphTargets, "morph targets");
    reportLeaks(vertexBuffers, "vertex buffer");
    reportLeaks(indexBuffers, "index buffer");
    reportLeaks(textures, "texture");
    samplers.destroyAll(pending);
    try {
        flush();
    } catch (std::bad_alloc const&) { // the driver frees the rest when it ends
    }
    // After the flush, whose errors nobody could take otherwise.
    collectErrors();
    for (std::string const& error : errors) log(Severity::Error, "{}", error);
}

void Engine::Impl::endDependents() noexcept {
    loads.abandon();
    for (engine::Dependent* dependent : dependents) dependent->release();
    dependents.clear();
}

void Engine::Impl::flush() {
    FrameCommands commands(*stream);
    drainPending(*commands);
}

void Engine::Impl::advanceCompilation() {
    compilations.collect(stream->replayedSubmissions());
    const bool driverIsIdle = stream->replayedSubmissions() == stream->submissions();
    if (!compilations.isWaiting() || !driverIsIdle) return; // else the next frame takes it
    FrameCommands commands(*stream);
    drainPending(*commands);
    recordCompilations(*commands);
}

void Engine::Impl::recordCompilations(CommandBuffer& commands) {
    compilations.recordSlice(commands, stream->submissions() + 1);
}

void Engine::Impl::drainPending(CommandBuffer& commands) {
    // What is pending creates the objects that later commands use, and may itself use objects that are released next.
    if (pending.commandCount() > 0) commands.append(std::move(pending));
    releaseRetired(commands);
    // After the release, which takes dead instances off the list: no block is uploaded for them.
    for (MaterialInstance handle : dirtyInstances) updateInstance(instances.held(handle), commands);
    dirtyInstances.clear();
}

void Engine::Impl::collectErrors() {
    std::vector<DriverError> taken;
    std::vector<std::string> refusals = pipelines.takeRefusals();
    try {
        // Everything that may fail comes first, so that no error is lost halfway.
        taken = stream->takeErrors();
        errors.reserve(errors.size() + taken.size() + refusals.size() + 1);
        if (untoldErrors > 0) errors.push_back(fmt::format("out of memory, {} more times", untoldErrors));
        untoldErrors = 0;
        for (DriverError& error : taken) errors.push_back(std::move(error.message));
        for (std::string& line : refusals) errors.push_back(std::move(line));
    } catch (std::bad_alloc const&) { // reported next time
        untoldErrors += static_cast<uint32_t>(taken.size() + refusals.size());
    }
}

void Engine::Impl::report(std::string_view line) noexcept {
    try {
        errors.emplace_back(line);
    } catch (std::bad_alloc const&) {
        ++untoldErrors;
    }
}

void Engine::Impl::reportOutOfMemory(std::string_view doing, std::string_view object,
                                     std::bad_alloc const& cause) noexcept {
    report(outOfMemory(doing, object, cause).message);
}

double Engine::Impl::secondsSinceStart(int64_t steadyNanoseconds) const {
    const auto origin = std::chrono::duration_cast<std::chrono::nanoseconds>(start.time_since_epoch()).count();
    return static_cast<double>(steadyNanoseconds - origin) * 1e-9;
}

Result<Engine> Engine::create(EngineOptions const& options) {
    const ApiCall call("Engine::create(EngineOptions)");
    return orOutOfMemory("engine on", toString(options.backend), [&]() -> Result<Engine> {
        // Before the driver starts, which takes far longer.
        if (Result<void> cores = checkCores(options); !cores) return cores.error();
        if (!options.exactShaders && !options.debug.plainMaterials)
            return fail(ErrorCode::Unsupported,
                        "exactShaders = false needs shaders that the library does not contain: set "
                        "EngineDebug::plainMaterials, as filament-render and filament-accuracy do, or leave it on");
        auto stream = CommandStream::start(driverFactory(options), { .maxFramesAhead = framesAhead(options),
                                                                     .driverCore = options.driverCore,
                                                                     .repinAfterWaits = options.repinAfterWaits,
                                                                     .hashStreams = options.hashFrames });
        if (!stream) return stream.error();
        if (Result<void> usable = engine::checkDevice((*stream)->info()); !usable) return usable.error();
        return Engine(std::make_shared<Impl>(options, std::move(*stream)));
    });
}

Engine::Engine(std::shared_ptr<Impl> impl) : mImpl(std::move(impl)) { mImpl->self = this; }
Engine::Engine(Engine&& other) noexcept : mImpl(std::move(other.mImpl)) {
    if (mImpl) mImpl->self = this;
}
Engine& Engine::operator=(Engine&& other) noexcept {
    if (mImpl && mImpl != other.mImpl) mImpl->endDependents();
    mImpl = std::move(other.mImpl);
    if (mImpl) mImpl->self = this;
    return *this;
}
Engine& Engine::of(Impl& impl) { return *impl.self; }
Engine::~Engine() {
    if (!mImpl) return;
    const PublicCall call(mImpl, "Engine::~Engine()");
    mImpl->endDependents();
}

void Engine::useOnThisThread() {
    if (mImpl) mImpl->appThread = thisThread();
}

DeviceDescription const& Engine::device() const {
    const PublicCall call(mImpl, "Engine::device()");
    return mImpl->device;
}

EngineStatistics Engine::statistics() const {
    const PublicCall call(mImpl, "Engine::statistics()");
    const DriverStatistics driver = mImpl->stream->statistics();
    return { driver.draws,
             driver.pipelinesCreated,
             driver.programsCreated,
             driver.programsFromCache + driver.pipelinesFromCache,
             driver.pipelinesCreatedInPasses,
             driver.commands,
             driver.deviceBytes,
             mImpl->stream->backPressureNanoseconds(),
             driver.presents,
             driver.lastPresent == decltype(driver.lastPresent){}
                     ? 0
                     : mImpl->secondsSinceStart(driver.lastPresent.time_since_epoch().count()),
             latencyOf(mImpl->stream->latency()) };
}

std::vector<std::string> Engine::takeErrors() {
    const PublicCall call(mImpl, "Engine::takeErrors()");
    mImpl->collectErrors();
    return std::exchange(mImpl->errors, {});
}

Result<void> Engine::writeJobTrace(std::filesystem::path const& file) const {
    const PublicCall call(mImpl, "Engine::writeJobTrace(filesystem::path)");
    return orOutOfMemory("job trace", file.native(), [&]() -> Result<void> {
        if (jobs::JobTrace const* timeline = mImpl->jobs.trace()) return writeChromeTrace(timeline->snapshot(), file);
        return fail(ErrorCode::InvalidArgument, "job trace '{}': make the engine with EngineOptions::traceJobs",
                    file.string());
    });
}

void Engine::waitIdle() {
    const PublicCall call(mImpl, "Engine::waitIdle()");
    try {
        mImpl->flush();
    } catch (std::bad_alloc const&) {
        mImpl->reportOutOfMemory("engine: what was not submitted yet waits for the next frame");
    }
    mImpl->stream->waitIdle();
}

} // namespace filament_core
