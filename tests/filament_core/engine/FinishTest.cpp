// SPDX-License-Identifier: Apache-2.0
// What finishes an image: grading, vignette, grain, fringes and auto exposure, each beside its closed form, with the
// same bits on both APIs.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <cmath>
#include <functional>

namespace filament_core {
namespace {

using test::bytePixel;
using test::halfPixel;
using SetView = std::function<void(View&)>;

constexpr uint2 kEvenSize(64, 48);

View evenView(float3 light, uint2 size = kEvenSize) { return { .size = size, .clearColor = float4(light, 1) }; }

Image drawInto(Engine& engine, Renderer& renderer, Scene const& scene, View const& view, Format format) {
    const Owned<SwapChain> target =
            engine.own(engine.create(SwapChainDesc{ .size = view.size, .imageCount = 1, .format = format }));
    renderer.render(scene, view, target);
    auto image = renderer.waitPixels(renderer.readPixels(target));
    EXPECT_TRUE(image);
    return image ? std::move(*image) : Image{};
}

/// An image of one light, on both APIs, which have the same bits.
Image evenPicture(float3 light, SetView const& set, Format format = Format::RGBA16F, uint2 size = kEvenSize) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        if (!engine) return {};
        View view = evenView(light, size);
        set(view);
        Renderer renderer(*engine);
        images.push_back(drawInto(*engine, renderer, Scene(*engine), view, format));
        test::expectNoErrors(*engine);
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    return std::move(images[0]);
}

float3 middleOf(Image const& image) { return halfPixel(image, image.width / 2, image.height / 2); }

void expectFinished(float3 a, float3 b, float share, std::string const& what) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], share * std::max(b[c], 0.05f)) << what << ", component " << c;
}

float3 gradedLight(float3 light, std::function<void(ColorGrading&)> const& set) {
    return middleOf(evenPicture(light, [&](View& view) {
        view.effects.colorGrading.enabled = true;
        set(view.effects.colorGrading);
    }));
}

const float3 kLights[] = { float3(0.18f), float3(0.5f, 0.2f, 0.05f), float3(0.02f, 0.3f, 4), float3(20, 7, 9) };

TEST(ColorGrading, ExposureIsAFactor) {
    for (float3 const& light : kLights)
        expectFinished(gradedLight(light, [](ColorGrading& g) { g.exposure = 1.5f; }), light * std::exp2(1.5f), 2e-3f,
                       "1.5 stops");
}

TEST(ColorGrading, WithoutSaturationOnlyLuminanceIsLeft) {
    for (float3 const& light : kLights) {
        const float3 grey(color::luminance(light));
        expectFinished(gradedLight(light, [](ColorGrading& g) { g.saturation = 0; }), grey, 3e-3f, "grey");
    }
}

TEST(ColorGrading, ContrastTurnsAboutMiddleGrey) {
    for (const float contrast : { 0.5f, 1.5f }) {
        const auto set = [&](ColorGrading& g) { g.contrast = contrast; };
        expectFinished(gradedLight(float3(0.18f), set), float3(0.18f), 5e-3f, "middle grey");
        // Two stops above it, on a logarithm of stops.
        expectFinished(gradedLight(float3(0.72f), set), float3(0.18f * std::exp2(2 * contrast)), 1e-2f, "two stops");
    }
}

/// ACEScct, S-2016-001, in double precision.
double acesLog(double x) {
    return x <= 0.0078125 ? 10.5402377416545 * x + 0.0729055341958355 : (std::log2(x) + 9.72) / 17.52;
}
double lightOfAcesLog(double y) { return std::exp2(y * 17.52 - 9.72); }

TEST(ColorGrading, SlopeOffsetAndPowerAreThoseOfTheDecisionList) {
    const auto set = [](ColorGrading& g) { g.slope = float3(1.1f), g.offset = float3(-0.03f), g.power = float3(1.2f); };
    for (const double light : { 0.05, 0.18, 1.0, 6.0 }) {
        const double expected = lightOfAcesLog(std::pow(acesLog(light) * 1.1 - 0.03, 1.2));
        expectFinished(gradedLight(float3(static_cast<float>(light)), set), float3(static_cast<float>(expected)), 5e-3f,
                       "grey");
    }
}

