// SPDX-License-Identifier: Apache-2.0
/// WindowPicture: draws an image that looks different from every side and in every frame, and presents it.
///   Out     pixels(): the image drawn last, three bytes a pixel, as displays have them.
#pragma once

#include <filament_core/filament_core.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace filament_core::test {

class WindowPicture {
public:
    explicit WindowPicture(Engine& engine) : mRenderer(engine), mScene(engine) {}

    void draw(SwapChain chain, uint2 size, uint32_t number) {
        mLines.clear();
        mLines.screenText({ 3, 2 }, std::to_string(number), { .color = { 1, 0.5f, 0.25f, 1 }, .pixels = 2 });
        mLines.screenLine({ 0, static_cast<float>(size.y) }, { static_cast<float>(size.x), 0 }, { .widthPixels = 3 });
        mLines.screenBox({ 1, 1 }, float2(size) - 1.0f, { .color = { 0.2f, 0.9f, 0.1f, 1 } });
        View view{ .size = size };
        view.clearColor = { 0.02f * static_cast<float>(number % 40), 0.1f, 0.3f, 1 };
        view.debugDraw = &mLines;
        mRenderer.render(mScene, view, chain);
        mRenderer.present(chain);
    }

    /// Of the image drawn last, as the display has them.
    std::vector<uint8_t> pixels(SwapChain chain) {
        auto image = mRenderer.waitPixels(mRenderer.readPixels(chain));
        std::vector<uint8_t> bytes;
        if (!image) ADD_FAILURE() << image.error().message;
        if (!image) return bytes;
        for (size_t i = 0; i + 3 < image->pixels.size(); i += 4)
            for (size_t c = 0; c < 3; ++c) bytes.push_back(static_cast<uint8_t>(image->pixels[i + c]));
        return bytes;
    }
    Renderer& renderer() { return mRenderer; }

private:
    Renderer mRenderer;
    Scene mScene;
    DebugDraw mLines;
};

} // namespace filament_core::test
