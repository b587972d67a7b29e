// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/ComparedPictures.h"

#include "toolkit/pictures/Pixels.h"
#include "tools/view/app/ApiPicture.h"
#include "tools/view/app/Defects.h"
#include "tools/view/app/TracedPicture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

constexpr float kGrabPixels = 8; ///< beside the line of a wipe
constexpr ImU32 kLineColor = IM_COL32(255, 158, 26, 255);
const ImVec4 kInjectedColor{ 1, 0.45f, 0.3f, 1 };

/// Of a map whose largest difference, in 1/255, is to be white; at least 16 times.
float amplificationFor(uint32_t largestDifference) {
    return std::max(16.0f, 255.0f / static_cast<float>(std::max(largestDifference, 1u)));
}

} // namespace

const char* toString(CompareMode mode) {
    switch (mode) {
    case CompareMode::Off:
        return "off";
    case CompareMode::Wipe:
        return "wipe";
    case CompareMode::Difference:
        return "difference";
    case CompareMode::Flip:
        return "FLIP";
    }
    return "";
}

CompareMode nextMode(CompareMode mode) {
    return mode == CompareMode::Flip ? CompareMode::Off : static_cast<CompareMode>(static_cast<int>(mode) + 1);
}

/// The path tracer ends when the scene that it may be loading is there: on another thread. An engine ends on its own.
void ComparedPictures::endOther() {
    if (mOther && mOpenedWith == CompareWith::PathTracer)
        mAbandoned.add(Background<bool>([other = std::shared_ptr<PictureSource>(std::move(mOther))]() mutable {
            other.reset();
            return true;
        }));
    mOther.reset();
}

bool ComparedPictures::openSource(EngineOptions const& options) {
    const std::string wanted = with == CompareWith::OtherApi ? defect : std::string{};
    if (mOther && mOpenedWith == with && mOpenedDefect == wanted) return true;
    endOther();
    mResult.reset();
    mAbandoned.add(mComparing);
    mOpenedWith = with;
    mOpenedDefect = wanted;
    if (with == CompareWith::PathTracer) {
        mOther = std::make_unique<TracedPicture>();
        return true;
    }
    auto other = ApiPicture::create(otherThan(options.backend), options, wanted);
    if (other)
        mOther = std::move(*other);
    else
        mMessages.push_back(other.error().message);
    return other.ok();
}

bool ComparedPictures::follow(Document const& document, Stage& stage, SwapChain chain, uint2 offset,
                              EngineOptions const& options) {
    if (mode == CompareMode::Off) return false;
    if (!openSource(options)) {
        mode = CompareMode::Off;
        return true;
    }
    if (mNumber == 0 || !(document == mDocument)) {
        mDocument = document;
        ++mNumber;
    }
    mOther->follow(document, mNumber);
    for (std::string& message : mOther->takeMessages()) mMessages.push_back(std::move(message));
    readOwn(stage, chain, offset);
    const bool hasNews = takeCompared();
    compareNewest();
    return hasNews;
}

Image const* ComparedPictures::tracedPicture() const {
    if (mode == CompareMode::Off || !mOther || mOpenedWith != CompareWith::PathTracer) return nullptr;
    std::optional<NumberedPicture> const& picture = mOther->picture();
    return picture && picture->number == mNumber ? &picture->image : nullptr;
}

/// The scene alone: the interface is drawn over it later.
void ComparedPictures::readOwn(Stage& stage, SwapChain chain, uint2 offset) {
    if (mPending) {
        std::optional<Image> image = stage.renderer().takePixels(mPending);
        if (!image) return;
        mPending = {};
        if (!image->pixels.empty()) {
            mOwn = mPendingOwn;
            mOwn->window = std::make_shared<const Image>(std::move(*image));
        }
    }
    if (stage.progress().isLoading) return mOwn.reset(); // it shows what was there before
    if (mOwn && mOwn->number == mNumber) return;
    mPending = stage.renderer().readPixels(chain);
    mPendingOwn = { .offset = offset, .size = mDocument.view.size, .number = mNumber };
}

/// Starts with the newest pair that shows one document, unless it has been compared.
void ComparedPictures::compareNewest() {
    mAbandoned.removeFinished();
    std::optional<NumberedPicture> const& other = mOther->picture();
    if (mComparing || !mOwn || !other || mOwn->number != other->number) return;
    if (mResult && mResultNumber == mOwn->number && mResultVersion == other->version && mResultMode == mode) return;
    mComparingNumber = mOwn->number;
    mComparingVersion = other->version;
    mComparingIsFinal = other->isFinal;
    mComparingMode = mode;
    mComparing.emplace([own = *mOwn, image = std::make_shared<const Image>(other->image), how = mode] {
        return compareAll(own, *image, how);
    });
}

bool ComparedPictures::takeCompared() {
    std::optional<Compared> compared = takeFinished(mComparing);
    if (compared && !compared->result) mOwn.reset(); // it is read again
    if (!compared || !compared->result) return false;
    mResult = std::move(compared->result);
    mResultNumber = mComparingNumber;
    mResultVersion = mComparingVersion;
    mIsFinal = mComparingIsFinal;
    mResultMode = mComparingMode;
    if (mResultMode == mode) mOverlay = std::move(compared->overlay);
    return true;
}

