// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/PixelInspector.h"

#include "tools/view/app/ApiPicture.h"

#include <fmt/format.h>

namespace filament_core::view {

// ---- one API

InspectedEngine::InspectedEngine(std::unique_ptr<Stage> stage, std::shared_ptr<backend::FrameCapture> capture)
        : mCapture(std::move(capture)), mStage(std::move(stage)) {
    DeviceDescription const& device = mStage->engine().device();
    mName = fmt::format("{}: {}", toString(device.backend), device.device);
}

Result<std::unique_ptr<InspectedEngine>> InspectedEngine::create(Backend backend, EngineOptions const& options) {
    EngineOptions headless = options;
    headless.backend = backend;
    headless.display = {};
    headless.debug.capture = std::make_shared<backend::FrameCapture>();
    auto stage = Stage::create({ .engine = headless });
    if (!stage) return stage.error();
    return std::unique_ptr<InspectedEngine>(new InspectedEngine(std::move(*stage), headless.debug.capture));
}

bool InspectedEngine::isWaiting() const {
    return !mFrame || !mHasDocument || mPicture || mNormals || mPick || mNeedsNormals || (mExplains && !mExplained);
}

std::vector<std::string> InspectedEngine::takeMessages() {
    std::vector<std::string> messages = mStage->takeMessages();
    for (std::string& message : std::exchange(mMessages, {})) messages.push_back(std::move(message));
    return messages;
}

/// Frames of one engine one after the other: a request to look into a frame is for the next one that the device gets.
bool InspectedEngine::follow(Document const& document, uint2 pixel, bool explains) {
    mExplains = explains;
    if (!explains || mExplained != pixel) mExplained.reset();
    if (!explains && mFrame) mFrame->explanation.reset();
    mStage->apply(document);
    mStage->poll();
    const bool isLoading = mStage->progress().isLoading;
    if (std::exchange(mWasLoading, isLoading) && !isLoading) mHasDocument = false; // it shows what was there before
    bool isNew = takePicture();
    isNew |= takeNormals();
    isNew |= takePick();
    if (mPicture || mNormals || mPick || isLoading) return isNew;
    if (mNeedsNormals) {
        startNormals();
    } else if (!mHasDocument || !(document == mDocument)) {
        mDocument = document;
        mHasDocument = true;
        startPicture();
    } else if (mPicked != pixel) {
        mPicking = pixel;
        mPick = mStage->renderer().pick(mStage->scene(), mStage->view(), pixel, PickAim::Anything);
    } else if (explains && !mExplained) {
        return explain(pixel);
    }
    return isNew;
}

bool InspectedEngine::explain(uint2 pixel) {
    View view = mStage->view();
    view.debugView = DebugView::None;
    Result<PixelExplanation> explained = explainPixel(mStage->engine(), mStage->scene(), view, pixel);
    mExplained = pixel;
    if (explained && mFrame)
        mFrame->explanation = std::move(*explained);
    else if (!explained)
        mMessages.push_back(explained.error().message);
    return true;
}

void InspectedEngine::startPicture() {
    Engine& engine = mStage->engine();
    if (mSize != mDocument.view.size) {
        mSize = mDocument.view.size;
        mChain = engine.own(engine.create(SwapChainDesc{ .size = mSize, .imageCount = 1, .name = "displayed" }));
        mLightChain = engine.own(engine.create(
                SwapChainDesc{ .size = mSize, .imageCount = 1, .format = Format::RGBA16F, .name = "normals" }));
    }
    mStage->forgetFrames(); // as the other engine draws it
    mCapture->arm({});
    mStage->render(mChain);
    mPicture = mStage->renderer().readPixels(mChain);
}

bool InspectedEngine::takePicture() {
    if (!mPicture) return false;
    std::optional<Image> picture = mStage->renderer().takePixels(mPicture);
    if (!picture) return false;
    mPicture = {};
    std::optional<backend::CapturedFrame> inside = mCapture->take(); // its answers came before those of the image
    if (!inside || picture->pixels.empty()) return false;
    mNext = InspectedFrame{ .inside = std::move(*inside), .picture = std::move(*picture), .size = mSize };
    dropUnseen(*mNext);
    mNeedsNormals = true;
    return false;
}

void InspectedEngine::startNormals() {
    mNeedsNormals = false;
    View view = mStage->view();
    view.debugView = DebugView::Normals;
    mStage->renderer().render(mStage->scene(), view, mLightChain);
    mNormals = mStage->renderer().readPixels(mLightChain);
}

bool InspectedEngine::takeNormals() {
    if (!mNormals) return false;
    std::optional<Image> normals = mStage->renderer().takePixels(mNormals);
    if (!normals) return false;
    mNormals = {};
    if (!mNext) return false;
    mNext->normals = std::move(*normals);
    mFrame = std::move(*mNext);
    mNext.reset();
    mPicked.reset();
    mExplained.reset();
    return true;
}

bool InspectedEngine::takePick() {
    if (!mPick) return false;
    const std::optional<PickHit> hit = mStage->renderer().takePick(mPick);
    if (!hit) return false;
    mPick = {};
    mPicked = mPicking;
    if (mFrame) mFrame->surface = surfaceOf(*hit);
    return true;
}

PixelSurface InspectedEngine::surfaceOf(PickHit const& hit) const {
    if (!hit) return {};
    const std::optional<uint32_t> node = hit.node ? mStage->indexOf(hit.node) : std::nullopt;
    const std::string name = hit.node ? mStage->scene().name(hit.node) : std::string();
    return { .object = fmt::format("node {}{}, primitive {}", node ? fmt::to_string(*node) : "?",
                                   name.empty() ? std::string() : fmt::format(" '{}'", name), hit.primitive),
             .distanceMeters = hit.distanceMeters,
             .positionWorld = hit.positionWorld };
}

// ---- both

void PixelInspector::toggleLock() { mLocked = mLocked ? std::nullopt : std::optional(mPointer); }

void PixelInspector::open(EngineOptions const& options) {
    if (mIsOpen && mOwn == options.backend) return;
    close();
    mIsOpen = true;
    mOwn = options.backend;
    for (size_t i = 0; i < 2; ++i) {
        auto engine = InspectedEngine::create(i == 0 ? mOwn : otherThan(mOwn), options);
        if (engine)
            mEngines[i] = std::move(*engine);
        else
            mMessages.push_back(engine.error().message);
    }
}

void PixelInspector::close() {
    for (auto& engine : mEngines) engine.reset();
    mIsOpen = false;
    mReport = {};
}

bool PixelInspector::isWaiting() const {
    for (auto const& engine : mEngines)
        if (engine && engine->isWaiting()) return true;
    return false;
}

bool PixelInspector::follow(bool isOn, Document const& document, EngineOptions const& options) {
    if (!isOn) {
        if (mIsOpen) close();
        return false;
    }
    open(options);
    const uint2 pixel = min(mLocked.value_or(mPointer), max(document.view.size, uint2(1)) - 1u);
    bool isNew = mShown != pixel || mReport.isLocked != mLocked.has_value() || mReport.isExplained != mExplains;
    mShown = pixel;
    for (auto const& engine : mEngines) {
        if (!engine) continue;
        isNew |= engine->follow(document, pixel, mExplains && mLocked);
        for (std::string& message : engine->takeMessages()) mMessages.push_back(std::move(message));
    }
    if (isNew || mReport.isComplete == isWaiting()) makeReport();
    return isNew;
}

void PixelInspector::makeReport() {
    std::array<InspectedFrame const*, 2> frames{};
    for (size_t i = 0; i < 2; ++i) {
        if (!mEngines[i]) continue;
        InspectedFrame const* frame = mEngines[i]->frame();
        if (frame && all(lessThan(mShown, frame->size))) frames[i] = frame;
        mReport.engines[i] = mEngines[i]->name();
    }
    mReport.pixel = mShown;
    mReport.isLocked = mLocked.has_value();
    mReport.isExplained = mExplains;
    mReport.isComplete = frames[0] && frames[1] && !isWaiting();
    mReport.rows = pixelRows(mShown, frames[0], frames[1]);
    mReport.unseen = unseenAttachments(frames[0], frames[1]);
}

} // namespace filament_core::view
