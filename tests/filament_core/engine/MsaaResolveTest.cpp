// SPDX-License-Identifier: Apache-2.0
// How four samples become a pixel: a lamp covers as much of what is displayed as it covers of the pixel, however bright
// it is, beside supersampling of what is displayed.
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <glm/ext/matrix_transform.hpp>

#include <cmath>
#include <map>

namespace filament_core {
namespace {

using test::halfPixel;
using test::kBothApis;

constexpr uint2 kLampSize(48, 40);
constexpr const char* kLamp = R"(material { name : lamp, shadingModel : unlit, culling : none,
    parameters : [ { type : float, name : nits } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(0.0, 0.0, 0.0, 1.0);
    material.emissive = vec4(vec3(materialParams.nits), 1.0);
} })";

/// A slanted lamp before a dark wall, at an exposure for rooms: EV 7.
class LampEdge {
public:
    explicit LampEdge(Backend backend, float nits = 1e4f)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              renderer(engine), mSquare(engine), mMaterial(test::loadMaterial(engine, kLamp)), mLamp(instanceOf(nits)),
              mWall(instanceOf(8)), scene(engine) {
        const double4x4 turned = glm::rotate(double4x4(1.0), glm::radians(7.0), double3(0, 0, 1));
        mSquare.add(scene, mLamp, glm::translate(turned, double3(1.02, 0, 0)));
        mSquare.add(scene, mWall, double3(0, 0, -0.5), 3);
        view.camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, { .verticalFovDegrees = 60 },
                                     { .aperture = 2.8f, .shutterSeconds = 1.0f / 16, .iso = 100 });
        view.size = kLampSize;
        view.samples = 4;
    }
    ~LampEdge() { test::expectNoErrors(engine); }

    Owned<MaterialInstance> instanceOf(float nits) {
        Owned<MaterialInstance> instance = engine.own(engine.createInstance(mMaterial));
        EXPECT_TRUE(engine.set(instance, "nits", nits).ok());
        return instance;
    }
    Renderable add(MaterialInstance instance, double3 at, double scale) {
        return mSquare.add(scene, instance, at, scale);
    }
    Image draw(MsaaResolve resolve) {
        view.quality.msaaResolve = resolve;
        return std::move(*renderer.renderToImage(scene, view));
    }
    Image drawLight(MsaaResolve resolve) {
        view.quality.msaaResolve = resolve;
        return test::renderLinear(engine, renderer, scene, view);
    }

    Engine engine;
    Renderer renderer;
    View view;

private:
    test::SquareMesh mSquare;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mLamp, mWall;

public:
    Scene scene; ///< destroyed before what it shows
};

