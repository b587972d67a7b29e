// SPDX-License-Identifier: Apache-2.0
// Fewer pixels than the view has, and the filters that make the others: beside closed forms and supersampling, with the
// same bits on both APIs; and that a scale of 1 costs nothing.
#include "tests/filament_core/engine/Fan.h"

#include <functional>

namespace filament_core {
namespace {

using test::bytePixel;
using test::Fan;
using test::halfPixel;
using test::rmsBetween;
using SetView = std::function<void(View&)>;

constexpr Upscaling kUpscalings[] = { Upscaling::Bilinear, Upscaling::CatmullRom, Upscaling::EdgeAdaptive };

Image drawnPicture(Engine& engine, Scene const& scene, View const& view, Format format, int frames = 1) {
    Renderer renderer(engine);
    const Owned<SwapChain> target =
            engine.own(engine.create(SwapChainDesc{ .size = view.size, .imageCount = 1, .format = format }));
    for (int frame = 0; frame < frames; ++frame) renderer.render(scene, view, target);
    auto image = renderer.waitPixels(renderer.readPixels(target));
    EXPECT_TRUE(image);
    return image ? std::move(*image) : Image{};
}

/// A square over the whole image whose display value is a formula of `at`, in [0, 1]^2, on both APIs, which have the
/// same bits.
Image patterned(std::string const& formula, uint2 size, SetView const& set, Format format = Format::RGBA8) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        test::SquareStage stage(backend,
                                test::text("shadingModel : unlit, culling : none",
                                           "vec2 at = getNormalizedViewportCoord().xy; vec2 pixel = gl_FragCoord.xy;\n"
                                           "float code = " +
                                                   formula +
                                                   ";\n    float light = code <= 0.04045 ? code / 12.92 : "
                                                   "pow((code + 0.055) / 1.055, 2.4);\n"
                                                   "    material.baseColor = vec4(vec3(light), 1.0);"));
        Scene scene(stage.engine);
        stage.square.add(scene, stage.instance, double3(0), 8);
        View view = test::SquareMesh::view(size);
        view.display.toneMapper = ToneMapper::Linear;
        set(view);
        images.push_back(drawnPicture(stage.engine, scene, view, format));
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    return std::move(images[0]);
}

SetView enlarged(Upscaling filter, float2 scale) {
    return [=](View& view) {
        view.effects.resolution.upscaling = filter;
        view.effects.resolution.scale = scale;
    };
}

TEST(Upscaling, KeepsEvenPicturesAsTheyAre) {
    for (const Upscaling filter : kUpscalings) {
        for (const char* grey : { "0.0", "0.3", "1.0" }) {
            const Image plain = patterned(grey, { 33, 21 }, [](View&) {});
            const Image large = patterned(grey, { 33, 21 }, enlarged(filter, float2(0.5f, 0.8f)));
            EXPECT_EQ(large.pixels, plain.pixels) << toString(filter) << " " << grey;
        }
    }
}

/// A linear filter keeps ramps, and a cubic one parabolas too; codes of 8 bits are between the passes.
TEST(Upscaling, KeepsRampsAndParabolas) {
    constexpr uint2 kSize(64, 48);
    const auto worst = [&](Upscaling filter, std::string const& formula, std::function<float(float2)> const& exact) {
        const Image drawn = patterned(formula, kSize, enlarged(filter, float2(0.5f, 0.75f)));
        float most = 0;
        for (uint32_t y = 6; y + 6 < kSize.y; ++y) {
            for (uint32_t x = 6; x + 6 < kSize.x; ++x) {
                const float2 at = (float2(x, y) + 0.5f) / float2(kSize);
                most = std::max(most, std::abs(bytePixel(drawn, x, y).x - exact(at)));
            }
        }
        return most * 255;
    };
    for (const Upscaling filter : kUpscalings) {
        const auto ramp = [](float2 at) { return 0.1f + 0.3f * at.x + 0.5f * at.y; };
        const float allowed = filter == Upscaling::EdgeAdaptive ? 3.0f : 1.2f; // its weights are no spline's
        EXPECT_LT(worst(filter, "0.1 + 0.3 * at.x + 0.5 * at.y", ramp), allowed) << toString(filter);
    }
    const auto parabola = [](float2 at) { return 0.2f + 2.0f * (at.x - 0.5f) * (at.x - 0.5f) + 0.2f * at.y * at.y; };
    const std::string text = "0.2 + 2.0 * (at.x - 0.5) * (at.x - 0.5) + 0.2 * at.y * at.y";
    EXPECT_LT(worst(Upscaling::CatmullRom, text, parabola), 1.3f);
}

TEST(Upscaling, OfAnEdgeIsSharperTheBetterItsFilter) {
    for (const float scale : { 0.5f, 0.67f, 0.77f }) {
        std::vector<double> errors;
        for (const Upscaling filter : kUpscalings) {
            std::vector<Image> images;
            for (const Backend backend : test::kBothApis) {
                Fan fan(backend);
                const Image exact = fan.supersampled();
                fan.view.samples = 4;
                enlarged(filter, float2(scale))(fan.view);
                images.push_back(fan.draw());
                if (backend == Backend::Vulkan) errors.push_back(rmsBetween(images.back(), exact));
            }
            EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u) << toString(filter) << " " << scale;
        }
        EXPECT_LT(errors[1], errors[0]) << scale;
        EXPECT_LT(errors[2], errors[1]) << scale;
        RecordProperty(fmt::format("rms at {}", scale),
                       fmt::format("bilinear {:.4f}, cubic {:.4f}, edges {:.4f}", errors[0], errors[1], errors[2]));
    }
}