TEST(ColorGrading, TonalRangesTouchTheirOwnLight) {
    const auto set = [](ColorGrading& g) {
        g.shadows = float3(0.5f), g.midtones = float3(2), g.highlights = float3(3);
        g.tonalRanges = float4(0.1f, 0.2f, 1, 2);
    };
    expectFinished(gradedLight(float3(0.05f), set), float3(0.025f), 5e-3f, "shadows");
    expectFinished(gradedLight(float3(0.5f), set), float3(1), 5e-3f, "midtones");
    expectFinished(gradedLight(float3(4), set), float3(12), 5e-3f, "highlights");
}

TEST(ColorGrading, CurvesAreAGammaAndALine) {
    const auto set = [](ColorGrading& g) {
        g.shadowGamma = float3(2), g.midPoint = float3(0.5f), g.highlightScale = float3(0.25f);
    };
    expectFinished(gradedLight(float3(0.25f), set), float3(0.125f), 5e-3f, "below");
    expectFinished(gradedLight(float3(2.5f), set), float3(1), 5e-3f, "above");
}

/// Light of the temperature that is to be white becomes grey, and the other way round.
TEST(ColorGrading, WhiteBalanceMakesDaylightWhite) {
    const float3 cold = color::fromDaylight(25'000) * 0.4f, warm = color::fromDaylight(4000) * 0.4f;
    const float3 fromCold = gradedLight(cold, [](ColorGrading& g) { g.temperature = 1; });
    const float3 fromWarm = gradedLight(warm, [](ColorGrading& g) { g.temperature = -1; });
    for (float3 const& light : { fromCold, fromWarm }) {
        EXPECT_NEAR(light.x / light.y, 1, 0.01f);
        EXPECT_NEAR(light.z / light.y, 1, 0.01f);
    }
    EXPECT_GT(gradedLight(float3(0.5f), [](ColorGrading& g) { g.temperature = 0.5f; }).x, 0.52f) << "warmer";
    EXPECT_LT(gradedLight(float3(0.5f), [](ColorGrading& g) { g.tint = 1; }).y, 0.49f) << "less green";
}

TEST(ColorGrading, TheMixerMixesChannels) {
    const auto swapped = [](ColorGrading& g) { g.mixRed = float3(0, 0, 1), g.mixBlue = float3(1, 0, 0); };
    const float3 grey = gradedLight(float3(0.4f), swapped);
    expectFinished(grey, float3(0.4f), 3e-3f, "grey stays");
    const float3 blue = gradedLight(float3(0.6f, 0.1f, 0.1f), swapped);
    EXPECT_GT(blue.z, 0.4f);
    EXPECT_LT(blue.x, 0.2f);
}

TEST(ColorGrading, GamutMappingKeepsLuminance) {
    const auto vivid = [](bool maps) { return [maps](ColorGrading& g) { g.saturation = 3, g.gamutMapping = maps; }; };
    const float3 light(0.1f, 0.5f, 0.1f);
    EXPECT_NEAR(color::luminance(gradedLight(light, vivid(true))), color::luminance(light), 0.01f);
    EXPECT_EQ(gradedLight(light, vivid(false)).x, 0.0f) << "clipped";
}

constexpr ToneMapper kMappers[] = { ToneMapper::Linear, ToneMapper::Aces, ToneMapper::Filmic, ToneMapper::Mobile };

void setLook(ColorGrading& grading) {
    grading = { .enabled = true, .exposure = 0.5f, .temperature = 0.2f, .contrast = 1.2f, .saturation = 1.1f };
    grading.slope = float3(1, 0.98f, 1.02f);
    grading.shadows = float3(0.9f, 0.95f, 1.1f);
}

TEST(ColorGrading, ATableHasTheColoursOfTheFormula) {
    for (const ToneMapper mapper : kMappers) {
        for (float3 const& light : kLights) {
            const auto drawn = [&](ToneMapping mapping) {
                return evenPicture(light,
                                   [&](View& view) {
                                       setLook(view.effects.colorGrading);
                                       view.display.toneMapper = mapper;
                                       view.quality.toneMapping = mapping;
                                   },
                                   Format::RGBA8, { 4, 4 });
            };
            const Image exact = drawn(ToneMapping::Analytic), table = drawn(ToneMapping::Table64);
            const int allowed = mapper == ToneMapper::Linear ? 5 : 2; // it ends with a kink
            EXPECT_LE(test::differenceOf(exact, table).largest, allowed) << toString(mapper);
        }
    }
}

TEST(ColorGrading, ManyLooksAfterEachOtherKeepTheirTables) {
    auto engine = test::makeEngine(Backend::Vulkan);
    ASSERT_TRUE(engine);
    Renderer renderer(*engine);
    const Scene scene(*engine);
    View view = evenView(float3(0.18f), { 4, 4 });
    view.quality.toneMapping = ToneMapping::Table16;
    view.display.toneMapper = ToneMapper::Linear;
    view.effects.colorGrading.enabled = true;
    for (int i = 0; i < 24; ++i) {
        view.effects.colorGrading.exposure = static_cast<float>(i % 7) * 0.25f - 1;
        const Image image = drawInto(*engine, renderer, scene, view, Format::RGBA8);
        const float light = 0.18f * std::exp2(view.effects.colorGrading.exposure);
        EXPECT_NEAR(bytePixel(image, 1, 1).x, color::srgbFromLinear(float3(light)).x, 0.02f) << i;
    }
    test::expectNoErrors(*engine);
}

TEST(Vignette, LeavesTheMiddleAndEndsInItsColor) {
    const Image image = evenPicture(float3(0.5f), [](View& view) {
        view.effects.vignette = { .enabled = true, .midPoint = 0.3f, .feather = 0.2f, .color = { 0.5f, 0.25f, 0 } };
    });
    EXPECT_EQ(middleOf(image), float3(0.5f));
    expectFinished(halfPixel(image, 0, 0), float3(0.25f, 0.125f, 0), 1e-3f, "corner");
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const float4 here = halfPixel(image, x, y);
            EXPECT_NEAR(here.x, halfPixel(image, image.width - 1 - x, image.height - 1 - y).x, 1e-3f);
            const bool isInner = x > 0 && x < image.width / 2;
            EXPECT_TRUE(!isInner || here.x >= halfPixel(image, x - 1, y).x) << "darker outwards";
        }
    }
}

