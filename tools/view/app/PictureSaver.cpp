// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/PictureSaver.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace filament_core::view {

void PictureSaver::read(Stage& stage, Format format, PictureFrame frame, std::function<void(Image)> then) {
    Engine& engine = stage.engine();
    Pending pending{ .then = std::move(then) };
    pending.chain = engine.own(engine.create(
            SwapChainDesc{ .size = stage.view().size, .imageCount = 1, .format = format, .name = "saved picture" }));
    if (frame == PictureFrame::New) {
        pending.renderer = std::make_unique<Renderer>(engine);
        pending.renderer->render(stage.scene(), stage.view(), pending.chain);
        pending.ticket = pending.renderer->readPixels(pending.chain);
    } else {
        stage.render(pending.chain);
        pending.ticket = stage.renderer().readPixels(pending.chain);
    }
    mPending.push_back(std::move(pending));
}

void PictureSaver::save(Stage& stage, std::filesystem::path file, PictureFormat format) {
    mFiles.push_back(file);
    const OutputSpace space = stage.view().display.outputSpace;
    read(stage, imageFormatOf(format), PictureFrame::Next, [this, file, space](Image image) {
        mFiles.erase(std::ranges::find(mFiles, file));
        if (image.pixels.empty())
            return mMessages.push_back(fmt::format("'{}' was not saved: the device drew no picture", file.string()));
        encode(file, std::move(image), space);
    });
}

void PictureSaver::encode(std::filesystem::path const& file, Image image, OutputSpace space) {
    auto shared = std::make_shared<Image>(std::move(image));
    mEncoding.push_back({ file, Background<std::string>([file, space, shared] {
                              const Result<void> saved = savePicture(file, *shared, space);
                              return saved ? fmt::format("saved {}", file.string()) : saved.error().message;
                          }) });
}

bool PictureSaver::isWriting(std::filesystem::path const& file) const {
    return std::ranges::find(mFiles, file) != mFiles.end() ||
           std::ranges::find(mEncoding, file, &Encoding::file) != mEncoding.end();
}

std::vector<std::string> PictureSaver::poll(Stage& stage) {
    while (!mPending.empty()) {
        Pending& first = mPending.front();
        Renderer& renderer = first.renderer ? *first.renderer : stage.renderer();
        std::optional<Image> image = first.ticket ? renderer.takePixels(first.ticket) : Image{};
        if (!image) break;
        const Pending done = std::move(first);
        mPending.pop_front();
        done.then(std::move(*image));
    }
    while (!mEncoding.empty() && mEncoding.front().line.isFinished()) {
        mMessages.push_back(mEncoding.front().line.take());
        mEncoding.pop_front();
    }
    return std::exchange(mMessages, {});
}

void PictureSaver::close() {
    for (std::filesystem::path const& file : mFiles)
        mMessages.push_back(fmt::format("'{}' was not saved: the engine that drew it ended", file.string()));
    mFiles.clear();
    mPending.clear();
}

} // namespace filament_core::view