/// A diagonal edge of a small image becomes a straight one: brightness along it hardly changes.
TEST(Upscaling, AlongEdgesHasFewerSteps) {
    constexpr uint2 kSize(96, 96);
    const auto roughness = [&](Upscaling filter) {
        const Image drawn = patterned("clamp((0.7 * at.x + at.y - 0.85) * 40.0 + 0.5, 0.1, 0.9)", kSize,
                                      enlarged(filter, float2(0.5f)));
        double sum = 0;
        int count = 0;
        for (uint32_t y = 16; y < 80; ++y) { // from the middle code to where the edge is
            for (uint32_t x = 1; x < kSize.x; ++x) {
                const float before = bytePixel(drawn, x - 1, y).x, after = bytePixel(drawn, x, y).x;
                if (before >= 0.5f || after < 0.5f) continue;
                const double place = x - 0.5 + (0.5 - double(before)) / double(after - before);
                const double exact = (0.85 - (y + 0.5) / kSize.y) / 0.7 * kSize.x;
                sum += std::pow(place - exact, 2);
                ++count;
            }
        }
        EXPECT_GT(count, 40);
        return std::sqrt(sum / count);
    };
    const double bilinear = roughness(Upscaling::Bilinear), edges = roughness(Upscaling::EdgeAdaptive);
    EXPECT_LT(edges, bilinear);
    RecordProperty("pixels off the edge", fmt::format("bilinear {:.3f}, along edges {:.3f}", bilinear, edges));
}

/// Of light, a lamp does not darken or brighten what is around it beyond its own texel's reach.
TEST(Upscaling, OfLightStaysWithinWhatIsAround) {
    for (const Upscaling filter : kUpscalings) {
        const Image drawn = patterned("distance(pixel, vec2(8.5)) < 0.6 ? 30.0 : 0.4", { 33, 33 },
                                      enlarged(filter, float2(0.5f)), Format::RGBA16F);
        const test::Extremes found = test::extremesOf(drawn);
        EXPECT_GE(found.least, 0.0f);
        const float wall = halfPixel(drawn, 2, 2).x, lamp = std::pow((30 + 0.055f) / 1.055f, 2.4f);
        EXPECT_LE(found.most, lamp * 1.02f) << toString(filter);
        for (uint32_t x = 24; x < 33; ++x) EXPECT_NEAR(halfPixel(drawn, x, 16).x, wall, 1e-3f * wall) << "out of reach";
    }
}

TEST(Upscaling, LeavesGrainAndDitherToTheLargePicture) {
    for (const Upscaling filter : kUpscalings) {
        const auto noisy = [](View& view) {
            view.effects.grain = { .enabled = true, .strength = 0.1f };
            view.display.dither = true;
        };
        const Image plain = patterned("0.4", { 40, 30 }, noisy);
        const Image large = patterned("0.4", { 40, 30 }, [&](View& view) {
            noisy(view);
            enlarged(filter, float2(0.6f))(view);
        });
        size_t differing = 0; // half floats lie between the passes: a code may round the other way
        for (size_t i = 0; i < plain.pixels.size(); ++i) {
            const int difference =
                    std::abs(std::to_integer<int>(plain.pixels[i]) - std::to_integer<int>(large.pixels[i]));
            EXPECT_LE(difference, 1);
            differing += difference > 0;
        }
        EXPECT_LT(differing, plain.pixels.size() / 20) << toString(filter);
    }
}

