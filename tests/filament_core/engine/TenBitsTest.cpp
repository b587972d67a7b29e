// SPDX-License-Identifier: Apache-2.0
// Targets of ten bits a channel on both APIs: display values in finer steps than those of eight, up to the PNG.
#include "filament_core/assets/tables/DisplayColor.h"
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <set>

namespace filament_core {
namespace {

constexpr uint2 kRampSize(2048, 2);
constexpr int kRampStops = 14; // from 2^-9 on

/// Light from 2^-9 to 2^5, evenly in stops, from left to right.
std::vector<Image> ramps(Format format, std::function<void(View&)> const& set) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        test::SquareStage stage(backend,
                                test::text("shadingModel : unlit, requires : [ uv0 ]",
                                           "material.baseColor = vec4(vec3(exp2(getUV0().x * 14.0 - 9.0)), 1.0);"));
        Scene scene(stage.engine);
        double4x4 wide(1);
        wide[0][0] = kRampSize.x / kRampSize.y; // as wide as the image
        stage.square.add(scene, stage.instance, wide);
        View view{ .camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, { .verticalFovDegrees = 90 }),
                   .size = kRampSize };
        view.display = { .toneMapper = ToneMapper::Linear, .outputSpace = OutputSpace::Rec2020Pq };
        set(view);
        const Owned<Texture> pixels = stage.engine.own(stage.engine.create(TextureDesc{
                .format = format, .width = kRampSize.x, .height = kRampSize.y, .renderable = true, .name = "ramp" }));
        const Owned<RenderTarget> target =
                stage.engine.own(stage.engine.create(RenderTargetDesc{ .color = pixels, .name = "ramp" }));
        Renderer renderer(stage.engine);
        renderer.render(scene, view, target.get());
        auto image = renderer.waitPixels(renderer.readPixels(target.get()));
        EXPECT_TRUE(image);
        if (image) images.push_back(std::move(*image));
    }
    EXPECT_EQ(images.size(), 2u);
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    return images;
}

std::array<uint32_t, 4> codesOf(Image const& image, uint32_t x) {
    uint32_t word = 0;
    std::memcpy(&word, image.pixels.data() + size_t{ x } * 4, sizeof(word));
    if (image.format == Format::RGBA8) return { word & 255, word >> 8 & 255, word >> 16 & 255, word >> 24 };
    return { word & 1023, word >> 10 & 1023, word >> 20 & 1023, word >> 30 };
}

size_t greens(Image const& image) {
    std::set<uint32_t> codes;
    for (uint32_t x = 0; x < image.width; ++x) codes.insert(codesOf(image, x)[1]);
    return codes.size();
}

TEST(TenBits, HoldThePqOfARampInFinerStepsThanEight) {
    const Image eight = ramps(Format::RGBA8, [](View&) {})[0];
    View shown;
    const Image ten = ramps(Format::RGB10A2, [&](View& view) { shown = view; })[0];
    EXPECT_EQ(ten.format, Format::RGB10A2);
    EXPECT_LE(greens(eight), 256u);
    EXPECT_GT(greens(ten), 3 * greens(eight));
    const assets::DisplayColor displayColor(shown.display, nullptr);
    float worst = 0;
    for (uint32_t x = 0; x < ten.width; ++x) {
        const double stops = (x + 0.5) / ten.width * kRampStops - 9;
        const float3 expected = displayColor(float3(static_cast<float>(std::exp2(stops)))) * 1023.0f;
        const std::array<uint32_t, 4> codes = codesOf(ten, x);
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(static_cast<float>(codes[static_cast<size_t>(c)]) - expected[c]));
        ASSERT_EQ(codes[3], 3u) << "opaque";
    }
    EXPECT_LT(worst, 1.0f) << "half a step, light as half floats, and the powers of the devices";
}

TEST(TenBits, NeedNoDither) {
    const Image plain = ramps(Format::RGB10A2, [](View&) {})[0];
    const Image dithered = ramps(Format::RGB10A2, [](View& view) { view.display.dither = true; })[0];
    EXPECT_EQ(plain.pixels, dithered.pixels);
}

/// No image between the passes has fewer bits.
TEST(TenBits, StayTenThroughTheLastPasses) {
    const size_t plain = greens(ramps(Format::RGB10A2, [](View&) {})[0]);
    const auto kept = [&](std::function<void(View&)> const& set) {
        return greens(ramps(Format::RGB10A2, set)[0]) >= plain * 9 / 10;
    };
    EXPECT_TRUE(kept([](View& view) { view.quality.antiAliasing = AntiAliasing::Fxaa; }));
    EXPECT_TRUE(kept([](View& view) { view.effects.sharpening.enabled = true; }));
    EXPECT_TRUE(kept([](View& view) {
        view.effects.resolution.upscaling = Upscaling::Bilinear;
        view.effects.resolution.scale = float2(0.5f, 1);
    }));
    EXPECT_TRUE(kept([](View& view) {
        view.viewport = Viewport{ .contents = TargetContents::Clear, .blending = ViewBlending::Translucent };
    }));
}

} // namespace
} // namespace filament_core
