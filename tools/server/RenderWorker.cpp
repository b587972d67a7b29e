// SPDX-License-Identifier: Apache-2.0
#include "tools/server/RenderWorker.h"

#include "tools/server/FolderWatch.h"

#include <filament_core/Image.h>
#include <filament_core/Renderer.h>

#include <sys/prctl.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

namespace filament_core::server {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLookAgain(1000);

double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Since the file was last written: when the job was accepted.
double ageOf(fs::path const& file) {
    std::error_code error;
    const fs::file_time_type written = fs::last_write_time(file, error);
    return error ? 0 : std::chrono::duration<double>(fs::file_time_type::clock::now() - written).count();
}

/// The fault of who sent it, or of this machine.
int statusOf(ErrorCode code) {
    switch (code) {
    case ErrorCode::InvalidArgument:
    case ErrorCode::NotFound:
    case ErrorCode::Corrupt:
    case ErrorCode::Unsupported:
    case ErrorCode::Unreadable:
        return 400;
    default:
        return 500;
    }
}

/// Frames before the last give effects over time what they accumulate.
Result<Image> imageOf(Engine& engine, BuiltScene& built, ImageFormat format) {
    Renderer renderer(engine);
    const bool isLinear = format == ImageFormat::Exr;
    const uint2 size = built.contents.target.x > 0 ? built.contents.target : built.view.size;
    const Owned<SwapChain> frames = engine.own(
            engine.create(SwapChainDesc{ .size = size, .format = isLinear ? Format::RGBA16F : Format::RGBA8 }));
    drawFrames(engine, renderer, built, frames);
    return renderer.waitPixels(renderer.readPixels(frames));
}

} // namespace

Result<Engine*> RenderWorker::engineOf(Backend api) {
    if (const auto known = mEngines.find(api); known != mEngines.end()) return &known->second;
    Result<Engine> engine = Engine::create({ .backend = api, .workers = 0 });
    if (!engine) return engine.error();
    return &mEngines.emplace(api, std::move(*engine)).first->second;
}

Result<void> RenderWorker::draw(RenderRequest const& request, fs::path const& file) {
    const Result<Engine*> engine = engineOf(request.api);
    if (!engine) return engine.error();
    Result<BuiltScene> built = buildScene(**engine, request.scene, buildOptions(mLimits, request.scene));
    if (!built) return built.error();
    const Result<Image> image = imageOf(**engine, *built, request.format);
    if (!image) return image.error();
    return request.format == ImageFormat::Png ? savePng(file, *image) : saveExr(file, *image);
}

Result<void> RenderWorker::handle(ClaimedJob const& job) {
    JobOutcome outcome{ .error = {}, .contentType = {}, .queuedSeconds = ageOf(job.file) };
    const Clock::time_point begin = Clock::now();
    const Result<RenderRequest> request = parseRequest(job.request, mLimits);
    const Result<void> drawn = request ? draw(*request, mSpool.imageDraft(job)) : Result<void>(request.error());
    if (drawn) {
        outcome.contentType = contentType(request->format);
    } else {
        outcome.status = statusOf(drawn.error().code);
        outcome.error = withoutFolders(drawn.error().message, mLimits);
        if (outcome.status == 500 && request) mEngines.erase(request->api); // the next job has another one
    }
    outcome.renderSeconds = secondsSince(begin);
    return mSpool.finish(job, outcome);
}

Result<void> RenderWorker::run() {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL); // a job of a worker whose server has ended would be drawn twice
    const pid_t parent = ::getppid();
    FolderWatch watch(mSpool.queuedFolder());
    for (;;) {
        if (::getppid() != parent) return {}; // it ended before the line above
        const Result<std::optional<ClaimedJob>> job = mSpool.claim();
        if (!job) return job.error();
        if (!*job) {
            watch.wait(kLookAgain);
            continue;
        }
        if (Result<void> done = handle(**job); !done) return done;
    }
}

} // namespace filament_core::server