TEST(Upscaling, OfAllPixelsCostsNothing) {
    for (const Backend backend : test::kBothApis) {
        Fan fan(backend);
        const Image before = fan.draw();
        const FrameStatistics off = fan.renderer.statistics();
        for (const Upscaling filter : kUpscalings) {
            fan.view.effects.resolution.upscaling = filter;
            EXPECT_EQ(test::differingPixels(fan.draw(), before), 0u);
            EXPECT_EQ(fan.renderer.statistics().passesRun, off.passesRun);
            EXPECT_NE(fan.renderer.explain().find("its values change nothing"), std::string::npos);
        }
        fan.view.effects.resolution.upscaling = Upscaling::Off;
        fan.view.effects.resolution.scale = float2(0.5f);
        EXPECT_EQ(test::differingPixels(fan.draw(), before), 0u) << "nothing would enlarge it";
        EXPECT_NE(fan.renderer.explain().find("switched off: resolution.upscaling=off"), std::string::npos);
        fan.view.effects.resolution.upscaling = Upscaling::EdgeAdaptive;
        fan.draw();
        EXPECT_NE(fan.renderer.explain().find("48 x 40 pixels are drawn"), std::string::npos) << fan.renderer.explain();
        fan.view.debugView = DebugView::Lights;
        fan.draw();
        EXPECT_NE(fan.renderer.explain().find("a debug view is shown"), std::string::npos);
    }
}

TEST(Resolution, IsFiniteInAllSizes) {
    for (const uint2 size : { uint2(1, 1), uint2(2, 3), uint2(16384, 1), uint2(1, 300) }) {
        for (const Upscaling filter : kUpscalings) {
            Fan fan(Backend::Gles);
            fan.view.size = size;
            enlarged(filter, float2(0.5f))(fan.view);
            fan.view.effects.sharpening = { .enabled = true, .strength = 1 };
            EXPECT_GE(test::extremesOf(fan.draw()).least, 0.0f);
        }
        Fan gathered(Backend::Vulkan);
        gathered.view.size = size;
        gathered.view.quality.antiAliasing = AntiAliasing::Taa;
        gathered.view.effects.resolution.scale = float2(0.5f);
        for (int frame = 0; frame < 3; ++frame) EXPECT_GE(test::extremesOf(gathered.draw()).least, 0.0f);
    }
}

/// One texel that is no number, or the largest one there is, reaches its neighbours and no farther.
TEST(Resolution, ContainsBrokenTexels) {
    for (const char* light : { "1e30", "log(-1.0 - at.x)", "1.0 / (at.x - at.x)", "-1e30" }) {
        for (const Upscaling filter : kUpscalings) {
            for (const Format format : { Format::RGBA8, Format::RGBA16F }) {
                const Image drawn = patterned(
                        "ivec2(pixel) == ivec2(7, 9) ? " + std::string(light) + " : 0.5", { 34, 38 },
                        [&](View& view) {
                            enlarged(filter, float2(0.5f))(view);
                            view.effects.sharpening = { .enabled = true, .strength = 1 };
                        },
                        format);
                const auto at = [&](uint32_t x, uint32_t y) {
                    return format == Format::RGBA8 ? bytePixel(drawn, x, y).x : halfPixel(drawn, x, y).x;
                };
                for (uint32_t y = 0; y < 38; ++y) {
                    for (uint32_t x = 0; x < 34; ++x) {
                        EXPECT_TRUE(std::isfinite(at(x, y)));
                        const bool isNear = std::abs(int(x) - 14) <= 6 && std::abs(int(y) - 18) <= 6;
                        EXPECT_TRUE(isNear || at(x, y) == at(0, 0)) << light << " " << x << " " << y;
                    }
                }
            }
        }
    }
}

// ---------------------------------------------------------------------------------------------- sharpening