/// On another thread: a FLIP map takes 1.5 s a megapixel.
ComparedPictures::Compared ComparedPictures::compareAll(OwnPicture const& own, Image const& other, CompareMode mode) {
    const std::optional<Image> picture = partOf(*own.window, own.offset, own.size);
    if (!picture) return {};
    const Result<ImageComparison> result = compareImages(*picture, other);
    if (!result) return {};
    Compared compared{ .result = *result };
    if (mode == CompareMode::Wipe) compared.overlay = other;
    if (mode == CompareMode::Difference)
        if (Result<Image> map = differenceMap(*picture, other, amplificationFor(result->maxDifference)); map)
            compared.overlay = std::move(*map);
    if (mode == CompareMode::Flip)
        if (Result<FlipMap> map = flipMap(*picture, other); map) compared.overlay = std::move(map->image);
    return compared;
}

void ComparedPictures::upload(UiRenderer& ui, Engine& engine) {
    if (!mOverlay) return;
    const uint2 size(mOverlay->width, mOverlay->height);
    if (!mTexture.get() || size != mTextureSize) {
        if (mTexture.get()) ui.remove(mTextureId);
        mTexture = engine.own(engine.create(
                TextureDesc{ .width = size.x, .height = size.y, .pixels = mOverlay->pixels, .name = "compared" }));
        mTextureId = ui.add(mTexture);
        mTextureSize = size;
    } else {
        engine.update(mTexture, TextureUpdate{ .pixels = mOverlay->pixels });
    }
    mOverlay.reset();
}

void ComparedPictures::draw(UiRenderer& ui, Engine& engine, uint2 offset, uint2 size) {
    if (mode == CompareMode::Off) return;
    upload(ui, engine);
    if (mTexture.get() && mTextureSize == size) {
        const float2 begin(offset), end(offset + size);
        const float left = mode == CompareMode::Wipe ? std::round(wipePosition * static_cast<float>(size.x)) : 0;
        ImGui::GetBackgroundDrawList()->AddImage(mTextureId, { begin.x + left, begin.y }, { end.x, end.y },
                                                 { left / static_cast<float>(size.x), 0 }, { 1, 1 });
    }
    if (mode == CompareMode::Wipe) drawWipe(offset, size);
    drawNumber(offset, size);
}

bool ComparedPictures::handle(InputEvent const& event, uint2 size) {
    if (mode != CompareMode::Wipe) return mIsDragging = false;
    const float width = static_cast<float>(size.x);
    if (auto const* button = std::get_if<MouseButtonEvent>(&event); button && button->button == MouseButton::Left) {
        const bool isNear = std::abs(mPointer - wipePosition * width) < kGrabPixels;
        return std::exchange(mIsDragging, button->isDown && isNear) || mIsDragging;
    }
    auto const* move = std::get_if<MouseMoveEvent>(&event);
    if (move) mPointer = move->pixel.x;
    if (move && mIsDragging) wipePosition = std::clamp(mPointer / width, 0.0f, 1.0f);
    return move && mIsDragging;
}

void ComparedPictures::drawWipe(uint2 offset, uint2 size) const {
    const float2 begin(offset), end(offset + size);
    const float x = begin.x + std::round(wipePosition * static_cast<float>(size.x));
    ImGui::GetBackgroundDrawList()->AddRectFilled({ x - 1, begin.y }, { x + 1, end.y }, kLineColor);
}

void ComparedPictures::drawNumber(uint2 offset, uint2 size) const {
    const float2 begin(offset);
    ImGui::SetNextWindowPos({ begin.x + static_cast<float>(size.x) / 2, begin.y + 10 }, ImGuiCond_Always, { 0.5f, 0 });
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                        ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing;
    if (ImGui::Begin("compared", nullptr, kFlags)) {
        const bool isAmplified = mode == CompareMode::Difference && mResult;
        const std::string factor = isAmplified ? fmt::format(" x{:.0f}", amplificationFor(mResult->maxDifference)) : "";
        ImGui::Text("%s%s | %s", toString(mode), factor.c_str(), mOther ? mOther->name().c_str() : "starting");
        if (isDefective()) ImGui::TextColored(kInjectedColor, "DEFECT INJECTED: %s", whatOf(mOpenedDefect).c_str());
        if (mResult && mResultNumber == mNumber)
            ImGui::Text("%s of the pixels are identical", mResult->percentage().c_str());
        else
            ImGui::TextUnformatted("drawing ...");
        if (mResult && mResultNumber == mNumber && mResult->first) {
            ImGui::Text("first difference at %u, %u; at most %u / 255", mResult->first->x, mResult->first->y,
                        mResult->maxDifference);
        }
    }
    ImGui::End();
}

void ComparedPictures::close(UiRenderer* ui) {
    if (ui && mTexture.get()) ui->remove(mTextureId);
    mTexture.reset();
    mTextureSize = uint2(0);
    endOther();
    mPending = {};
    mOwn.reset();
    mResult.reset();
    mOverlay.reset();
    mAbandoned.add(mComparing);
    mNumber = 0;
}

} // namespace filament_core::view
