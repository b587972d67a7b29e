// SPDX-License-Identifier: Apache-2.0
// FXAA, subpixel reconstruction and temporal anti-aliasing beside supersampling: how near they come to it, still and in
// motion, and that they cost nothing and change nothing where there is nothing to smooth.
#include "tests/filament_core/engine/Fan.h"

#include <cmath>

namespace filament_core {
namespace {

using test::Fan;
using test::halfPixel;
using test::rmsBetween;

TEST(Taa, OfAStillCameraConvergesToSupersampling) {
    Fan fan(Backend::Vulkan);
    const Image exact = fan.supersampled();
    const double without = rmsBetween(fan.draw(), exact);
    fan.view.quality.antiAliasing = AntiAliasing::Taa;
    std::vector<double> errors;
    for (int frame = 1; frame <= 64; ++frame) errors.push_back(rmsBetween(fan.draw(), exact));
    EXPECT_EQ(errors[0], without) << "the first frame is seen from the middle of its pixels";
    EXPECT_LT(errors[7], 0.4 * without);
    EXPECT_LT(errors[15], 0.3 * without);
    EXPECT_LT(errors[63], 0.01);
}

TEST(Taa, InMotionIsNearerToSupersamplingThanFxaaAndNothing) {
    for (auto const& [name, move] : test::kFanMotions) {
        const auto flipOf = [move = move](AntiAliasing choice) {
            return test::flipInMotion([&](View& view) { view.quality.antiAliasing = choice; }, move);
        };
        const double off = flipOf(AntiAliasing::Off), fxaa = flipOf(AntiAliasing::Fxaa),
                     taa = flipOf(AntiAliasing::Taa);
        EXPECT_LT(taa, fxaa) << name;
        EXPECT_LT(taa, off) << name;
        RecordProperty(name, fmt::format("off {:.4f}, fxaa {:.4f}, taa {:.4f}", off, fxaa, taa));
    }
}

/// What the camera, objects, and both do in 30 frames.
TEST(Taa, GathersTheSameBitsOnBothApisWhateverMoves) {
    std::vector<Image> last;
    for (const Backend backend : test::kBothApis) {
        Fan fan(backend);
        fan.view.quality.antiAliasing = AntiAliasing::Taa;
        for (int frame = 0; frame < 30; ++frame) {
            if (frame >= 5 && frame < 15) fan.turn(0.2 * frame);
            if (frame >= 10 && frame < 25) fan.turnBars(0.5 * frame);
            last.push_back(fan.draw());
        }
    }
    for (size_t frame = 0; frame < 30; ++frame)
        EXPECT_EQ(test::differingPixels(last[frame], last[30 + frame]), 0u) << frame;
}

/// What an object leaves behind is no longer seen: its history is not that of what it uncovers.
TEST(Taa, LeavesNoGhosts) {
    Fan fan(Backend::Vulkan);
    fan.view.quality.antiAliasing = AntiAliasing::Taa;
    for (int frame = 0; frame < 8; ++frame) fan.draw();
    double worst = 0;
    for (int frame = 0; frame < 8; ++frame) {
        fan.turnBars(4.0 * frame);
        worst = std::max(worst, rmsBetween(fan.draw(), fan.supersampled()));
    }
    fan.view.quality.antiAliasing = AntiAliasing::Off;
    EXPECT_LT(worst, 1.1 * rmsBetween(fan.draw(), fan.supersampled()));
}

TEST(Taa, ForgetsAnotherSceneAndAnotherSize) {
    Fan fan(Backend::Vulkan);
    fan.view.quality.antiAliasing = AntiAliasing::Taa;
    for (int frame = 0; frame < 4; ++frame) fan.draw();
    Scene empty(fan.engine);
    fan.view.clearColor = float4(0.25f, 0.5f, 1, 1);
    const Owned<SwapChain> target = fan.engine.own(
            fan.engine.create(SwapChainDesc{ .size = fan.view.size, .imageCount = 1, .format = Format::RGBA16F }));
    fan.renderer.render(empty, fan.view, target);
    fan.view.size = { 50, 40 };
    Renderer fresh(fan.engine);
    EXPECT_EQ(rmsBetween(fan.draw(), fan.draw(fresh)), 0.0);
}

/// Vertices of the domain `device` are where their material puts them, and have smooth edges if it says that the jitter
/// moves them. The square ends at 21.28 of 32 pixels.
TEST(Taa, SmoothsTheEdgesOfTheDeviceDomainWhereTheJitterMovesThem) {
    for (const bool isJittered : { false, true }) {
        const std::string text =
                fmt::format("material {{ name : stage, shadingModel : unlit, culling : none, vertexDomain : device, "
                            "vertexDomainDeviceJittered : {} }}\n"
                            "vertex {{ void materialVertex(inout MaterialVertexInputs material) {{\n"
                            "material.clipSpaceTransform[0].x = 0.33; material.clipSpaceTransform[3].z = 0.5; }} }}\n"
                            "fragment {{ void material(inout MaterialInputs material) {{ prepareMaterial(material);\n"
                            "material.baseColor = vec4(1.0); }} }}",
                            isJittered);
        std::vector<Image> images;
        for (const Backend backend : test::kBothApis) {
            test::SquareStage stage(backend, text);
            Scene scene(stage.engine);
            stage.square.add(scene, stage.instance);
            View view = test::SquareMesh::view({ 32, 8 });
            view.quality.antiAliasing = AntiAliasing::Taa;
            Renderer renderer(stage.engine);
            const Owned<SwapChain> target = stage.engine.own(stage.engine.create(
                    SwapChainDesc{ .size = view.size, .imageCount = 1, .format = Format::RGBA16F }));
            for (int frame = 0; frame < 64; ++frame) renderer.render(scene, view, target);
            images.push_back(std::move(*renderer.waitPixels(renderer.readPixels(target))));
        }
        EXPECT_EQ(images[0].pixels, images[1].pixels);
        EXPECT_NEAR(halfPixel(images[0], 21, 4).x, isJittered ? 0.28f : 0.0f, 0.02f);
        EXPECT_NEAR(halfPixel(images[0], 20, 4).x, 1, 1e-3f);
    }
}

TEST(Fxaa, SmoothsEdgesAndLeavesEvenSurfacesAlone) {
    std::vector<Image> smooth;
    for (const Backend backend : test::kBothApis) {
        Fan fan(backend);
        const Image off = fan.draw(), exact = fan.supersampled();
        fan.view.quality.antiAliasing = AntiAliasing::Fxaa;
        smooth.push_back(fan.draw());
        EXPECT_LT(rmsBetween(smooth.back(), exact), 0.8 * rmsBetween(off, exact));
        EXPECT_EQ(halfPixel(smooth.back(), 2, 2), halfPixel(off, 2, 2)) << "the wall";
    }
    EXPECT_EQ(test::differingPixels(smooth[0], smooth[1]), 0u);
}

TEST(Fxaa, HasTheSameBitsOnBothApisForDisplays) {
    for (const bool dither : { false, true }) {
        std::vector<Image> images;
        for (const Backend backend : test::kBothApis) {
            Fan fan(backend);
            fan.view.display.dither = dither;
            fan.view.quality.antiAliasing = AntiAliasing::Fxaa;
            images.push_back(std::move(*fan.renderer.renderToImage(fan.scene, fan.view)));
        }
        EXPECT_EQ(images[0].pixels, images[1].pixels) << dither;
    }
}

/// Edges of every slope, some of bars thinner than a pixel.
TEST(Sraa, IsNearerToSupersamplingThanFourSamples) {
    std::vector<Image> smooth;
    for (const Backend backend : test::kBothApis) {
        Fan fan(backend);
        const Image exact = fan.supersampled();
        fan.view.samples = 4;
        const double ofSamples = rmsBetween(fan.draw(), exact);
        fan.view.samples = 1;
        fan.view.quality.antiAliasing = AntiAliasing::Sraa;
        smooth.push_back(fan.draw());
        const double error = rmsBetween(smooth.back(), exact);
        EXPECT_LT(error, ofSamples);
        EXPECT_GT(ofSamples, 0.02) << "not all edges are gone";
        RecordProperty(toString(backend), fmt::format("four samples {:.4f}, sraa {:.4f}", ofSamples, error));
    }
    EXPECT_EQ(test::differingPixels(smooth[0], smooth[1]), 0u);
}

/// In motion, too, and whichever way depths grow.
TEST(Sraa, HasTheSameBitsOnBothApisWithEitherDepthRange) {
    for (const DepthRange range : { DepthRange::Reversed, DepthRange::Ordinary }) {
        std::vector<Image> images;
        for (const Backend backend : test::kBothApis) {
            Fan fan(backend);
            fan.view.quality.antiAliasing = AntiAliasing::Sraa;
            fan.view.quality.depthRange = range;
            fan.turnBars(2);
            images.push_back(fan.draw());
            fan.view.quality.antiAliasing = AntiAliasing::Off;
            const Image off = fan.draw(), exact = fan.supersampled();
            EXPECT_LT(rmsBetween(images.back(), exact), 0.5 * rmsBetween(off, exact));
        }
        EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u);
    }
}

/// What is shaded is not blurred: pixels of one surface keep their bits.
TEST(Sraa, LeavesPixelsOfOneSurfaceAlone) {
    Fan fan(Backend::Gles);
    const Image off = fan.draw();
    fan.view.quality.antiAliasing = AntiAliasing::Sraa;
    const Image smooth = fan.draw();
    EXPECT_EQ(halfPixel(smooth, 2, 2), halfPixel(off, 2, 2)) << "the wall";
    EXPECT_LT(test::differingPixels(smooth, off), test::kFanSize.x * test::kFanSize.y / 3);
}

TEST(Sraa, DoesNothingBesideSeveralSamplesAndInViewsThatAreTooLarge) {
    Fan fan(Backend::Vulkan);
    fan.view.samples = 4;
    const Image samples = fan.draw();
    fan.view.quality.antiAliasing = AntiAliasing::Sraa;
    EXPECT_EQ(test::differingPixels(fan.draw(), samples), 0u);
    EXPECT_NE(fan.renderer.explain().find("4 samples a pixel smooth edges already"), std::string::npos);
    fan.view.samples = 1;
    fan.view.size = { 16384, 1 };
    fan.draw();
    EXPECT_NE(fan.renderer.explain().find("too large for 4 depths a pixel on this device"), std::string::npos);
}

/// One texel of the scene colour that is NaN, or the largest number.
TEST(AntiAliasing, ContainsBrokenTexels) {
    for (const AntiAliasing antiAliasing : { AntiAliasing::Fxaa, AntiAliasing::Taa, AntiAliasing::Sraa }) {
        for (const char* light : { "1e30", "log(-1.0 - getUserTime().x)", "1.0 / getUserTime().x" }) {
            std::vector<Image> images;
            for (const Backend backend : test::kBothApis) {
                auto engine = test::makeEngine(backend);
                ASSERT_TRUE(engine);
                const test::SquareMesh square(*engine);
                const Owned<Material> material = test::loadMaterial(
                        *engine, test::text("shadingModel : unlit",
                                            "material.baseColor = vec4(vec3(ivec2(gl_FragCoord.xy) == ivec2(7, 9) && "
                                            "getUserTime().x == 0.0 ? " +
                                                    std::string(light) + " : 0.5), 1.0);"));
                const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
                Scene scene(*engine);
                square.add(scene, instance, double3(0), 4);
                View view{ .camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, {}), .size = { 17, 19 } };
                view.quality.antiAliasing = antiAliasing;
                Renderer renderer(*engine);
                const Owned<SwapChain> target = engine->own(
                        engine->create(SwapChainDesc{ .size = view.size, .imageCount = 1, .format = Format::RGBA16F }));
                for (int frame = 0; frame < 2; ++frame) {
                    view.timeSeconds = frame;
                    renderer.render(scene, view, target);
                    images.push_back(std::move(*renderer.waitPixels(renderer.readPixels(target))));
                }
                for (uint32_t i = 0; i < 17 * 19; ++i) {
                    const uint32_t x = i % 17, y = i / 17;
                    const bool isBeside = std::abs(int(x) - 7) <= 1 && std::abs(int(y) - 9) <= 1;
                    EXPECT_TRUE(isBeside || halfPixel(images[images.size() - 2], x, y).x == 0.5f) << x << " " << y;
                    EXPECT_NEAR(halfPixel(images.back(), x, y).x, 0.5f, 2e-3f) << light << ": gone with the next frame";
                }
                test::expectNoErrors(*engine);
            }
            EXPECT_EQ(test::differingPixels(images[1], images[3]), 0u) << light;
        }
    }
}