/// The light that a display emits where an image has this code.
double shown(uint8_t code) {
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
uint8_t codeAt(Image const& image, uint32_t x, uint32_t y) {
    return std::to_integer<uint8_t>(image.pixels[4 * (size_t{ y } * image.width + x) + 1]);
}

/// Of each pixel: the mean of what 8 x 8 samples display.
std::vector<double> supersampled(LampEdge& lamp) {
    constexpr uint32_t kSide = 8;
    const View seen = lamp.view;
    lamp.view.size = seen.size * kSide;
    lamp.view.samples = 1;
    const Image large = lamp.draw(MsaaResolve::Average);
    lamp.view = seen;
    std::vector<double> means(size_t{ seen.size.x } * seen.size.y, 0.0);
    for (uint32_t y = 0; y < large.height; ++y) {
        for (uint32_t x = 0; x < large.width; ++x)
            means[size_t{ y / kSide } * seen.size.x + x / kSide] += shown(codeAt(large, x, y)) / (kSide * kSide);
    }
    return means;
}

double rmsBeside(std::vector<double> const& exact, Image const& image) {
    double sum = 0;
    size_t edges = 0;
    for (size_t i = 0; i < exact.size(); ++i) {
        const double away =
                shown(codeAt(image, static_cast<uint32_t>(i % image.width), static_cast<uint32_t>(i / image.width))) -
                exact[i];
        if (exact[i] > 0.02 && exact[i] < 0.97) sum += away * away, ++edges;
    }
    EXPECT_GE(edges, image.height / 2) << "an edge";
    return std::sqrt(sum / static_cast<double>(std::max<size_t>(edges, 1)));
}

TEST(MsaaResolve, EdgesOfLampsAreAsSmoothAsSupersamplingOfWhatIsDisplayed) {
    for (const float nits : { 200.0f, 1e4f, 1e6f }) {
        std::vector<Image> images;
        for (const Backend backend : kBothApis) {
            LampEdge lamp(backend, nits);
            const std::vector<double> exact = supersampled(lamp);
            const double average = rmsBeside(exact, lamp.draw(MsaaResolve::Average));
            images.push_back(lamp.draw(MsaaResolve::ToneAware));
            const double aware = rmsBeside(exact, images.back());
            RecordProperty(fmt::format("{} nits", nits), fmt::format("average {:.4f}, aware {:.4f}", average, aware));
            EXPECT_LT(aware, 0.12) << nits << ": four samples are up to an eighth off the true coverage";
            EXPECT_LT(aware, (nits < 1e4f ? 0.9 : 0.4) * average) << nits << ": what is not white is averaged well";
        }
        EXPECT_EQ(images[0].pixels, images[1].pixels) << nits;
    }
}

/// The lamp enters each row of pixels a little further to the right, and displays rise from the wall to it.
/// With one sample a pixel, whose edges are reconstructed and weighted in the same way.
TEST(MsaaResolve, WeighsReconstructedEdgesOfLampsAsThoseOfFourSamples) {
    for (const float nits : { 2e2f, 1e4f, 1e6f }) {
        std::vector<Image> images;
        for (const Backend backend : kBothApis) {
            LampEdge lamp(backend, nits);
            const std::vector<double> exact = supersampled(lamp);
            const double ofSamples = rmsBeside(exact, lamp.draw(MsaaResolve::ToneAware));
            lamp.view.samples = 1;
            lamp.view.quality.antiAliasing = AntiAliasing::Sraa;
            const double average = rmsBeside(exact, lamp.draw(MsaaResolve::Average));
            images.push_back(lamp.draw(MsaaResolve::ToneAware));
            const double aware = rmsBeside(exact, images.back());
            RecordProperty(fmt::format("{} nits", nits),
                           fmt::format("samples {:.3f}, sraa {:.3f}, averaged {:.3f}", ofSamples, aware, average));
            EXPECT_LT(aware, 1.2 * ofSamples) << nits;
            EXPECT_LT(aware, average) << nits;
        }
        EXPECT_EQ(images[0].pixels, images[1].pixels) << nits;
    }
}

TEST(MsaaResolve, StepsOfAnEdgeAreMonotonicAndThoseOfFourSamples) {
    for (const float nits : { 1e4f, 1e6f }) {
        LampEdge lamp(Backend::Vulkan, nits);
        const Image aware = lamp.draw(MsaaResolve::ToneAware), average = lamp.draw(MsaaResolve::Average);
        std::map<uint8_t, uint32_t> steps, stepsOfAverage;
        for (uint32_t y = 0; y < kLampSize.y; ++y) {
            for (uint32_t x = 0; x < kLampSize.x; ++x) {
                ++steps[codeAt(aware, x, y)];
                ++stepsOfAverage[codeAt(average, x, y)];
                EXPECT_GE(codeAt(aware, x, y), codeAt(aware, x > 0 ? x - 1 : x, y)) << x << " " << y;
            }
        }
        ASSERT_EQ(steps.size(), 5u) << "none to all of four samples";
        const double wall = shown(steps.begin()->first), light = shown(steps.rbegin()->first);
        double covered = 0;
        for (auto const& [code, count] : steps) {
            EXPECT_NEAR((shown(code) - wall) / (light - wall), covered, 0.12) << covered;
            covered += 0.25;
        }
        ASSERT_GE(stepsOfAverage.size(), 2u);
        EXPECT_GT((shown(std::next(stepsOfAverage.begin())->first) - wall) / (light - wall), 0.9)
                << "of the average, a quarter of the lamp is all of it";
    }
}

/// Exposure of the grading and other tone mappers: the weights bend where what is displayed does.
TEST(MsaaResolve, FollowsTheToneMapperAndTheGrading) {
    for (const ToneMapper mapper : { ToneMapper::Aces, ToneMapper::Filmic, ToneMapper::Mobile, ToneMapper::Agx,
                                     ToneMapper::PbrNeutral, ToneMapper::AcesReference, ToneMapper::Generic }) {
        for (const float stops : { 0.0f, -3.0f }) {
            LampEdge lamp(Backend::Vulkan, 2e3f);
            lamp.view.display.toneMapper = mapper;
            lamp.view.effects.colorGrading = { .enabled = stops != 0, .exposure = stops };
            const std::vector<double> exact = supersampled(lamp);
            const double average = rmsBeside(exact, lamp.draw(MsaaResolve::Average));
            const double aware = rmsBeside(exact, lamp.draw(MsaaResolve::ToneAware));
            RecordProperty(fmt::format("{} {}", toString(mapper), stops),
                           fmt::format("average {:.4f}, aware {:.4f}", average, aware));
            EXPECT_LT(aware, 0.75 * average) << toString(mapper) << " " << stops;
            EXPECT_LT(aware, 0.2) << toString(mapper) << " " << stops;
        }
    }
}

TEST(MsaaResolve, LeavesEvenSurfacesAlone) {
    LampEdge lamp(Backend::Gles);
    const Image average = lamp.drawLight(MsaaResolve::Average), aware = lamp.drawLight(MsaaResolve::ToneAware);
    for (const uint2 at : { uint2(2, 3), uint2(45, 20) }) {
        const float4 light = halfPixel(average, at.x, at.y);
        EXPECT_NEAR(halfPixel(aware, at.x, at.y).x, light.x, light.x * 1e-3f);
        EXPECT_EQ(halfPixel(aware, at.x, at.y).w, 1);
    }
}

/// 0 / 0 and 1 / 0 of a material stay in the pixels that it touches.
TEST(MsaaResolve, KeepsNanAndInfinityInTheirPixels) {
    for (const char* value : { "1.0 / materialParams.zero", "materialParams.zero / materialParams.zero" }) {
        std::vector<Image> images;
        for (const Backend backend : kBothApis) {
            LampEdge lamp(backend);
            const Image without = lamp.drawLight(MsaaResolve::ToneAware);
            const Owned<Material> material = test::loadMaterial(
                    lamp.engine,
                    fmt::format("material {{ name : broken, shadingModel : unlit, parameters : [ {{ type : "
                                "float, name : zero }} ] }}\nfragment {{ void material(inout "
                                "MaterialInputs material) {{ prepareMaterial(material);\n"
                                "material.baseColor = vec4(vec3({}), 1.0); }} }}",
                                value));
            const Owned<MaterialInstance> instance = lamp.engine.own(lamp.engine.createInstance(material));
            const Renderable square = lamp.add(instance, { -0.5, 0.1, 0.1 }, 0.05);
            images.push_back(lamp.drawLight(MsaaResolve::ToneAware));
            uint32_t changed = 0;
            for (uint32_t y = 0; y < kLampSize.y; ++y) {
                for (uint32_t x = 0; x < kLampSize.x; ++x)
                    changed += halfPixel(images.back(), x, y) == halfPixel(without, x, y) ? 0 : 1;
            }
            EXPECT_GE(changed, 4u);
            EXPECT_LE(changed, 25u) << "the square, and nothing around it";
            EXPECT_EQ(halfPixel(images.back(), 40, 20), halfPixel(without, 40, 20));
            lamp.scene.remove(square);
        }
        EXPECT_EQ(images[0].pixels, images[1].pixels) << value;
    }
}

/// A transparent surface over the background has the right colour at its edges.
TEST(MsaaResolve, OfTranslucentViewsWeighsTheColoursThatAreDisplayed) {
    std::vector<Image> images;
    for (const Backend backend : kBothApis) {
        LampEdge lamp(backend, 1e6f);
        Scene alone(lamp.engine);
        const test::SquareMesh square(lamp.engine);
        const Owned<MaterialInstance> bright = lamp.instanceOf(1e6f);
        square.add(alone, bright, glm::rotate(double4x4(1.0), 0.1, double3(0, 0, 1)));
        lamp.view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 60 });
        lamp.view.clearColor = float4(0);
        lamp.view.viewport = Viewport{ .contents = TargetContents::Clear,
                                       .blending = ViewBlending::Translucent,
                                       .clearColor = float4(0) };
        lamp.view.quality.msaaResolve = MsaaResolve::ToneAware;
        const Owned<SwapChain> target = lamp.engine.own(
                lamp.engine.create(SwapChainDesc{ .size = kLampSize, .imageCount = 1, .format = Format::RGBA8 }));
        lamp.renderer.render(alone, lamp.view, target);
        images.push_back(std::move(*lamp.renderer.waitPixels(lamp.renderer.readPixels(target))));
        uint32_t edges = 0;
        for (size_t i = 0; i < images.back().pixels.size(); i += 4) {
            const auto alpha = std::to_integer<int>(images.back().pixels[i + 3]);
            EXPECT_NEAR(std::to_integer<int>(images.back().pixels[i + 1]), alpha, 3) << "white times alpha";
            edges += alpha > 0 && alpha < 255 ? 1 : 0;
        }
        EXPECT_GE(edges, 40u);
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

TEST(MsaaResolve, CostsNothingWithoutSamplesOrSurfaces) {
    for (const Backend backend : kBothApis) {
        LampEdge lamp(backend);
        const Scene empty(lamp.engine);
        const auto expectNothing = [&](Scene const& scene, const char* reason) {
            lamp.view.quality.msaaResolve = MsaaResolve::Average;
            const Image before = std::move(*lamp.renderer.renderToImage(scene, lamp.view));
            const auto off = lamp.renderer.statistics();
            lamp.view.quality.msaaResolve = MsaaResolve::ToneAware;
            const Image after = std::move(*lamp.renderer.renderToImage(scene, lamp.view));
            EXPECT_EQ(lamp.renderer.statistics().passesRun, off.passesRun);
            EXPECT_EQ(lamp.renderer.statistics().draws, off.draws);
            EXPECT_EQ(before.pixels, after.pixels);
            EXPECT_NE(lamp.renderer.explain().find(reason), std::string::npos) << lamp.renderer.explain();
        };
        expectNothing(empty, "no surface is visible");
        lamp.view.samples = 1;
        expectNothing(lamp.scene, "pixels have one sample");
        lamp.view.samples = 4;
        (void)lamp.draw(MsaaResolve::Average);
        EXPECT_NE(lamp.renderer.explain().find("switched off: msaaResolve=average"), std::string::npos);
        (void)lamp.draw(MsaaResolve::ToneAware);
        EXPECT_NE(lamp.renderer.explain().find("4 samples a pixel, weighted by what they display"), std::string::npos);
    }
}

/// All effects read the resolved scene colour, except for refraction.
TEST(MsaaResolve, HasTheSameBitsBesideEveryOtherEffectOfThePicture) {
    const std::pair<const char*, void (*)(View&)> effects[] = {
        { "taa", [](View& view) { view.quality.antiAliasing = AntiAliasing::Taa; } },
        { "fxaa", [](View& view) { view.quality.antiAliasing = AntiAliasing::Fxaa; } },
        { "bloom", [](View& view) { view.effects.bloom.enabled = true; } },
        { "focus",
          [](View& view) { view.effects.depthOfField = { .enabled = true, .focusMeters = 1, .blurScale = 60 }; } },
        { "exposure", [](View& view) { view.effects.autoExposure.enabled = true; } },
        { "occlusion", [](View& view) { view.effects.ambientOcclusion.enabled = true; } },
        { "fewer pixels",
          [](View& view) {
              view.effects.resolution.upscaling = Upscaling::EdgeAdaptive, view.effects.resolution.scale = float2(0.6f);
          } },
    };
    for (auto const& [name, set] : effects) {
        std::vector<Image> images;
        for (const Backend backend : kBothApis) {
            LampEdge lamp(backend);
            set(lamp.view);
            (void)lamp.draw(MsaaResolve::ToneAware);
            images.push_back(lamp.draw(MsaaResolve::ToneAware));
            EXPECT_NE(images.back().pixels, lamp.draw(MsaaResolve::Average).pixels) << name;
        }
        EXPECT_EQ(images[0].pixels, images[1].pixels) << name;
    }
}

constexpr const char* kGlass = R"(material { name : glass, shadingModel : lit, refractionMode : screenspace,
    refractionType : solid }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(1.0);
    material.roughness = 0.0; material.transmission = 1.0; material.ior = 1.2; material.thickness = 0.1;
} })";

/// Refraction reads the average of light; edges of refractive objects are weighted with all others.
TEST(MsaaResolve, ResolvesWhatRefractsThePictureWithIt) {
    std::vector<Image> images;
    for (const Backend backend : kBothApis) {
        LampEdge lamp(backend);
        const Owned<Material> material = test::loadMaterial(lamp.engine, kGlass);
        const Owned<MaterialInstance> glass = lamp.engine.own(lamp.engine.createInstance(material));
        const Renderable square = lamp.add(glass, { 0, 0, 0.2 }, 0.2);
        images.push_back(lamp.draw(MsaaResolve::ToneAware));
        lamp.scene.remove(square);
        const Image without = lamp.draw(MsaaResolve::ToneAware);
        EXPECT_EQ(codeAt(images.back(), 2, 2), codeAt(without, 2, 2));
        EXPECT_NE(images.back().pixels, without.pixels);
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

} // namespace
} // namespace filament_core
