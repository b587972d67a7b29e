// SPDX-License-Identifier: Apache-2.0
// Pixels drawn around the image and cropped: its border equals the centre of a larger image.
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/Renderer.h>

#include <glm/ext/matrix_transform.hpp>

#include <cmath>
#include <functional>
#include <map>

namespace filament_core {
namespace {

using test::halfPixel;
using test::MaterialStage;

constexpr uint2 kBandedSize(64, 48);
constexpr uint32_t kAround = 24; // pixels on each side of the larger image
constexpr uint32_t kBorder = 6;  // of the image, where off-screen surfaces matter

std::string surface(std::string_view color, std::string_view more = "", std::string_view properties = "") {
    return test::text(fmt::format("shadingModel : lit, culling : none{}", properties),
                      fmt::format("material.baseColor = vec4({}, 1.0); material.roughness = 0.9; "
                                  "material.reflectance = 0.0; {}",
                                  color, more));
}

/// A square of one material: two half edges and its middle.
void addSquare(MaterialStage& stage, MaterialInstance instance, float3 at, float3 right, float3 up) {
    const float3 normal = glm::normalize(glm::cross(right, up));
    const double4x4 world{ double4(right, 0), double4(up, 0), double4(normal, 0), double4(at, 1) };
    stage.add(instance, { { .halfSide = 1 } }, world);
}

/// A floor, two walls and a lamp, which are only partly on screen: their off-screen parts affect the border.
void build(MaterialStage& stage) {
    stage.keep(std::make_shared<test::SkyObjects>(stage, test::Sky{ float3(0.6f), float3(0.2f) }));
    stage.view.camera = Camera::lookAt({ 0, 1, 3 }, { 0, 0.6, 0 }, { .verticalFovDegrees = 40 });
    stage.view.size = kBandedSize;
    const auto lit = [&](std::string const& text) { return stage.material(text, test::kNoLights); };
    const MaterialInstance floor = lit(surface("0.5, 0.5, 0.5", "material.metallic = 1.0; material.roughness = 0.1;",
                                               ", reflections : screenspace"));
    const MaterialInstance wall = lit(surface("0.8, 0.6, 0.4"));
    const MaterialInstance lamp = lit(surface("0.0, 0.0, 0.0", "material.emissive = vec4(30.0, 20.0, 10.0, 0.0);"));
    addSquare(stage, floor, { 0, 0, 0 }, { 4, 0, 0 }, { 0, 0, -4 });
    addSquare(stage, wall, { -1.5f, 1, 0.5f }, { 0, 0, 1.2f }, { 0, 1.4f, 0 });
    addSquare(stage, wall, { 1.6f, 0.6f, 0.2f }, { 0, 0, -1.2f }, { 0, 0.8f, 0 });
    addSquare(stage, lamp, { 0.4f, 1.9f, -0.5f }, { 0.4f, 0, 0 }, { 0, 0.12f, 0 });
}

using Set = void (*)(View& view);
constexpr std::pair<const char*, Set> kEffects[] = {
    { "ambient occlusion",
      [](View& view) {
          view.effects.ambientOcclusion.enabled = true;
          view.effects.ambientOcclusion.resolution = AmbientOcclusionResolution::Full;
          view.effects.ambientOcclusion.radiusMeters = 0.8f;
      } },
    { "reflections", [](View& view) { view.effects.screenSpaceReflections.enabled = true; } },
    { "bloom",
      [](View& view) {
          view.effects.bloom.enabled = true;
          view.effects.bloom.radius = 0.2f;
          view.effects.bloom.strength = 0.3f;
      } },
    { "depth of field",
      [](View& view) { view.effects.depthOfField = { .enabled = true, .focusMeters = 1.5f, .blurScale = 60 }; } },
};

/// The image after so many frames.
Image drawn(Backend backend, std::function<void(View&)> const& set, int frames = 3) {
    auto engine = test::makeEngine(backend);
    if (!engine) return {};
    MaterialStage stage(*engine);
    build(stage);
    set(stage.view);
    Renderer renderer(*engine);
    Image image;
    for (int frame = 0; frame < frames; ++frame) image = test::renderLinear(*engine, renderer, stage.scene, stage.view);
    test::expectNoErrors(*engine);
    return image;
}

/// A view with so many more pixels on each side, and the same image in its middle.
void enlarge(View& view) {
    const float height = static_cast<float>(view.size.y), larger = height + 2 * kAround;
    float& fov = view.camera.lens.verticalFovDegrees;
    fov = glm::degrees(2 * std::atan(std::tan(glm::radians(fov) / 2) * larger / height));
    view.size += 2 * kAround;
    view.effects.bloom.radius *= height / larger;
    view.effects.depthOfField.maxRadius *= height / larger;
    view.effects.depthOfField.blurScale *= larger / height; // the focal length is that of a wider lens
}

/// Of the pixels near the border, beside those of the larger image.
double rmsAtBorder(Image const& image, Image const& larger) {
    double sum = 0;
    uint32_t count = 0;
    for (uint32_t y = 0; y < kBandedSize.y; ++y) {
        for (uint32_t x = 0; x < kBandedSize.x; ++x) {
            const uint32_t away = std::min({ x, y, kBandedSize.x - 1 - x, kBandedSize.y - 1 - y });
            if (away >= kBorder) continue;
            const float3 off = float3(halfPixel(image, x, y)) - float3(halfPixel(larger, x + kAround, y + kAround));
            sum += static_cast<double>(dot(off, off)) / 3;
            ++count;
        }
    }
    return std::sqrt(sum / count);
}

TEST(GuardBand, MakesTheBorderThatOfTheMiddleOfALargerPicture) {
    for (auto const& [name, set] : kEffects) {
        const Image larger = drawn(Backend::Vulkan, [set = set](View& view) { set(view), enlarge(view); });
        const auto rms = [&, set = set](float width) {
            return rmsAtBorder(drawn(Backend::Vulkan,
                                     [&](View& view) {
                                         set(view);
                                         view.effects.guardBand = { .enabled = width > 0, .width = width };
                                     }),
                               larger);
        };
        const double without = rms(0), narrow = rms(0.1f), wide = rms(0.25f);
        RecordProperty(name, fmt::format("without {:.5f}, a tenth {:.5f}, a quarter {:.5f}", without, narrow, wide));
        EXPECT_GT(without, 1e-3) << name << ": the scene shows what it is about";
        EXPECT_LT(narrow, 0.8 * without) << name;
        EXPECT_LT(wide, 0.5 * without) << name;
    }
}

/// Motion blur has a band, but nothing moves.
TEST(GuardBand, ShowsTheSamePictureWhereNothingLooksAtNeighbours) {
    const auto plain = [](bool isOn) {
        return drawn(Backend::Gles, [isOn](View& view) {
            view.effects.guardBand.enabled = isOn;
            view.effects.motionBlur.enabled = true;
        });
    };
    const Image with = plain(true), without = plain(false);
    for (uint32_t y = 0; y < kBandedSize.y; ++y) {
        for (uint32_t x = 0; x < kBandedSize.x; ++x) {
            const float4 light = halfPixel(without, x, y);
            if (light.x > 1) continue; // the edges of the lamp
            EXPECT_NEAR(halfPixel(with, x, y).x, light.x, 0.02f * light.x + 0.002f) << x << " " << y;
        }
    }
}

TEST(GuardBand, HasTheSameBitsOnBothApisBesideEveryEffect) {
    std::vector<std::pair<const char*, Set>> sets(std::begin(kEffects), std::end(kEffects));
    sets.push_back({ "taa", [](View& view) { view.quality.antiAliasing = AntiAliasing::Taa; } });
    sets.push_back({ "fxaa and lens", [](View& view) {
                        view.quality.antiAliasing = AntiAliasing::Fxaa;
                        view.effects.vignette.enabled = view.effects.chromaticAberration.enabled = true;
                        view.effects.autoExposure.enabled = view.effects.grain.enabled = true;
                        view.effects.bloom.enabled = true;
                    } });
    sets.push_back({ "samples", [](View& view) {
                        view.samples = 4;
                        view.effects.bloom.enabled = true;
                        view.quality.msaaResolve = MsaaResolve::ToneAware;
                    } });
    sets.push_back({ "fewer pixels", [](View& view) {
                        view.effects.resolution.upscaling = Upscaling::EdgeAdaptive;
                        view.effects.resolution.scale = float2(0.6f, 0.8f);
                        view.effects.bloom.enabled = true;
                    } });
    for (auto const& [name, set] : sets) {
        std::vector<Image> images;
        for (const Backend backend : test::kBothApis)
            images.push_back(drawn(backend, [set = set](View& view) {
                set(view);
                view.effects.guardBand.enabled = true;
            }));
        EXPECT_EQ(images[0].width, kBandedSize.x);
        EXPECT_EQ(images[0].pixels, images[1].pixels) << name;
    }
}

/// Passes after the crop read only the image.
TEST(GuardBand, LeavesTheLensWhereItIs) {
    const auto vignetted = [](bool isOn) {
        return drawn(Backend::Vulkan, [isOn](View& view) {
            view.effects.vignette = { .enabled = true, .midPoint = 0.3f };
            view.effects.motionBlur.enabled = true; // of nothing: it has a band
            view.effects.guardBand.enabled = isOn;
        });
    };
    const Image with = vignetted(true), without = vignetted(false);
    for (const uint2 at : { uint2(1, 1), uint2(3, 40), uint2(60, 45) }) {
        const float light = halfPixel(without, at.x, at.y).x;
        EXPECT_NEAR(halfPixel(with, at.x, at.y).x, light, 0.02f * light + 0.002f) << at.x << " " << at.y;
    }
}

TEST(GuardBand, CostsNothingWhereNothingLooksBesideThePicture) {
    test::onBothApis([](MaterialStage& stage) {
        build(stage);
        Renderer renderer(stage.engine);
        stage.view.quality.antiAliasing = AntiAliasing::Fxaa;
        const Image plain = test::renderLinear(stage.engine, renderer, stage.scene, stage.view);
        const auto off = renderer.statistics();
        stage.view.effects.guardBand.enabled = true;
        EXPECT_EQ(test::renderLinear(stage.engine, renderer, stage.scene, stage.view).pixels, plain.pixels);
        EXPECT_EQ(renderer.statistics().passesRun, off.passesRun);
        EXPECT_NE(renderer.explain().find("nothing looks beside the picture"), std::string::npos) << renderer.explain();

        const MaterialInstance glass = stage.material(
                test::text("shadingModel : lit, refractionMode : screenspace", "material.transmission = 1.0;"),
                test::kNoLights);
        addSquare(stage, glass, { 0, 0, -9 }, { 0.1f, 0, 0 }, { 0, 0.1f, 0 });
        (void)test::renderLinear(stage.engine, renderer, stage.scene, stage.view);
        EXPECT_NE(renderer.explain().find("5 pixels on each side are drawn"), std::string::npos) << renderer.explain();
    });
}

TEST(GuardBand, CostsNothingOff) {
    test::onBothApis([](MaterialStage& stage) {
        build(stage);
        Renderer renderer(stage.engine);
        stage.view.effects.bloom.enabled = true;
        const Image plain = test::renderLinear(stage.engine, renderer, stage.scene, stage.view);
        const auto off = renderer.statistics();
        EXPECT_NE(renderer.explain().find("switched off: guardBand=off"), std::string::npos);
        stage.view.effects.guardBand = { .enabled = true, .width = 0 };
        EXPECT_EQ(test::renderLinear(stage.engine, renderer, stage.scene, stage.view).pixels, plain.pixels);
        EXPECT_EQ(renderer.statistics().passesRun, off.passesRun);
        EXPECT_NE(renderer.explain().find("its width is 0"), std::string::npos);
        stage.view.effects.guardBand.width = 0.1f;
        (void)test::renderLinear(stage.engine, renderer, stage.scene, stage.view);
        EXPECT_EQ(renderer.statistics().passesRun, off.passesRun + 1) << "the cut";
        EXPECT_NE(renderer.explain().find("5 pixels on each side are drawn and cut off"), std::string::npos)
                << renderer.explain();
        stage.view.debugView = DebugView::Lights;
        (void)test::renderLinear(stage.engine, renderer, stage.scene, stage.view);
        EXPECT_NE(renderer.explain().find("a debug view is shown"), std::string::npos);
    });
}

} // namespace
} // namespace filament_core
