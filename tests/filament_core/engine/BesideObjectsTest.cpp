// SPDX-License-Identifier: Apache-2.0
// Effects of what objects show draw only where objects may be (FramePacket::covered). An object without bounds has them
// draw everywhere; the images of both must be equal.
#include "tests/filament_core/engine/ShadowStage.h"
#include "tests/filament_core/engine/WhiteEnvironment.h"

namespace filament_core {
namespace {

using Resolution = AmbientOcclusionResolution;

/// Out of view, but not said to be.
void addUnbounded(test::ShadowStage const& stage, Scene& scene) {
    double4x4 behindCamera(0.1);
    behindCamera[3] = double4(0, 0, 100, 1);
    scene.add({ .vertices = stage.square.vertices(),
                .indices = stage.square.indices(),
                .material = stage.white,
                .bounds = Box{ double3(-1), double3(1) },
                .worldFromObject = behindCamera,
                .culled = false });
}

/// Some boxes around the origin, which the camera sees from +z.
void addBoxes(test::ShadowStage const& stage, Scene& scene, prepare::Random& random) {
    for (int i = 0; i < 4; ++i) {
        const double3 at(random.within(-0.6, 0.6), random.within(-0.6, 0.6), random.within(-0.6, 0.6));
        stage.addBox(scene, at, double3(random.within(0.1, 0.3)), random.within(0, 3));
    }
}

View viewOf(uint2 size, double x) {
    View view{ .camera = Camera::lookAt({ x, 0.4, 4 }, { x, 0, 0 }, { .verticalFovDegrees = 45 }), .size = size };
    view.quality.shadows = ShadowFilter::Off;
    return view;
}

Image display(Engine& engine, Scene const& scene, View const& view) {
    Renderer renderer(engine);
    Result<Image> image = renderer.renderToImage(scene, view);
    EXPECT_TRUE(image);
    return image ? std::move(*image) : Image{};
}

TEST(BesideObjects, AmbientOcclusionHasTheBitsOfOneThatIsDrawnEverywhere) {
    for (const Backend backend : test::kBothApis) {
        test::ShadowStage stage(backend);
        const WhiteEnvironment environment(stage.engine);
        prepare::Random random(11);
        for (uint32_t i = 0; i < 24; ++i) {
            View view = viewOf({ 61 + i % 3, 40 + i % 2 }, random.within(-1.8, 1.8)); // some are cut off by an edge
            view.effects.ambientOcclusion.enabled = true;
            view.effects.ambientOcclusion.method = i % 2 ? AmbientOcclusionMethod::Gtao : AmbientOcclusionMethod::Sao;
            view.effects.ambientOcclusion.resolution = i % 3 == 0   ? Resolution::Half
                                                       : i % 3 == 1 ? Resolution::Full
                                                                    : Resolution::Checkerboard;
            view.effects.ambientOcclusion.blur = i % 8 < 6;
            view.effects.ambientOcclusion.bentNormals = i % 5 < 2;
            view.samples = i % 7 == 3 ? 4 : 1;
            view.effects.ambientOcclusion.radiusMeters = static_cast<float>(random.within(0.05, 1));
            view.effects.ambientOcclusion.intensity = i % 4 == 3 ? 2.0f : 1.0f;
            Scene scene(stage.engine);
            environment.light(scene, view.camera);
            addBoxes(stage, scene, random);
            View debug = view;
            debug.debugView = DebugView::Occlusion;
            const Image shaded = test::renderLinear(stage.engine, scene, view),
                        visibility = display(stage.engine, scene, debug);
            addUnbounded(stage, scene);
            EXPECT_EQ(test::differingPixels(shaded, test::renderLinear(stage.engine, scene, view)), 0u) << i;
            EXPECT_EQ(visibility.pixels, display(stage.engine, scene, debug).pixels) << i;
        }
    }
}

/// Every texel of another light.
struct NoisySky {
    Owned<Texture> cube;
    Owned<Skybox> sky;