TEST(AntiAliasing, IsFiniteInAllSizes) {
    for (const AntiAliasing antiAliasing : { AntiAliasing::Fxaa, AntiAliasing::Taa, AntiAliasing::Sraa }) {
        for (const uint2 size : { uint2(1, 1), uint2(2, 3), uint2(16384, 1), uint2(1, 300) }) {
            Fan fan(Backend::Gles);
            fan.view.quality.antiAliasing = antiAliasing;
            fan.view.size = size;
            fan.draw();
            fan.turn(1);
            EXPECT_GE(test::extremesOf(fan.draw()).least, 0.0f);
        }
    }
}

/// The passes of a frame, and what explain() says.
void expectNothing(Fan& fan, Scene const& scene, AntiAliasing antiAliasing, const char* reason) {
    fan.view.quality.antiAliasing = AntiAliasing::Off;
    const Image before = std::move(*fan.renderer.renderToImage(scene, fan.view));
    const FrameStatistics off = fan.renderer.statistics();
    fan.view.quality.antiAliasing = antiAliasing;
    (void)fan.renderer.renderToImage(scene, fan.view);
    const Image after = std::move(*fan.renderer.renderToImage(scene, fan.view));
    EXPECT_EQ(fan.renderer.statistics().passesRun, off.passesRun);
    EXPECT_EQ(fan.renderer.statistics().draws, off.draws);
    EXPECT_EQ(before.pixels, after.pixels);
    EXPECT_NE(fan.renderer.explain().find(reason), std::string::npos) << fan.renderer.explain();
}

TEST(AntiAliasing, CostsNothingWithoutEdges) {
    for (const Backend backend : test::kBothApis) {
        Fan fan(backend);
        Scene empty(fan.engine);
        expectNothing(fan, empty, AntiAliasing::Taa, "nothing is visible, not even a sky");
        expectNothing(fan, empty, AntiAliasing::Sraa, "nothing is visible, not even a sky");
        expectNothing(fan, empty, AntiAliasing::Fxaa, "nothing is visible, not even a sky");
        expectNothing(fan, fan.scene, AntiAliasing::Off, "switched off: antiAliasing");
    }
}

} // namespace
} // namespace filament_core
