// SPDX-License-Identifier: Apache-2.0
// Light of volumetric fog that is kept from frame to frame (Fog::volumetricFrames) on both APIs: when it is that of the
// frame, what a moving camera leaves of it, and when it begins anew.
#include "tests/filament_core/engine/VolumetricFogStage.h"

#include <functional>

namespace filament_core {
namespace {

using namespace test;

const double3 kLampOfFrames(0.4, 0.3, 0.5);

/// draw(stage, frame) changes the stage before each of the frames; the last image.
Image lastOfFrames(Fog const& fog, int frames, std::function<void(MaterialStage&, int)> const& change) {
    std::vector<Image> images;
    for (const Backend backend : kBothApis) {
        auto engine = makeEngine(backend);
        if (!engine) return {};
        MaterialStage stage(*engine);
        Renderer renderer(*engine);
        stage.view.size = uint2(kCellsSide);
        stage.view.quality.shadows = ShadowFilter::Off;
        stage.view.effects.fog = fog;
        stage.scene.add(PointLight{ .positionWorld = kLampOfFrames,
                                    .intensity = Candela{ 2 / stage.view.camera.exposure.factor() } });
        addPlane(stage, stage.material(paintText("")), 6);
        for (int frame = 0; frame < frames; ++frame) {
            change(stage, frame);
            Image image = renderLinear(*engine, renderer, stage.scene, stage.view);
            if (frame + 1 == frames) images.push_back(std::move(image));
        }
        expectNoErrors(*engine);
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels) << "not the same bits on both APIs";
    return images[0];
}

const auto kStill = [](MaterialStage&, int) {};

double meanLight(Image const& image) {
    double sum = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) sum += double(halfPixel(image, x, y).x);
    return sum / (image.width * image.height);
}

Fog fogOfFrames(uint8_t frames, uint8_t pixels) {
    Fog fog = volumetricFog(0.2f, 0);
    fog.color = { 0, 0, 0 };
    fog.volumetricPixels = pixels;
    fog.volumetricFrames = frames;
    return fog;
}

TEST(FogOverFrames, AStillCameraSeesTheLightOfEveryCell) {
    const Image alone = lastOfFrames(fogOfFrames(1, 8), 1, kStill);
    for (const int frames : { 1, 24 }) {
        const Image kept = lastOfFrames(fogOfFrames(8, 8), frames, kStill);
        for (uint32_t y = 4; y < kCellsSide; y += 8)
            for (uint32_t x = 4; x < kCellsSide; x += 8)
                EXPECT_NEAR(halfPixel(kept, x, y).x, halfPixel(alone, x, y).x, 2e-3f * halfPixel(alone, x, y).x);
    }
}

/// What a lamp leaves in the fog when it is switched off.
TEST(FogOverFrames, AChangeArrivesWithinTheFrames) {
    const auto afterwards = [](int frames) {
        return meanLight(lastOfFrames(fogOfFrames(4, 8), 8 + frames, [](MaterialStage& stage, int frame) {
            if (frame == 8) stage.view.effects.fog.albedo = float3(0);
        }));
    };
    const double lit = afterwards(0), dark = meanLight(lastOfFrames(fogOfFrames(1, 8), 1, [](MaterialStage&stage, int) {
                                          stage.view.effects.fog.albedo = float3(0);
                                      }));
    const double one = afterwards(1), many = afterwards(16);
    EXPECT_LT(one, lit - 0.05 * (lit - dark));
    EXPECT_GT(one, dark + 0.2 * (lit - dark)) << "not all at once: most cells keep their light";
    EXPECT_NEAR(many, dark, 1e-3 * lit);
}

TEST(FogOverFrames, AMovingCameraFindsTheLightWhereItWas) {
    const Fog fog = fogOfFrames(16, 8);
    const auto placed = [](MaterialStage& stage, double x) {
        stage.view.camera = Camera::lookAt({ x, 0, 4 }, { x, 0, 0 }, { .verticalFovDegrees = 45 });
    };
    const Image still = lastOfFrames(fog, 32, kStill);
    const Image moved =
            lastOfFrames(fog, 32, [&](MaterialStage& stage, int frame) { placed(stage, (31 - frame) * -0.05); });
    const Image lost =
            lastOfFrames(fog, 32, [&](MaterialStage& stage, int frame) { placed(stage, frame < 31 ? -1.55 : 0.0); });
    double differs = 0, jumps = 0, all = 0;
    for (uint32_t y = 4; y < kCellsSide; y += 8) {
        for (uint32_t x = 4; x < kCellsSide; x += 8) {
            const double3 direction(directionThrough(x, y, kCellsSide));
            // Near the lamp its light changes within a cell.
            if (glm::length(glm::cross(direction, kLampOfFrames - double3(0, 0, 4))) < 0.6) continue;
            all += double(halfPixel(still, x, y).x);
            differs += std::abs(double(halfPixel(moved, x, y).x) - double(halfPixel(still, x, y).x));
            jumps += std::abs(double(halfPixel(lost, x, y).x) - double(halfPixel(still, x, y).x));
        }
    }
    EXPECT_LT(differs, 0.03 * all);
    EXPECT_LT(jumps, 0.04 * all) << "what was seen from elsewhere is known, too";
}

TEST(FogOverFrames, BeginsAnewWithOtherCells) {
    const Fog fog = fogOfFrames(16, 8);
    const Image first = lastOfFrames(fog, 1, kStill);
    const auto after = [&](std::function<void(View&)> const& differently) {
        return lastOfFrames(fog, 5, [&](MaterialStage& stage, int frame) {
            const double x = frame < 4 ? -0.3 : 0.0;
            stage.view.camera = Camera::lookAt({ x, 0, 4 }, { x, 0, 0 }, { .verticalFovDegrees = 45 });
            stage.view.size = uint2(kCellsSide);
            stage.view.effects.fog = fog;
            if (frame < 4) differently(stage.view);
        });
    };
    EXPECT_NE(after([](View&) {}).pixels, first.pixels);
    EXPECT_EQ(after([](View& view) { view.size = { 40, 64 }; }).pixels, first.pixels);
    EXPECT_EQ(after([](View& view) { view.effects.fog.volumetricSlices = 31; }).pixels, first.pixels);
    EXPECT_EQ(after([](View& view) { view.effects.fog.volumetricFrames = 1; }).pixels, first.pixels);
    EXPECT_EQ(after([](View& view) { view.effects.fog.enabled = false; }).pixels, first.pixels);
}

TEST(FogOverFrames, AnotherExposureKeepsTheLight) {
    const Fog fog = fogOfFrames(16, 8);
    const Image still = lastOfFrames(fog, 8, kStill);
    const Image adapted = lastOfFrames(fog, 8, [](MaterialStage& stage, int frame) {
        if (frame == 0) stage.view.camera.exposure.iso *= 4;
        if (frame == 7) stage.view.camera.exposure.iso /= 4;
    });
    for (uint32_t x = 4; x < kCellsSide; x += 8)
        EXPECT_NEAR(halfPixel(adapted, x, 28).x, halfPixel(still, x, 28).x, 3e-3f * halfPixel(still, x, 28).x + 1e-3f);
}

} // namespace
} // namespace filament_core