SetView sharpened(float strength) {
    return [=](View& view) { view.effects.sharpening = { .enabled = true, .strength = strength }; };
}

TEST(Sharpening, LeavesEvenPicturesBlackAndWhiteAlone) {
    for (const char* formula : { "0.0", "1.0", "0.4", "mod(floor(pixel.x) + floor(pixel.y), 2.0)" }) {
        const Image plain = patterned(formula, { 16, 16 }, [](View&) {});
        EXPECT_EQ(patterned(formula, { 16, 16 }, sharpened(1)).pixels, plain.pixels) << formula;
    }
}

/// A pixel of 0.6 in 0.5: between black and white there is room for a weight of -min(0.5 / 2.4, 0.4 / 2), at most
/// -3/16.
TEST(Sharpening, RaisesContrastByTheLargestWeightThatThereIsRoomFor) {
    const auto valueOf = [](Image const& image, uint32_t x, uint32_t y) { return bytePixel(image, x, y).x * 255; };
    for (const float strength : { 0.25f, 1.0f }) {
        const Image drawn = patterned("ivec2(pixel) == ivec2(8, 8) ? 0.6 : 0.5", { 16, 16 }, sharpened(strength));
        const float dark = 127.5f, bright = 153.0f, weight = -0.1875f * strength; // codes
        EXPECT_NEAR(valueOf(drawn, 8, 8), (bright + 4 * dark * weight) / (1 + 4 * weight), 1) << strength;
        EXPECT_NEAR(valueOf(drawn, 9, 8), (dark + (3 * dark + bright) * weight) / (1 + 4 * weight), 1) << strength;
        EXPECT_NEAR(valueOf(drawn, 10, 8), dark, 1);
    }
    // Near white there is less of it: 0.98 among 0.9.
    const Image near = patterned("ivec2(pixel) == ivec2(8, 8) ? 0.98 : 0.9", { 16, 16 }, sharpened(1));
    const float bright = 0.98f, dark = 0.9f, weight = -(1 - bright) / (4 - 4 * dark);
    EXPECT_NEAR(valueOf(near, 8, 8), 255 * (bright + 4 * dark * weight) / (1 + 4 * weight), 1);
}

TEST(Sharpening, HasTheSameBitsBesideEveryOtherEffectOfThePicture) {
    const SetView others[] = { [](View& view) { view.quality.antiAliasing = AntiAliasing::Fxaa; },
                               [](View& view) { view.quality.antiAliasing = AntiAliasing::Taa; },
                               [](View& view) { view.display.dither = true; },
                               [](View& view) { view.effects.grain.enabled = view.effects.vignette.enabled = true; },
                               enlarged(Upscaling::EdgeAdaptive, float2(0.67f)) };
    for (const bool isLinear : { false, true }) {
        for (SetView const& other : others) {
            std::vector<Image> images;
            for (const Backend backend : test::kBothApis) {
                Fan fan(backend);
                other(fan.view);
                const Format format = isLinear ? Format::RGBA16F : Format::RGBA8;
                const Image without = drawnPicture(fan.engine, fan.scene, fan.view, format, 3);
                sharpened(1)(fan.view);
                images.push_back(drawnPicture(fan.engine, fan.scene, fan.view, format, 3));
                EXPECT_NE(images.back().pixels, without.pixels);
            }
            EXPECT_EQ(images[0].pixels, images[1].pixels);
        }
    }
}

TEST(Sharpening, OfNoStrengthOrOfNothingCostsNothing) {
    Fan fan(Backend::Vulkan);
    const Image before = fan.draw();
    const FrameStatistics off = fan.renderer.statistics();
    sharpened(0)(fan.view);
    EXPECT_EQ(test::differingPixels(fan.draw(), before), 0u);
    EXPECT_EQ(fan.renderer.statistics().passesRun, off.passesRun);
    EXPECT_NE(fan.renderer.explain().find("its intensity is 0"), std::string::npos);
    sharpened(1)(fan.view);
    const Image empty = drawnPicture(fan.engine, Scene(fan.engine), fan.view, Format::RGBA16F);
    fan.view.effects.sharpening = {};
    EXPECT_EQ(empty.pixels, drawnPicture(fan.engine, Scene(fan.engine), fan.view, Format::RGBA16F).pixels);
}

} // namespace
} // namespace filament_core
