// SPDX-License-Identifier: Apache-2.0
#include "tools/view/compare/ProgressiveReference.h"

#include "base/math/Half.h"
#include "tools/reference/Output.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>

namespace filament_core::view {
namespace {

constexpr int kNiceness = 10;

// Linux has a niceness for each thread. The tracer gets what the viewer leaves.
void lowerPriority() { setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNiceness); }

/// What is asked for. Each change ends the work on the one before.
struct Request {
    SceneLoader loader; ///< empty: no scene
    std::optional<reference::ReferenceView> view;
    reference::ReferenceSettings settings{};
    uint64_t sceneNumber = 0, viewNumber = 0;
    std::shared_ptr<jobs::Cancellation> cancelled = std::make_shared<jobs::Cancellation>();
    bool isStopped = false, isEnding = false;
};

} // namespace

using State = TracingStatus::State;

struct ProgressiveReference::Impl {
    mutable std::mutex mutex;
    std::condition_variable changed;
    Request request; // and all below: guarded by mutex
    bool isRequestNew = false;
    TracingStatus status;
    std::optional<TracedView> picture;

    // Of the tracing thread alone.
    reference::TracedScenePtr scene;
    uint64_t sceneNumber = 0;

    std::thread thread; // the last member: it uses all others

    Impl() : thread([this] { run(); }) {}
    ~Impl() {
        change([](Request& w) { w.isEnding = true; });
        thread.join();
    }

    template <class Change>
    void change(Change const& apply) {
        const std::lock_guard lock(mutex);
        request.cancelled->request();
        request.cancelled = std::make_shared<jobs::Cancellation>();
        request.isStopped = false;
        apply(request);
        isRequestNew = true;
        picture.reset();
        status = { .isBusy = status.isBusy, .warnings = std::move(status.warnings) };
        changed.notify_one();
    }

    /// Nothing: the end.
    std::optional<Request> nextRequest() {
        std::unique_lock lock(mutex);
        status.isBusy = false;
        changed.wait(lock, [this] { return isRequestNew; });
        isRequestNew = false;
        status.isBusy = true;
        return request.isEnding ? std::nullopt : std::optional(request);
    }

    /// Only results of the current request are reported.
    template <class Change>
    void tell(Request const& of, Change const& apply) {
        const std::lock_guard lock(mutex);
        if (!of.cancelled->isRequested()) apply();
    }

    void failWith(Request const& of, Error const& error) {
        tell(of, [&] {
            status.state = State::Failed;
            status.error = error.message;
        });
    }

    void run() {
        lowerPriority();
        jobs::JobSystem jobs({ .workers = 0 });
        while (const std::optional<Request> now = nextRequest()) {
            if (now->isStopped || !now->loader || !now->view) continue;
            if (prepareScene(*now, jobs)) trace(*now, jobs);
        }
        scene.reset();
    }

    bool prepareScene(Request const& now, jobs::JobSystem& jobs) {
        if (scene && sceneNumber == now.sceneNumber) return true;
        tell(now, [&] { status.state = State::Loading; });
        scene.reset();
        const Result<reference::ReferenceScene> loaded = now.loader(jobs);
        if (!loaded) return failWith(now, loaded.error()), false;
        Result<reference::TracedScenePtr> prepared = reference::prepare(*loaded, jobs);
        if (!prepared) return failWith(now, prepared.error()), false;
        scene = std::move(*prepared);
        sceneNumber = now.sceneNumber;
        tell(now, [&] { status.warnings = reference::warnings(*scene); });
        return true;
    }

    void trace(Request const& now, jobs::JobSystem& jobs) {
        auto rendering = reference::ProgressiveRender::start(*scene, *now.view, now.settings);
        if (!rendering) return failWith(now, rendering.error());
        showProgress(now, *rendering, State::Tracing);
        while (!rendering->isFinished() && rendering->runPass(jobs, now.cancelled.get())) {
            TracedView traced{ rendering->image(), now.viewNumber, rendering->isFinished() };
            tell(now, [&] { picture = std::move(traced); });
            showProgress(now, *rendering, rendering->isFinished() ? State::Finished : State::Tracing);
        }
    }

    void showProgress(Request const& now, reference::ProgressiveRender const& rendering, State state) {
        const reference::RenderProgress progress = rendering.progress();
        tell(now, [&] {
            status.state = state;
            status.samplesDone = progress.samplesDone, status.samplesTotal = progress.samplesTotal;
            status.relativeError = progress.relativeError;
        });
    }
};

ProgressiveReference::ProgressiveReference() : mImpl(std::make_unique<Impl>()) {}
ProgressiveReference::~ProgressiveReference() = default;

void ProgressiveReference::setScene(SceneLoader loader) {
    mImpl->change([&](Request& request) {
        request.loader = std::move(loader);
        ++request.sceneNumber;
    });
}

uint64_t ProgressiveReference::setView(reference::ReferenceView const& view,
                                       reference::ReferenceSettings const& settings) {
    uint64_t number = 0;
    mImpl->change([&](Request& request) {
        request.view = view;
        request.settings = settings;
        number = ++request.viewNumber;
    });
    return number;
}

void ProgressiveReference::stop() {
    mImpl->change([](Request& request) { request.isStopped = true; });
}

TracingStatus ProgressiveReference::status() const {
    const std::lock_guard lock(mImpl->mutex);
    return mImpl->status;
}

std::optional<TracedView> ProgressiveReference::takePicture() {
    const std::lock_guard lock(mImpl->mutex);
    return std::exchange(mImpl->picture, std::nullopt);
}

Image linearPicture(reference::ReferenceImage const& image) {
    Image picture{ .width = image.width, .height = image.height, .format = Format::RGBA16F };
    picture.pixels.resize(8 * image.color.size());
    for (size_t i = 0; i < image.color.size(); ++i) {
        float3 const& color = image.color[i];
        const uint16_t halves[4] = { halfFromFloat(color.x), halfFromFloat(color.y), halfFromFloat(color.z),
                                     halfFromFloat(1) };
        std::memcpy(&picture.pixels[8 * i], halves, sizeof halves);
    }
    return picture;
}

Image displayPicture(reference::ReferenceImage const& image, DisplayTransform const& display) {
    return { .width = image.width, .height = image.height, .pixels = reference::displayPixels(image, display) };
}

} // namespace filament_core::view
