// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/ApiPicture.h"

#include "tools/view/app/Defects.h"

#include <fmt/format.h>

namespace filament_core::view {

ApiPicture::ApiPicture(std::unique_ptr<Stage> stage) : mStage(std::move(stage)) {
    DeviceDescription const& device = mStage->engine().device();
    mName = fmt::format("{}: {}", toString(device.backend), device.device);
}

Result<std::unique_ptr<PictureSource>> ApiPicture::create(Backend backend, EngineOptions const& options,
                                                          std::string_view defect) {
    EngineOptions headless = options;
    headless.backend = backend;
    headless.display = {};
    headless.traceJobs = false;
    headless.debug = { .capture = injected(defect) };
    auto stage = Stage::create({ .engine = headless });
    if (!stage) return stage.error();
    return std::unique_ptr<PictureSource>(new ApiPicture(std::move(*stage)));
}

void ApiPicture::follow(Document const& document, uint64_t number) {
    mStage->apply(document);
    mStage->poll();
    take();
    const bool isLoading = mStage->progress().isLoading;
    const bool hasLoaded = std::exchange(mWasLoading, isLoading) && !isLoading;
    if (hasLoaded) mPicture.reset(); // it shows what was there before
    const bool isShown = mPicture && mPicture->number == number;
    if (mPending || isLoading || isShown) return;
    if (mSize != document.view.size) {
        mSize = document.view.size;
        mChain = mStage->engine().own(
                mStage->engine().create(SwapChainDesc{ .size = mSize, .imageCount = 1, .name = "other picture" }));
    }
    mStage->forgetFrames(); // as the image that it is compared with
    mStage->render(mChain);
    mPending = mStage->renderer().readPixels(mChain);
    mPendingNumber = number;
}

void ApiPicture::take() {
    if (!mPending) return;
    std::optional<Image> image = mStage->renderer().takePixels(mPending);
    if (!image) return;
    mPending = {};
    if (!image->pixels.empty()) mPicture = NumberedPicture{ std::move(*image), mPendingNumber };
}

} // namespace filament_core::view
