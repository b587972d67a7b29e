// SPDX-License-Identifier: Apache-2.0
// Pictures of the largest size that a device allows, and larger ones: drawn, or refused in one line that names the
// size.
#include <filament_core/filament_core.h>

#include <gtest/gtest.h>

#include <cstring>
#include <optional>

namespace filament_core::hard {
namespace {

class Limits : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        auto engine = Engine::create({ .backend = GetParam(), .workers = 0 });
        ASSERT_TRUE(engine) << engine.error().message;
        mEngine.emplace(std::move(*engine));
    }
    std::optional<Engine> mEngine;
};

INSTANTIATE_TEST_SUITE_P(BothApis, Limits, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& test) { return std::string(toString(test.param)); });

/// The engine's errors for an image of this size, or nothing if it is drawn.
std::vector<std::string> drawEmpty(Engine& engine, uint2 size, bool& hasPixels) {
    Scene scene(engine);
    Renderer renderer(engine);
    const View view{ .size = size, .display = { .toneMapper = ToneMapper::Linear }, .clearColor = float4(1) };
    const Result<Image> image = renderer.renderToImage(scene, view);
    hasPixels = image.ok();
    if (image.ok()) {
        uint32_t last = 0;
        EXPECT_EQ(image->pixels.size(), size_t{ 4 } * size.x * size.y);
        if (image->pixels.empty()) return engine.takeErrors();
        std::memcpy(&last, image->pixels.data() + image->pixels.size() - 4, 4);
        EXPECT_EQ(last, 0xFFFFFFFFu) << "the last pixel is drawn";
    }
    engine.waitIdle();
    return engine.takeErrors();
}

TEST_P(Limits, EightThousandPixelsSquaredAreDrawnOrRefused) {
    bool hasPixels = false;
    const std::vector<std::string> errors = drawEmpty(*mEngine, { 8192, 8192 }, hasPixels);
    EXPECT_NE(hasPixels, !errors.empty()) << (errors.empty() ? "neither pixels nor a reason" : errors[0]);
}

TEST_P(Limits, WhatIsLargerThanTheDeviceAllowsIsRefusedByName) {
    const uint32_t beyond = mEngine->device().maxTextureSize + 1;
    for (uint2 size : { uint2(beyond, 1), uint2(1, beyond), uint2(beyond, beyond), uint2(0x7FFFFFFF, 2) }) {
        bool hasPixels = true;
        const std::vector<std::string> errors = drawEmpty(*mEngine, size, hasPixels);
        EXPECT_FALSE(hasPixels) << size.x << " x " << size.y;
        ASSERT_FALSE(errors.empty()) << size.x << " x " << size.y;
        EXPECT_NE(errors[0].find("renderToImage"), std::string::npos) << errors[0];
        EXPECT_NE(errors[0].find(std::to_string(size.x)), std::string::npos) << errors[0];
        EXPECT_LE(errors.size(), 8u) << "one cause, few lines: " << errors.back();
    }
}

TEST_P(Limits, APictureIsDrawnAfterOneThatWasRefused) {
    bool hasPixels = true;
    (void)drawEmpty(*mEngine, { mEngine->device().maxTextureSize + 1, 1 }, hasPixels);
    const std::vector<std::string> errors = drawEmpty(*mEngine, { 64, 64 }, hasPixels);
    EXPECT_TRUE(hasPixels);
    EXPECT_TRUE(errors.empty()) << errors[0];
}

} // namespace
} // namespace filament_core::hard
