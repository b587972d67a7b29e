// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/Instruments.h"

#include "tools/view/app/ApiPicture.h"
#include "tools/view/app/Defects.h"

#include <filament_core/JobTimeline.h>

namespace filament_core::view {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(250);
constexpr double kRecordedSeconds = 5; // before the end of the newest frame

/// Whether a measurement of one document holds for the other: all but what was measured is the same.
bool hasSamePicture(Document const& measured, Document const& now) {
    Document other = measured;
    other.view.quality = now.view.quality;
    other.view.samples = now.view.samples;
    other.bookmarks = now.bookmarks;
    other.paths = now.paths;
    return other == now;
}

} // namespace

bool Instruments::pollJobs(Panels& panels, Stage& stage) {
    if (auto jobs = takeFinished(mReading)) {
        panels.inputs.jobs = std::move(*jobs);
        mIsOwnFrame = true;
        return true;
    }
    if (mReading || !mWantsReading || Clock::now() < mNextReading) return false;
    mWantsReading = false;
    mNextReading = Clock::now() + kInterval;
    mReading.emplace([&engine = stage.engine()] { return layOutJobs(jobTimeline(engine, kRecordedSeconds)); });
    return false;
}

bool Instruments::poll(Panels& panels, Stage& stage) {
    const bool hasJobs = pollJobs(panels, stage);
    if (Clock::now() < mNextCosts || !mCosts.poll(panels.inputs.costs)) return hasJobs;
    mNextCosts = Clock::now() + kInterval;
    return true;
}

void Instruments::followDefect(Panels& panels, Backend own, ComparedPictures& compared) {
    if (mOfferedTo != own) { // the other API has become this one
        mOfferedTo = own;
        panels.inputs.defects = defectsFor(otherThan(own));
        panels.state.injectedDefect.clear();
    }
    compared.defect = panels.state.injectedDefect;
    if (std::exchange(mLastDefect, compared.defect) == compared.defect || compared.defect.empty()) return;
    compared.with = CompareWith::OtherApi; // a new one is to be seen
    if (compared.mode == CompareMode::Off) compared.mode = CompareMode::Difference;
}

void Instruments::beforePanels(Panels& panels, Document const& document, Stage& stage, ComparedPictures& compared) {
    followDefect(panels, stage.engine().device().backend, compared);
    PanelInputs& inputs = panels.inputs;
    const bool isOn = compared.mode != CompareMode::Off;
    inputs.compareMode = isOn ? toString(compared.mode) : "";
    inputs.comparedWith = isOn ? compared.otherName() : "";
    inputs.identical = isOn && compared.result() ? compared.result()->percentage() : "";
    inputs.isDefectActive = isOn && compared.isDefective();
    inputs.isCostOfOther = mMeasured && !hasSamePicture(*mMeasured, document);
}

void Instruments::afterFrame(Panels& panels, Document const& document, ComparedPictures const& compared,
                             EngineOptions const& options) {
    PanelRequests& requests = panels.requests;
    const bool isOwnFrame = std::exchange(mIsOwnFrame, false);
    if (std::exchange(requests.readsJobs, false) && options.traceJobs && !isOwnFrame) mWantsReading = true;
    if (std::exchange(requests.cancelsCosts, false)) mCosts.cancel();
    if (!std::exchange(requests.measuresCosts, false) || mCosts.isBusy()) return;
    CostMeasurementOptions measurement{ .engine = options };
    if (Image const* traced = compared.tracedPicture()) measurement.reference = { *traced, compared.otherName() };
    mMeasured = document;
    mCosts.start(document, std::move(measurement));
}

void Instruments::closeEngine(Panels& panels) {
    if (mReading) mReading->wait();
    mReading.reset();
    mWantsReading = false;
    panels.inputs.jobs = {};
    panels.state.jobWindow.reset();
}

} // namespace filament_core::view
