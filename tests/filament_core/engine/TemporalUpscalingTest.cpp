// SPDX-License-Identifier: Apache-2.0
// Temporal upscaling: how close a static image comes to supersampling, what
// motion leaves of that, and that the size of the frames may change meanwhile.
#include "tests/filament_core/engine/Fan.h"

namespace filament_core {
namespace {

using test::Fan;
using test::rmsBetween;

void gather(View& view, float2 scale) {
    view.quality.antiAliasing = AntiAliasing::Taa;
    view.effects.resolution.scale = scale;
}

TEST(TemporalUpscaling, OfAStillCameraConvergesToSupersamplingOfAllPixels) {
    for (const float2 scale : { float2(0.5f), float2(0.67f), float2(1, 0.5f) }) {
        Fan fan(Backend::Vulkan);
        const Image exact = fan.supersampled();
        const double without = rmsBetween(fan.draw(), exact);
        gather(fan.view, scale);
        std::vector<double> errors;
        for (int frame = 1; frame <= 256; ++frame) errors.push_back(rmsBetween(fan.draw(), exact));
        RecordProperty(fmt::format("rms at {} {}", scale.x, scale.y),
                       fmt::format("without {:.4f}; {:.4f}, {:.4f}, {:.4f}, {:.4f}, {:.4f} after 1, 8, 16, 64, 256",
                                   without, errors[0], errors[7], errors[15], errors[63], errors[255]));
        EXPECT_LT(errors[15], without) << "all pixels of a frame";
        EXPECT_LT(errors[63], 0.3 * without);
        EXPECT_LT(errors[255], 0.01) << "as gathering frames of all pixels does after 64";
        EXPECT_LT(errors[255], 0.75 * errors[31]);
    }
}

TEST(TemporalUpscaling, InMotionIsNearerToSupersamplingThanTheFilterOfSingleFrames) {
    constexpr float kScale = 0.67f;
    const auto interpolate = [](View& view) {
        view.effects.resolution.upscaling = Upscaling::Bilinear;
        view.effects.resolution.scale = float2(kScale);
    };
    for (auto const& [name, move] : test::kFanMotions) {
        const double single = test::flipInMotion(interpolate, move);
        const double gathered = test::flipInMotion([](View& view) { gather(view, float2(kScale)); }, move);
        EXPECT_LT(gathered, single) << name;
        RecordProperty(name, fmt::format("bilinear {:.4f}, gathered {:.4f}", single, gathered));
    }
}

/// What the camera, objects, the scale, and all of them do in 30 frames.
TEST(TemporalUpscaling, GathersTheSameBitsOnBothApisWhateverChanges) {
    std::vector<Image> last;
    for (const Backend backend : test::kBothApis) {
        Fan fan(backend);
        for (int frame = 0; frame < 30; ++frame) {
            gather(fan.view, frame < 20 ? float2(0.67f) : float2(0.75f, 0.5f));
            if (frame >= 5 && frame < 15) fan.turn(0.2 * frame);
            if (frame >= 10 && frame < 25) fan.turnBars(0.5 * frame);
            last.push_back(fan.draw());
        }
    }
    for (size_t frame = 0; frame < 30; ++frame)
        EXPECT_EQ(test::differingPixels(last[frame], last[30 + frame]), 0u) << frame;
}

TEST(TemporalUpscaling, LeavesNoGhosts) {
    Fan fan(Backend::Vulkan);
    gather(fan.view, float2(0.5f));
    for (int frame = 0; frame < 8; ++frame) fan.draw();
    double worst = 0;
    for (int frame = 0; frame < 8; ++frame) {
        fan.turnBars(4.0 * frame);
        worst = std::max(worst, rmsBetween(fan.draw(), fan.supersampled()));
    }
    fan.view.quality.antiAliasing = AntiAliasing::Off;
    fan.view.effects.resolution.upscaling = Upscaling::Bilinear;
    EXPECT_LT(worst, 1.1 * rmsBetween(fan.draw(), fan.supersampled()));
}

/// The history has the output resolution: frames of another scale are added to it.
TEST(TemporalUpscaling, KeepsWhatItGatheredWhenTheScaleChanges) {
    Fan fan(Backend::Vulkan);
    const Image exact = fan.supersampled();
    gather(fan.view, float2(0.75f));
    for (int frame = 0; frame < 64; ++frame) fan.draw();
    const double before = rmsBetween(fan.draw(), exact);
    gather(fan.view, float2(0.5f));
    EXPECT_LT(rmsBetween(fan.draw(), exact), 1.25 * before);
    gather(fan.view, float2(1));
    EXPECT_LT(rmsBetween(fan.draw(), exact), 1.25 * before);
    Renderer fresh(fan.engine);
    EXPECT_GT(rmsBetween(fan.draw(fresh), exact), 5 * before) << "one frame alone";
}

/// With a filter, frames are accumulated at the drawn size, and upscaled after the tone mapper.
TEST(TemporalUpscaling, IsLeftToTheFilterIfThereIsOne) {
    Fan fan(Backend::Vulkan);
    gather(fan.view, float2(0.5f));
    fan.draw();
    EXPECT_EQ(fan.renderer.explain().find("upscaling             ran"), std::string::npos) << fan.renderer.explain();
    fan.view.effects.resolution.upscaling = Upscaling::EdgeAdaptive;
    fan.draw();
    EXPECT_NE(fan.renderer.explain().find("upscaling             ran"), std::string::npos) << fan.renderer.explain();
}

/// Depth of field and reflections work on pixels with depth; bloom, exposure and other post-processing on
/// all.
TEST(TemporalUpscaling, HasTheSameBitsBesideEveryOtherEffectOfThePicture) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        Fan fan(backend);
        gather(fan.view, float2(0.6f, 0.8f));
        Effects& effects = fan.view.effects;
        effects.bloom.enabled = effects.autoExposure.enabled = effects.vignette.enabled = effects.grain.enabled = true;
        effects.chromaticAberration.enabled = effects.sharpening.enabled = true;
        effects.depthOfField = { .enabled = true, .focusMeters = 2, .blurScale = 40 };
        fan.view.effects.ambientOcclusion.enabled = true;
        fan.view.effects.screenSpaceReflections.enabled = true;
        for (int frame = 0; frame < 4; ++frame) {
            fan.turn(0.3 * frame);
            images.push_back(std::move(*fan.renderer.renderToImage(fan.scene, fan.view)));
        }
    }
    for (size_t frame = 0; frame < 4; ++frame) EXPECT_EQ(images[frame].pixels, images[4 + frame].pixels) << frame;
}