TEST(Vignette, IsACircleOrFollowsThePicture) {
    const auto edges = [](float roundness) {
        const Image image = evenPicture(
                float3(1),
                [&](View& view) {
                    view.effects.vignette = { .enabled = true, .midPoint = 0, .roundness = roundness, .feather = 0.5f };
                },
                Format::RGBA16F, { 128, 32 });
        return float2(halfPixel(image, 0, 16).x, halfPixel(image, 64, 0).x); // left, top
    };
    EXPECT_NEAR(edges(0.5f).x, edges(0.5f).y, 0.03f) << "an ellipse";
    EXPECT_LT(edges(1).x, edges(1).y - 0.2f) << "a circle: the sides are farther away";
}

TEST(Grain, HasItsDeviationAndKeepsTheMean) {
    for (const float size : { 1.0f, 1.5f, 4.0f }) {
        const Image image = evenPicture(float3(0.2140411f), // middle of the display's values
                                        [&](View& view) {
                                            view.display.toneMapper = ToneMapper::Linear;
                                            view.effects.grain = { .enabled = true, .strength = 0.08f, .size = size };
                                        },
                                        Format::RGBA8, { 256, 256 });
        double sum = 0, squares = 0;
        for (uint32_t y = 0; y < 256; ++y) {
            for (uint32_t x = 0; x < 256; ++x) {
                const auto value = static_cast<double>(bytePixel(image, x, y).x);
                sum += value, squares += value * value;
            }
        }
        const double mean = sum / 65536, deviation = std::sqrt(squares / 65536 - mean * mean);
        EXPECT_NEAR(mean, 0.5, 0.004) << size;
        EXPECT_NEAR(deviation, 0.08, 0.004) << size;
    }
}

TEST(Grain, IsThatOfItsTime) {
    const auto at = [](double seconds) {
        return evenPicture(
                float3(0.2f),
                [&](View& view) {
                    view.effects.grain.enabled = true;
                    view.timeSeconds = seconds;
                },
                Format::RGBA8);
    };
    EXPECT_EQ(at(1).pixels, at(1).pixels);
    EXPECT_NE(at(1).pixels, at(1.0 / 60 + 1).pixels);
    EXPECT_NE(at(1e6).pixels, at(1e6 + 1.0 / 60).pixels) << "after days";
}

