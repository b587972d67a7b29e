// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/CostMeasurement.h"

#include "base/Statistics.h"
#include "tools/view/compare/Comparison.h"
#include "tools/view/panels/OptionCosts.h"
#include "tools/view/stage/Stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace filament_core::view {
namespace {

constexpr uint32_t kAccumulated = 16; // frames, where a setting accumulates them

EngineOptions headless(EngineOptions options) {
    options.display = {};
    options.debug = {};
    options.traceJobs = false;
    return options;
}

QualitySetting mostExact(View const& view) {
    QualitySetting setting{ "the most exact setting", qualityPreset(QualityPreset::Reference), view.samples };
    setting.quality.antiAliasing = AntiAliasing::Taa;
    return setting;
}

/// What the two threads share.
class SharedPlot {
public:
    template <class Edit>
    void edit(Edit&& change) {
        const std::lock_guard lock(mMutex);
        change(mPlot);
        ++mVersion;
    }
    bool read(uint64_t& version, CostPlot& plot) const {
        const std::lock_guard lock(mMutex);
        if (version == mVersion) return false;
        version = mVersion;
        plot = mPlot;
        return true;
    }
    bool isBusy() const {
        const std::lock_guard lock(mMutex);
        return mPlot.isBusy();
    }

private:
    mutable std::mutex mMutex;
    CostPlot mPlot;
    uint64_t mVersion = 0;
};

/// On the thread of the measurement.
class CostRun {
public:
    CostRun(Document document, CostMeasurementOptions options, std::atomic<bool> const& isCancelled, SharedPlot& plot)
            : mDocument(std::move(document)), mOptions(std::move(options)), mIsCancelled(isCancelled), mPlot(plot),
              mSettings(mOptions.settings.empty() ? settingsToMeasure(mDocument.view) : mOptions.settings) {}

    void run() {
        const Result<void> done = measure();
        mPlot.edit([&](CostPlot& plot) {
            plot.state = !done                 ? CostPlot::State::Failed
                         : mIsCancelled.load() ? CostPlot::State::Cancelled
                                               : CostPlot::State::Finished;
            if (!done) plot.error = done.error().message;
            plot.doing.clear();
        });
    }

private:
    Result<void> measure() {
        if (Result<void> opened = open(); !opened || mIsCancelled) return opened;
        if (Result<void> known = findReference(); !known || mIsCancelled) return known;
        mTimes.resize(mSettings.size());
        for (uint32_t round = 0; round < mOptions.rounds && !mIsCancelled; ++round)
            if (Result<void> done = measureRound(round); !done) return done;
        return {};
    }

    /// The engine with the document's files.
    Result<void> open() {
        note("loading");
        auto stage = Stage::create(
                { .engine = headless(mOptions.engine), .renderer = { .passTimers = true }, .watchesFiles = false });
        if (!stage) return stage.error();
        mStage = std::move(*stage);
        mStage->apply(mDocument);
        mStage->finishLoading([this] { return mIsCancelled.load(); });
        if (mIsCancelled) return {};
        if (Result<void> shown = checkShown(); !shown) return shown;
        Engine& engine = mStage->engine();
        mChain = engine.own(engine.create(
                SwapChainDesc{ .size = mDocument.view.size, .imageCount = 1, .name = "measured pictures" }));
        mPlot.edit([&](CostPlot& plot) {
            plot.device = fmt::format("{}: {}", toString(engine.device().backend), engine.device().device);
            for (QualitySetting const& setting : mSettings) plot.points.push_back({ .setting = setting });
            plot.total = static_cast<uint32_t>(mSettings.size()) * mOptions.rounds;
        });
        return {};
    }

    Result<void> checkShown() {
        std::filesystem::path const& file = mDocument.model.file;
        if (file.empty() || mStage->shownFile() == file) return {};
        const std::vector<std::string> messages = mStage->takeMessages();
        return Error{ ErrorCode::NotFound,
                      messages.empty() ? fmt::format("'{}' was not loaded", file.string()) : messages.front() };
    }

    Result<void> findReference() {
        std::optional<CostReference>& given = mOptions.reference;
        const uint2 size = mDocument.view.size;
        if (!given || uint2(given->image.width, given->image.height) != size) {
            note("the reference");
            const QualitySetting exact = mostExact(mDocument.view);
            Result<Image> image = draw(exact);
            if (!image) return image.error();
            given = CostReference{ std::move(*image), exact.name };
        }
        mPlot.edit([&](CostPlot& plot) { plot.reference = given->name; });
        return {};
    }