TEST(TemporalUpscaling, OfNothingIsTheBackground) {
    for (const Backend backend : test::kBothApis) {
        Fan fan(backend);
        gather(fan.view, float2(0.5f));
        fan.view.clearColor = float4(0.25f, 0.5f, 1, 1);
        const Scene empty(fan.engine);
        const Image drawn = test::renderLinear(fan.engine, empty, fan.view);
        EXPECT_EQ(drawn.width, fan.view.size.x);
        EXPECT_NEAR(test::halfPixel(drawn, 7, 9).y, 0.5f, 1e-3f);
        EXPECT_NEAR(test::halfPixel(drawn, drawn.width - 1, drawn.height - 1).z, 1.0f, 1e-3f);
    }
}

// ---------------------------------------------------------------------------------------------- dynamic

/// A target that no frame can meet, and one that all do.
TEST(DynamicResolution, ShrinksThePictureOnlyWhenFramesTakeTooLong) {
    for (const Backend backend : test::kBothApis) {
        for (const bool hasTimers : { true, false }) {
            for (const bool isGathered : { true, false }) {
                Fan fan(backend);
                Renderer renderer(fan.engine, { .passTimers = hasTimers });
                fan.view.size = { 400, 300 };
                fan.view.quality.antiAliasing = isGathered ? AntiAliasing::Taa : AntiAliasing::Off;
                Resolution& resolution = fan.view.effects.resolution;
                resolution = { .upscaling = isGathered ? Upscaling::Off : Upscaling::Bilinear,
                               .dynamic = true,
                               .targetMilliseconds = 1000,
                               .history = 2 };
                for (int frame = 0; frame < 8; ++frame) fan.draw(renderer);
                EXPECT_NE(renderer.explain().find("its values change nothing"), std::string::npos);
                resolution.targetMilliseconds = 0.1f;
                for (int frame = 0; frame < 20; ++frame) fan.draw(renderer);
                const std::string words = renderer.explain();
                EXPECT_TRUE(words.find("200 x 150 pixels are drawn") != std::string::npos) << hasTimers << words;
                resolution.dynamic = false;
                fan.draw(renderer);
                EXPECT_NE(renderer.explain().find("its values change nothing"), std::string::npos);
            }
        }
    }
}

} // namespace
} // namespace filament_core
