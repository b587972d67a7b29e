// SPDX-License-Identifier: Apache-2.0
/// Shared by the image tests: an engine on a named backend, images as floats, and clear skip messages.
#pragma once

#include "base/math/Half.h"
#include "toolkit/paths/Paths.h"

#include <filament_core/filament_core.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::test {

inline constexpr Backend kBothApis[] = { Backend::Vulkan, Backend::Gles };

/// An engine with validation on, or nothing with a test failure: both APIs are part of the promise.
inline std::optional<Engine> makeEngine(Backend backend, int workers = 1) {
    auto engine = Engine::create({ .backend = backend, .workers = workers, .validation = true });
    if (!engine) {
        ADD_FAILURE() << toString(backend) << ": " << engine.error().message;
        return std::nullopt;
    }
    return std::optional<Engine>(std::move(*engine));
}

/// Calls `draw` with a stage of each API, and returns its images, which have the same bits.
template <class Stage>
std::vector<Image> sameOnBothApis(std::function<std::vector<Image>(Stage&)> const& draw) {
    std::vector<std::vector<Image>> all;
    for (const Backend backend : kBothApis) {
        Stage stage(backend);
        all.push_back(draw(stage));
    }
    EXPECT_EQ(all[0].size(), all[1].size());
    for (size_t i = 0; i < std::min(all[0].size(), all[1].size()); ++i)
        EXPECT_EQ(all[0][i].pixels, all[1][i].pixels) << i;
    return std::move(all[0]);
}

/// Errors that the device or a validation layer reported; a test expects none.
inline void expectNoErrors(Engine& engine) {
    for (std::string const& error : engine.takeErrors())
        ADD_FAILURE() << toString(engine.device().backend) << ": " << error;
}

/// Renders one frame into scene-linear half floats: no tone mapping.
inline Image renderLinear(Engine& engine, Renderer& renderer, Scene const& scene, View const& view) {
    const Owned<SwapChain> target = engine.own(engine.create(
            SwapChainDesc{ .size = view.size, .imageCount = 1, .format = Format::RGBA16F, .name = "linear" }));
    renderer.render(scene, view, target);
    auto image = renderer.waitPixels(renderer.readPixels(target));
    if (!image) {
        ADD_FAILURE() << image.error().message;
        return {};
    }
    return std::move(*image);
}
/// The same with a renderer that has drawn nothing yet.
inline Image renderLinear(Engine& engine, Scene const& scene, View const& view) {
    Renderer renderer(engine);
    return renderLinear(engine, renderer, scene, view);
}

inline float4 halfPixel(Image const& image, uint32_t x, uint32_t y) {
    uint16_t bits[4];
    std::memcpy(bits, image.pixels.data() + (static_cast<size_t>(y) * image.width + x) * 8, sizeof(bits));
    return { floatFromHalf(bits[0]), floatFromHalf(bits[1]), floatFromHalf(bits[2]), floatFromHalf(bits[3]) };
}

inline float4 bytePixel(Image const& image, uint32_t x, uint32_t y) {
    const auto* p =
            reinterpret_cast<const uint8_t*>(image.pixels.data()) + (static_cast<size_t>(y) * image.width + x) * 4;
    return float4(p[0], p[1], p[2], p[3]) / 255.0f;
}

/// Of images of half floats, in bits; as many as there are numbers if the sizes differ.
inline size_t differingPixels(Image const& a, Image const& b) {
    size_t pixels = 0;
    for (size_t i = 0; i + 8 <= std::min(a.pixels.size(), b.pixels.size()); i += 8)
        pixels += std::memcmp(a.pixels.data() + i, b.pixels.data() + i, 8) != 0;
    return a.pixels.size() == b.pixels.size() ? pixels : ~size_t{ 0 };
}

struct Extremes {
    float least = 1e9f, most = -1e9f;
};

/// The range of the colours of an image of half floats; expects that all are finite.
inline Extremes extremesOf(Image const& image) {
    Extremes found;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const float4 pixel = halfPixel(image, x, y);
            for (int c = 0; c < 3; ++c) {
                EXPECT_TRUE(std::isfinite(pixel[c]));
                found.least = std::min(found.least, pixel[c]);
                found.most = std::max(found.most, pixel[c]);
            }
        }
    }
    return found;
}

struct Difference {
    size_t pixels = 0;
    int largest = 0; ///< of a component
};

/// Differences between two RGBA8 images.
inline Difference differenceOf(Image const& a, Image const& b) {
    Difference difference;
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    for (size_t i = 0; i + 3 < std::min(a.pixels.size(), b.pixels.size()); i += 4) {
        int largest = 0;
        for (size_t c = 0; c < 4; ++c)
            largest =
                    std::max(largest, std::abs(static_cast<int>(a.pixels[i + c]) - static_cast<int>(b.pixels[i + c])));
        difference.pixels += largest > 0;
        difference.largest = std::max(difference.largest, largest);
    }
    return difference;
}

/// For files that a test writes and reads. No other test has it: several run at once, in processes of their own.
inline std::filesystem::path folderOfThisTest() {
    testing::TestInfo const& test = *testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test.test_suite_name()) + '.' + test.name();
    std::ranges::replace(name, '/', '-');
    const std::filesystem::path folder = tools::buildDir() / "test-files" / name;
    std::filesystem::create_directories(folder);
    return folder;
}

/// For tests that use files beside the checkout.
class AssetTest : public testing::Test {
protected:
    void SetUp() override {
        if (tools::assetDir().empty())
            GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set: the models are not beside the checkout";
    }
};

} // namespace filament_core::test