    /// In turns: each round begins with another setting. The first one compares the pictures, too.
    Result<void> measureRound(uint32_t round) {
        for (size_t turn = 0; turn < mSettings.size() && !mIsCancelled; ++turn) {
            const size_t i = (turn + round) % mSettings.size();
            note(fmt::format("{}, round {} of {}", mSettings[i].name, round + 1, mOptions.rounds));
            if (Result<void> compared = round == 0 ? compare(i) : Result<void>(); !compared) return compared;
            if (mIsCancelled) break;
            const Result<double> milliseconds = time(mSettings[i]);
            if (!milliseconds) return milliseconds.error();
            mTimes[i].push_back(*milliseconds);
            mPlot.edit([&](CostPlot& plot) {
                plot.points[i].milliseconds = median(mTimes[i]);
                ++plot.points[i].rounds;
                ++plot.done;
            });
        }
        return {};
    }

    Result<void> compare(size_t i) {
        const Result<Image> image = draw(mSettings[i]);
        if (!image) return image.error();
        if (mIsCancelled) return {}; // perhaps not all of its frames
        const Result<double> error = rmsError(mOptions.reference->image, *image);
        if (!error) return error.error();
        mPlot.edit([&](CostPlot& plot) { plot.points[i].error = *error; });
        return {};
    }

    void apply(QualitySetting const& setting) {
        applySetting(mDocument.view, setting);
        mStage->apply(mDocument);
    }

    /// Frame by frame, so that a cancellation waits for one of them.
    Result<Image> draw(QualitySetting const& setting) {
        apply(setting);
        mStage->forgetFrames();
        const uint32_t frames = setting.quality.antiAliasing == AntiAliasing::Taa ? kAccumulated : 1;
        for (uint32_t frame = 0; frame < frames && (frame == 0 || !mIsCancelled); ++frame) {
            mStage->render(mChain);
            mStage->engine().waitIdle();
        }
        Result<Image> image = mStage->renderer().waitPixels(mStage->renderer().readPixels(mChain));
        const std::vector<std::string> errors = mStage->engine().takeErrors();
        if (!image || errors.empty()) return image;
        return Error{ ErrorCode::DeviceUnavailable, errors.front() };
    }

    Result<double> time(QualitySetting const& setting) {
        apply(setting);
        for (uint32_t frame = 0; frame < 2; ++frame) {
            mStage->render(mChain);
            mStage->engine().waitIdle();
        }
        const std::vector<FrameTimings> timings = mStage->renderer().takeTimings();
        if (timings.empty()) return fail(ErrorCode::Unsupported, "{}: its frames have no times", setting.name);
        const bool hasTimers = timings.back().gpuMilliseconds > 0;
        mPlot.edit([&](CostPlot& plot) { plot.clock = hasTimers ? "device time" : "time of the driver thread"; });
        return hasTimers ? timings.back().gpuMilliseconds : timings.back().replayMilliseconds;
    }

    void note(std::string doing) {
        mPlot.edit([&](CostPlot& plot) { plot.doing = std::move(doing); });
    }

    Document mDocument;
    CostMeasurementOptions mOptions;
    std::atomic<bool> const& mIsCancelled;
    SharedPlot& mPlot;
    const std::vector<QualitySetting> mSettings;
    std::vector<std::vector<double>> mTimes; ///< of each setting, by round
    std::unique_ptr<Stage> mStage;
    Owned<SwapChain> mChain;
};

} // namespace

struct CostMeasurement::Impl {
    SharedPlot plot;
    std::atomic<bool> isCancelled = false;
    uint64_t seen = 0;
    std::thread thread;

    void join() {
        if (thread.joinable()) thread.join();
    }
};

CostMeasurement::CostMeasurement() : mImpl(std::make_unique<Impl>()) {}
CostMeasurement::~CostMeasurement() {
    cancel();
    mImpl->join();
}

void CostMeasurement::start(Document document, CostMeasurementOptions options) {
    if (isBusy()) return;
    mImpl->join(); // it has ended
    mImpl->isCancelled = false;
    options.rounds = std::clamp(options.rounds, 1u, 1000u);
    mImpl->plot.edit([](CostPlot& plot) { plot = { .state = CostPlot::State::Measuring }; });
    mImpl->thread = std::thread([this, document = std::move(document), options = std::move(options)]() mutable {
        CostRun(std::move(document), std::move(options), mImpl->isCancelled, mImpl->plot).run();
    });
}

void CostMeasurement::cancel() { mImpl->isCancelled = true; }
bool CostMeasurement::isBusy() const { return mImpl->plot.isBusy(); }
bool CostMeasurement::poll(CostPlot& plot) { return mImpl->plot.read(mImpl->seen, plot); }

} // namespace filament_core::view