/// A small lamp near a corner: where its red, green and blue light is.
TEST(ChromaticAberration, MovesRedAndBlueApart) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        const test::SquareMesh square(*engine);
        const Owned<Material> material =
                test::loadMaterial(*engine, test::text("shadingModel : unlit", "material.baseColor = vec4(1.0);"));
        const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
        Scene scene(*engine);
        square.add(scene, instance, double3(0.8, 0.8, 0), 0.03);
        View view{ .camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, { .verticalFovDegrees = 90 }),
                   .size = { 256, 256 } };
        view.effects.chromaticAberration = { .enabled = true, .strength = 0.04f };
        images.push_back(test::renderLinear(*engine, scene, view));
        test::expectNoErrors(*engine);
    }
    EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u);
    double3 sum(0), places(0);
    for (uint32_t y = 0; y < 256; ++y) {
        for (uint32_t x = 0; x < 256; ++x) {
            const double3 light(float3(halfPixel(images[0], x, y)));
            sum += light, places += light * (x + 0.5);
        }
    }
    places /= sum;
    const double atCorner = 0.04 * 256 / std::numbers::sqrt2; // of the distance along x
    EXPECT_NEAR(places.z - places.x, 0.8 * atCorner, 0.1) << "blue is farther out";
    EXPECT_NEAR(places.y, (places.x + places.z) / 2, 0.1);
}

/// Exposes `frames` frames of even images, a quarter of a second apart.
std::vector<float> exposures(std::span<const float> lights, AutoExposure const& options) {
    std::vector<std::vector<float>> ofApis;
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        if (!engine) return {};
        Renderer renderer(*engine);
        const Scene scene(*engine);
        const test::SquareMesh square(*engine);
        const Owned<Material> material = test::loadMaterial(
                *engine, test::text("shadingModel : unlit, parameters : [ { type : float, name : light } ]",
                                    "material.baseColor = vec4(vec3(materialParams.light), 1.0);"));
        const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
        Scene lit(*engine);
        square.add(lit, instance, double3(0), 9);
        View view{ .camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }), .size = { 97, 61 } };
        view.effects.autoExposure = options;
        std::vector<float>& shown = ofApis.emplace_back();
        for (size_t i = 0; i < lights.size(); ++i) {
            EXPECT_TRUE(engine->set(instance, "light", lights[i]));
            view.timeSeconds = 0.25 * static_cast<double>(i);
            shown.push_back(middleOf(drawInto(*engine, renderer, lit, view, Format::RGBA16F)).x);
        }
        test::expectNoErrors(*engine);
    }
    EXPECT_EQ(ofApis[0], ofApis[1]);
    return ofApis[0];
}

TEST(AutoExposure, MakesTheMeanMiddleGreyAtOnce) {
    for (const float light : { 0.001f, 0.18f, 3.0f, 30.0f }) {
        const float shown = exposures(std::array{ light }, { .enabled = true })[0];
        EXPECT_NEAR(std::log2(shown / 0.18f), 0, 0.2f) << light << ": within half a bin";
    }
    EXPECT_NEAR(std::log2(exposures(std::array{ 1.0f }, { .enabled = true, .compensation = 2 })[0] / 0.72f), 0, 0.2f);
}

TEST(AutoExposure, FollowsByItsSpeedInStopsASecond) {
    const std::array lights{ 0.18f, 2.88f, 2.88f, 2.88f, 2.88f, 2.88f };
    const std::vector<float> shown =
            exposures(lights, { .enabled = true, .speedUp = 100, .speedDown = 2 }); // four stops too bright
    for (size_t i = 1; i < lights.size(); ++i)
        EXPECT_NEAR(std::log2(shown[i] / shown[0]), 4 - 0.5 * static_cast<double>(i), 0.05) << i;
    const std::vector<float> brighter =
            exposures(std::array{ 2.88f, 0.18f }, { .enabled = true, .speedUp = 100, .speedDown = 2 });
    EXPECT_NEAR(std::log2(brighter[1] / 0.18f), 0, 0.2f);
}

TEST(AutoExposure, StaysWithinItsRangeInTheDarkAndInTheSun) {
    EXPECT_NEAR(exposures(std::array{ 65504.0f }, { .enabled = true, .minStops = -2 })[0], 65504.0f / 4, 32);
    EXPECT_EQ(exposures(std::array{ 0.0f }, { .enabled = true })[0], 0.0f);
    EXPECT_NEAR(exposures(std::array{ 1e-4f }, { .enabled = true, .maxStops = 3 })[0], 8e-4f, 1e-5f);
}