    NoisySky(Engine& engine, Scene& scene, View const& view) {
        constexpr uint32_t kSide = 64;
        std::vector<uint16_t> texels;
        prepare::Random random(3);
        for (uint32_t i = 0; i < 6 * kSide * kSide; ++i) {
            const uint16_t light = halfFromFloat(static_cast<float>(random.within(0, 1)));
            texels.insert(texels.end(), { light, light, light, halfFromFloat(1.0f) });
        }
        cube = engine.own(engine.create(TextureDesc{ .kind = TextureKind::Cube,
                                                     .format = Format::RGBA16F,
                                                     .width = kSide,
                                                     .height = kSide,
                                                     .layers = 6,
                                                     .pixels = std::as_bytes(std::span(texels)),
                                                     .name = "noise" }));
        sky = engine.own(engine.create(SkyboxDesc{ .cube = cube }));
        scene.setSkybox(sky, Lux{ 1 / view.camera.exposure.factor() });
    }
};

/// Left of `column`, and from it on.
std::array<size_t, 2> differencesBeside(uint32_t column, Image const& a, Image const& b) {
    std::array<size_t, 2> found{};
    for (uint32_t y = 0; y < a.height; ++y) {
        for (uint32_t x = 0; x < a.width; ++x)
            found[x >= column] += test::bytePixel(a, x, y) != test::bytePixel(b, x, y);
    }
    return found;
}

TEST(BesideObjects, FxaaCopiesTheSky) {
    std::vector<Image> pictures;
    for (const Backend backend : test::kBothApis) {
        for (const bool hasLens : { false, true }) {
            test::ShadowStage stage(backend);
            View view = viewOf({ 120, 80 }, -1.2); // boxes to the right
            view.effects.vignette.enabled = hasLens;
            Scene scene(stage.engine);
            const NoisySky sky(stage.engine, scene, view);
            prepare::Random random(11);
            addBoxes(stage, scene, random);
            const Image off = display(stage.engine, scene, view);
            view.quality.antiAliasing = AntiAliasing::Fxaa;
            const Image smooth = display(stage.engine, scene, view);
            addUnbounded(stage, scene);
            const Image everywhere = display(stage.engine, scene, view);
            const auto [sky1, object1] = differencesBeside(48, off, smooth);
            EXPECT_EQ(sky1, 0u) << "the sky is copied";
            EXPECT_GT(object1, 200u) << "edges are smoothed";
            const auto [sky2, object2] = differencesBeside(80, smooth, everywhere);
            EXPECT_GT(sky2, 500u) << "an object without bounds may have edges anywhere";
            pictures.push_back(smooth);
        }
    }
    EXPECT_EQ(pictures[0].pixels, pictures[2].pixels);
    EXPECT_EQ(pictures[1].pixels, pictures[3].pixels);
}

TEST(BesideObjects, FxaaKnowsWhereFringesAndSunsDiscsHaveEdges) {
    test::ShadowStage stage(Backend::Vulkan);
    View view = viewOf({ 120, 80 }, -1.2);
    Scene scene(stage.engine);
    const NoisySky sky(stage.engine, scene, view);
    prepare::Random random(11);
    addBoxes(stage, scene, random);
    const auto smoothsSky = [&] {
        view.quality.antiAliasing = AntiAliasing::Off;
        const Image off = display(stage.engine, scene, view);
        view.quality.antiAliasing = AntiAliasing::Fxaa;
        return differencesBeside(48, off, display(stage.engine, scene, view))[0] > 200;
    };
    EXPECT_FALSE(smoothsSky());
    view.effects.chromaticAberration.enabled = true;
    EXPECT_TRUE(smoothsSky());
    view.effects.chromaticAberration.enabled = false;
    EXPECT_FALSE(smoothsSky());
    scene.add(SunLight{ .directionWorld = { 0.2f, 0, 1 }, .showsDisc = true });
    EXPECT_TRUE(smoothsSky());
}

} // namespace
} // namespace filament_core
