// SPDX-License-Identifier: Apache-2.0
// Reflection probes on both APIs: mirrored rays against the walls of a box by their closed form, shares of boxes,
// captures, and what a view leaves out.
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/ProbeCapture.h>
#include <glm/ext/matrix_transform.hpp>

#include <optional>

namespace filament_core {
namespace {

using namespace test;

constexpr uint32_t kMirrorSide = 16;
constexpr Sky kDimSurroundings{ float3(0.25f) };

const std::string& whiteMirror() {
    static const std::string kText =
            text("shadingModel : lit", "material.baseColor = vec4(1.0); material.metallic = 1.0; "
                                       "material.roughness = 0.0;");
    return kText;
}

/// What the box's cube shows in the direction of a point, in its own frame.
struct RoomBox {
    double3 center{ 0 };
    float3 halfExtent{ 1 };
    double3x3 worldFromBox{ 1.0 };
    float3 capture{ 0 };

    /// Of a ray that begins in the box.
    float3 seen(double3 from, double3 direction) const {
        const double3 local = (from - center) * worldFromBox, along = direction * worldFromBox;
        double length = 1e300;
        for (int axis = 0; axis < 3; ++axis) {
            const double wall = along[axis] > 0 ? halfExtent[axis] : -halfExtent[axis];
            if (along[axis] != 0) length = std::min(length, (wall - local[axis]) / along[axis]);
        }
        return kDirectionSky.radiance(float3(local + along * length) - capture);
    }
};

ReflectionProbeDesc probeOf(RoomBox const& box, SkyObjects const& cube) {
    return { .centerWorld = box.center,
             .halfExtentMeters = box.halfExtent,
             .worldFromBox = float3x3(box.worldFromBox),
             .captureInBoxMeters = box.capture,
             .light = cube.light };
}

/// A mirror around the z axis, seen from its front, under a dim sky; `add` adds probes.
template <class Add>
Image mirrorWith(double3 origin, Add&& add) {
    return onBothApis([&](MaterialStage& stage) {
        stage.view.size = uint2(kMirrorSide);
        stage.view.camera = Camera::lookAt(origin + double3(0, 0, 4), origin, { .verticalFovDegrees = 45 });
        stage.keep(std::make_shared<SkyObjects>(stage, kDimSurroundings));
        stage.add(stage.material(whiteMirror(), kNoLights), { {} }, glm::translate(double4x4(1.0), origin));
        const auto cube = std::make_shared<SkyObjects>(stage.engine, kDirectionSky);
        stage.keep(cube);
        add(stage, *cube);
    });
}

/// The nits of a texel of 1, for which pixels are radiances.
float nitsOfOne(MaterialStage const& stage) { return 1 / stage.view.camera.exposure.factor(); }

void expectMirrored(Image const& image, RoomBox const& box, double3 origin) {
    for (uint32_t y = 0; y < kMirrorSide; ++y) {
        for (uint32_t x = 0; x < kMirrorSide; ++x) {
            const double3 view(directionThrough(x, y, kMirrorSide));
            const double3 point = origin + double3(0, 0, 4) + view * (4 / -view.z);
            const float3 expected = box.seen(point, double3(view.x, view.y, -view.z));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(halfPixel(image, x, y)[c], expected[c], 0.03f) << x << ' ' << y;
        }
    }
}

TEST(ReflectionProbes, AMirrorShowsTheWallsOfItsBox) {
    const double3x3 turned(glm::rotate(double4x4(1.0), 0.5, glm::normalize(double3(1, 2, 3))));
    const std::array boxes{
        RoomBox{ .halfExtent = float3(2.5f, 2, 6) },
        RoomBox{ .center = { 0.5, 0, 1 }, .halfExtent = float3(3, 4, 2), .capture = { 0.2f, 1, -1 } },
        RoomBox{ .halfExtent = float3(4), .worldFromBox = turned, .capture = { 1, 0, 2 } }
    };
    for (RoomBox const& box : boxes) {
        const Image image = mirrorWith(double3(0), [&](MaterialStage& stage, SkyObjects const& cube) {
            ReflectionProbeDesc probe = probeOf(box, cube);
            probe.intensity = nitsOfOne(stage);
            stage.scene.add(probe);
        });
        expectMirrored(image, box, double3(0));
    }
}

TEST(ReflectionProbes, ItIsTheSameFarFromTheOrigin) {
    const double3 origin(1e6, -2e5, 3e6);
    RoomBox box{ .center = origin, .halfExtent = float3(2.5f, 2, 6) };
    const Image image = mirrorWith(origin, [&](MaterialStage& stage, SkyObjects const& cube) {
        ReflectionProbeDesc probe = probeOf(box, cube);
        probe.intensity = nitsOfOne(stage);
        stage.scene.add(probe);
    });
    expectMirrored(image, box, origin);
}

/// Of View::debugView = probes where the mirror is, without the grey of the image: all but black, orange and blue
/// where those two of the boxes give all light.
TEST(ReflectionProbes, TheDebugViewTintsPixelsByTheirBoxes) {
    const auto drawn = [](std::vector<RoomBox> const& boxes, uint8_t most = 8) {
        return onBothApis([&](MaterialStage& stage) {
            stage.view.size = uint2(kMirrorSide);
            stage.view.camera = Camera::lookAt({ 0, 0, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 10 });
            stage.view.debugView = DebugView::Probes;
            stage.view.quality.reflectionProbes = most;
            stage.keep(std::make_shared<SkyObjects>(stage, kDimSurroundings));
            stage.add(stage.material(whiteMirror(), kNoLights), { {} }, double4x4(1.0));
            const auto cube = std::make_shared<SkyObjects>(stage.engine, kDirectionSky);
            stage.keep(cube);
            for (RoomBox const& box : boxes) {
                ReflectionProbeDesc probe = probeOf(box, *cube);
                probe.blendMeters = 0;
                stage.scene.add(probe);
            }
        });
    };
    const auto expectHue = [&](Image const& image, uint32_t x, float3 srgb) {
        const float3 light = glm::max(float3(halfPixel(image, x, kMirrorSide / 2)), float3(0));
        const float3 code = glm::max(1.055f * glm::pow(light, float3(1 / 2.4f)) - 0.055f, float3(0));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(code[c] / code.y, srgb[c] / srgb.y, 0.1f) << x;
    };
    const float3 orange(230, 159, 0), blue(86, 180, 233), grey(153);
    const RoomBox left{ .center = { -1, 0, 0 }, .halfExtent = float3(1) };
    const RoomBox whole{ .halfExtent = float3(3) };
    const Image both = drawn({ whole, left });
    expectHue(both, 1, orange); // the smaller box comes first
    expectHue(both, kMirrorSide - 2, blue);
    expectHue(drawn({ left }), kMirrorSide - 2, grey);
    expectHue(drawn({}), 1, grey);
    expectHue(drawn({ whole, left }, 0), 1, grey);
}

TEST(ReflectionProbes, BeyondTheBlendDistanceTheEnvironmentIsReflected) {
    const Image image = mirrorWith(double3(0), [&](MaterialStage& stage, SkyObjects const& cube) {
        ReflectionProbeDesc probe = probeOf({ .center = { 0, 0, -4 }, .halfExtent = float3(9, 9, 3) }, cube);
        probe.intensity = 100 * nitsOfOne(stage);
        probe.blendMeters = 0.5f; // the mirror is a metre in front
        stage.scene.add(probe);
    });
    for (uint32_t i = 0; i < kMirrorSide; ++i) EXPECT_NEAR(halfPixel(image, i, i).x, 0.25f, 3e-3f);
}

TEST(ReflectionProbes, AProbeGivesLessAndLessOutsideOfItsBox) {
    const auto middle = [](float blend) {
        return halfPixel(mirrorWith(double3(0),
                                    [&](MaterialStage& stage, SkyObjects const&) {
                                        const auto white = std::make_shared<SkyObjects>(stage.engine, kWhiteSky);
                                        stage.keep(white);
                                        ReflectionProbeDesc probe = probeOf(
                                                { .center = { 0, 0, -4 }, .halfExtent = float3(9, 9, 3) }, *white);
                                        probe.intensity = nitsOfOne(stage);
                                        probe.blendMeters = blend;
                                        stage.scene.add(probe);
                                    }),
                         kMirrorSide / 2, kMirrorSide / 2)
                .x;
    };
    EXPECT_NEAR(middle(2), 0.5f + 0.5f * 0.25f, 4e-3f);
    EXPECT_NEAR(middle(4), 0.75f + 0.25f * 0.25f, 4e-3f);
}

TEST(ReflectionProbes, TheInnerOfTwoBoxesCoversTheOuterAndTheOrderOfAddingDoesNotCount) {
    const auto drawn = [](bool innerFirst) {
        return mirrorWith(double3(0), [&](MaterialStage& stage, SkyObjects const& cube) {
            const auto white = std::make_shared<SkyObjects>(stage.engine, kWhiteSky);
            stage.keep(white);
            ReflectionProbeDesc inner = probeOf({ .halfExtent = float3(2, 2, 1) }, *white);
            ReflectionProbeDesc outer = probeOf({ .halfExtent = float3(9) }, cube);
            inner.intensity = outer.intensity = nitsOfOne(stage);
            if (innerFirst) stage.scene.add(inner);
            stage.scene.add(outer);
            if (!innerFirst) stage.scene.add(inner);
        });
    };
    const Image first = drawn(true);
    EXPECT_EQ(first.pixels, drawn(false).pixels);
    for (uint32_t i = 0; i < kMirrorSide; ++i) EXPECT_NEAR(halfPixel(first, i, i).x, 1, 5e-3f);
}

TEST(ReflectionProbes, DiffuseLightIsThatOfTheProbeUnlessItHasNone) {
    const auto middle = [](bool lightsDiffuse) {
        return centerPixel(onBothApis([&](MaterialStage& stage) {
                   stage.view.size = { 9, 9 };
                   stage.keep(std::make_shared<SkyObjects>(stage, kDimSurroundings));
                   const auto white = std::make_shared<SkyObjects>(stage.engine, kWhiteSky);
                   stage.keep(white);
                   stage.add(stage.material(text("shadingModel : lit",
                                                 "material.baseColor = vec4(1.0); material.roughness = 1.0; "
                                                 "material.reflectance = 0.0;"),
                                            kNoLights),
                             { {} });
                   ReflectionProbeDesc probe = probeOf({ .halfExtent = float3(9) }, *white);
                   probe.intensity = nitsOfOne(stage);
                   probe.lightsDiffuse = lightsDiffuse;
                   stage.scene.add(probe);
               }))
                .x;
    };
    EXPECT_NEAR(middle(true), 1, 0.01f);
    EXPECT_NEAR(middle(false), 0.25f, 0.01f);
}

TEST(ReflectionProbes, AProbeLightsASceneWithoutAnEnvironment) {
    const Image image = onBothApis([&](MaterialStage& stage) {
        const auto white = std::make_shared<SkyObjects>(stage.engine, kWhiteSky);
        stage.keep(white);
        stage.add(stage.material(whiteMirror(), kNoLights), { {} });
        ReflectionProbeDesc probe = probeOf({ .halfExtent = float3(9) }, *white);
        probe.intensity = nitsOfOne(stage);
        stage.scene.add(probe);
    });
    EXPECT_NEAR(centerPixel(image).x, 1, 5e-3f);
}

// ------------------------------------------------------------------------------------------------ demand

TEST(ReflectionProbes, OutOfViewTheyChangeNothing) {
    const auto drawn = [](bool hasProbe) {
        return mirrorWith(double3(0), [&](MaterialStage& stage, SkyObjects const& cube) {
            if (!hasProbe) return;
            stage.scene.add(probeOf({ .center = { 0, 0, 20 } }, cube)); // behind the camera
            Renderer renderer(stage.engine);
            EXPECT_TRUE(renderer.renderToImage(stage.scene, stage.view));
            for (EffectDecision const& one : renderer.decisions()) {
                if (one.name != "reflection probes") continue;
                EXPECT_EQ(one.state, EffectDecision::State::NotNeeded);
                EXPECT_EQ(one.reason, "none of 1 reaches a lit surface in view");
            }
        });
    };
    EXPECT_EQ(drawn(true).pixels, drawn(false).pixels);
}

TEST(ReflectionProbes, AViewUsesTheNearestAndSaysWhichItLeavesOut) {
    mirrorWith(double3(0), [&](MaterialStage& stage, SkyObjects const& cube) {
        std::vector<ReflectionProbe> added;
        for (uint32_t i = 0; i < ReflectionProbeDesc::kMaxOfView + 1; ++i) {
            ReflectionProbeDesc probe = probeOf({ .center = { 0, 0, -0.1 * i } }, cube);
            probe.name = fmt::format("number {}", i);
            added.push_back(stage.scene.add(probe));
        }
        const Owned<Texture> other = stage.engine.own(stage.engine.create(TextureDesc{
                .kind = TextureKind::Cube, .format = Format::RGBA16F, .width = 8, .height = 8, .layers = 6 }));
        const Owned<IndirectLight> small =
                stage.engine.own(stage.engine.create(IndirectLightDesc{ .specular = other }));
        stage.scene.add({ .light = small, .name = "small" });
        Renderer renderer(stage.engine);
        ASSERT_TRUE(renderer.renderToImage(stage.scene, stage.view));
        const std::string text = renderer.explain();
        EXPECT_NE(text.find("'number 0': used"), std::string::npos) << text;
        EXPECT_NE(text.find("'number 8': not used: others in view are nearer"), std::string::npos) << text;
        EXPECT_NE(text.find("'small': not used: its cube has another size"), std::string::npos) << text;
        EXPECT_NE(text.find("8 light surfaces in view; 2 reach some and are not used"), std::string::npos) << text;
        for (const ReflectionProbe probe : added) stage.scene.remove(probe);
        EXPECT_EQ(stage.scene.reflectionProbeCount(), 1u);
        ASSERT_TRUE(renderer.renderToImage(stage.scene, stage.view));
        EXPECT_NE(renderer.explain().find("1 reach surfaces in view, and none of them can be used"), std::string::npos);
    });
}

TEST(ReflectionProbes, CubesStayInTheArrayWhileOthersComeAndGo) {
    const auto last = [](bool hasHistory) {
        std::optional<Image> image;
        onBothApis([&](MaterialStage& stage) {
            stage.view.size = uint2(kMirrorSide);
            stage.keep(std::make_shared<SkyObjects>(stage, kDimSurroundings));
            stage.add(stage.material(whiteMirror(), kNoLights), { {} });
            const auto one = std::make_shared<SkyObjects>(stage.engine, kDirectionSky),
                       other = std::make_shared<SkyObjects>(stage.engine, kWhiteSky);
            stage.keep(one);
            stage.keep(other);
            ReflectionProbeDesc left = probeOf({ .center = { -1, 0, 0 } }, *one),
                                right = probeOf({ .center = { 1, 0, 0 } }, *other);
            left.intensity = right.intensity = nitsOfOne(stage);
            Renderer renderer(stage.engine);
            if (hasHistory) {
                const ReflectionProbe first = stage.scene.add(left);
                EXPECT_TRUE(renderer.renderToImage(stage.scene, stage.view));
                const ReflectionProbe second = stage.scene.add(right);
                EXPECT_TRUE(renderer.renderToImage(stage.scene, stage.view));
                stage.scene.remove(first);
                EXPECT_TRUE(renderer.renderToImage(stage.scene, stage.view));
                stage.scene.remove(second);
                EXPECT_TRUE(renderer.renderToImage(stage.scene, stage.view));
            }
            stage.scene.add(right);
            stage.scene.add(left);
            Result<Image> drawn = renderer.renderToImage(stage.scene, stage.view);
            ASSERT_TRUE(drawn);
            image = std::move(*drawn);
        });
        return image;
    };
    const std::optional<Image> fresh = last(false), kept = last(true);
    ASSERT_TRUE(fresh && kept);
    EXPECT_EQ(fresh->pixels, kept->pixels);
}

// ------------------------------------------------------------------------------------------------ capture

TEST(ReflectionProbes, ACaptureSeesWhatIsThere) {
    const Image image = onBothApis([&](MaterialStage& stage) {
        // The sky alone, whose background shows directions as colours, captured along a turned box.
        const auto sky = std::make_shared<SkyObjects>(stage.engine, kDirectionSky);
        stage.keep(sky);
        const auto skybox =
                std::make_shared<Owned<Skybox>>(stage.engine.own(stage.engine.create(SkyboxDesc{ .cube = sky->cube })));
        stage.keep(skybox);
        Scene around(stage.engine);
        around.setSkybox(*skybox, Lux{ nitsOfOne(stage) });
        ReflectionProbeDesc place = probeOf({ .halfExtent = float3(1e6f) }, *sky);
        place.worldFromBox = float3x3(double3x3(glm::rotate(double4x4(1.0), 0.7, double3(0, 1, 0))));
        const Result<ProbeCapture> captured = captureProbe(stage.engine, around, place, { .faceSize = 64 });
        ASSERT_TRUE(captured) << captured.error().message;
        EXPECT_FLOAT_EQ(captured->intensity, nitsOfOne(stage));
        Result<Environment> light =
                loadEnvironment(stage.engine, captured->ktx2, "capture", { .faceSize = 64, .samples = 64 });
        ASSERT_TRUE(light) << light.error().message;
        const auto kept = std::make_shared<Environment>(std::move(*light));
        stage.keep(kept);
        stage.view.size = uint2(kMirrorSide);
        stage.add(stage.material(whiteMirror(), kNoLights), { {} });
        place.light = kept->indirectLight();
        place.intensity = captured->intensity;
        stage.scene.add(place);
    });
    for (uint32_t y = 0; y < kMirrorSide; ++y) {
        for (uint32_t x = 0; x < kMirrorSide; ++x) {
            const float3 view = directionThrough(x, y, kMirrorSide);
            const float3 expected = kDirectionSky.radiance(float3(view.x, view.y, -view.z));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(halfPixel(image, x, y)[c], expected[c], 0.04f) << x << ' ' << y;
        }
    }
}

} // namespace
} // namespace filament_core