/// Beside the histogram of all pixels.
TEST(AutoExposure, IsThatOfTheWholePicture) {
    auto engine = test::makeEngine(Backend::Gles);
    ASSERT_TRUE(engine);
    const test::SquareMesh square(*engine);
    const Owned<Material> material = test::loadMaterial(
            *engine,
            test::text("shadingModel : unlit, requires : [ uv0 ]",
                       "vec2 uv = getUV0() * 9.0;"
                       "material.baseColor = vec4(vec3(exp2(6.0 * sin(uv.x * 3.0) * cos(uv.y * 2.0))), 1.0);"));
    const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
    Scene scene(*engine);
    square.add(scene, instance, double3(0), 3);
    View view{ .camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }), .size = { 640, 360 } };
    Renderer renderer(*engine);
    const Image plain = drawInto(*engine, renderer, scene, view, Format::RGBA16F);
    std::vector<double> stops;
    for (uint32_t y = 0; y < plain.height; ++y)
        for (uint32_t x = 0; x < plain.width; ++x)
            stops.push_back(std::log2(static_cast<double>(halfPixel(plain, x, y).x)));
    std::ranges::sort(stops);
    for (const auto& [low, high] : { std::pair(0.4f, 0.95f), std::pair(0.0f, 1.0f), std::pair(0.1f, 0.2f) }) {
        view.effects.autoExposure = { .enabled = true, .lowPercentile = low, .highPercentile = high };
        Renderer fresh(*engine);
        const Image exposed = drawInto(*engine, fresh, scene, view, Format::RGBA16F);
        const auto first = static_cast<size_t>(low * static_cast<float>(stops.size()));
        const auto end = static_cast<size_t>(high * static_cast<float>(stops.size()));
        double mean = 0;
        for (size_t i = first; i < end; ++i) mean += stops[i] / static_cast<double>(end - first);
        const double correction = std::log2(halfPixel(exposed, 320, 180).x / halfPixel(plain, 320, 180).x);
        EXPECT_NEAR(correction, std::log2(0.18) - mean, 0.1) << low << " to " << high;
    }
    test::expectNoErrors(*engine);
}

/// All of it at once, for a display, after FXAA and without.
TEST(Finish, HasTheSameBitsOnBothApisTogether) {
    for (const AntiAliasing antiAliasing : { AntiAliasing::Off, AntiAliasing::Fxaa, AntiAliasing::Taa }) {
        for (const ToneMapping mapping : { ToneMapping::Analytic, ToneMapping::Table16 }) {
            for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
                const Image image = evenPicture(float3(0.3f, 0.6f, 0.2f),
                                                [&](View& view) {
                                                    setLook(view.effects.colorGrading);
                                                    view.effects.vignette.enabled = view.effects.grain.enabled = true;
                                                    view.effects.chromaticAberration.enabled =
                                                            view.effects.autoExposure.enabled = true;
                                                    view.effects.bloom.enabled = true;
                                                    view.display.dither = true;
                                                    view.quality.antiAliasing = antiAliasing;
                                                    view.quality.toneMapping = mapping;
                                                    view.samples = samples;
                                                },
                                                Format::RGBA8, { 53, 31 });
                EXPECT_FALSE(image.pixels.empty());
            }
        }
    }
}

TEST(Finish, CostsNothingWhereItChangesNothing) {
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        Renderer renderer(*engine);
        const Scene scene(*engine);
        View view = evenView(float3(0.3f));
        const Image plain = drawInto(*engine, renderer, scene, view, Format::RGBA8);
        const uint32_t passes = renderer.statistics().passesRun;
        view.effects.colorGrading.enabled = view.effects.autoExposure.enabled = true; // neutral; nothing is visible
        view.effects.grain = { .enabled = true, .strength = 0 };
        view.effects.chromaticAberration = { .enabled = true, .strength = 0 };
        view.effects.vignette = { .enabled = true, .color = LinearColor(1) };
        view.effects.depthOfField.enabled = true;
        EXPECT_EQ(drawInto(*engine, renderer, scene, view, Format::RGBA8).pixels, plain.pixels);
        EXPECT_EQ(renderer.statistics().passesRun, passes);
        test::expectNoErrors(*engine);
    }
}

} // namespace
} // namespace filament_core
