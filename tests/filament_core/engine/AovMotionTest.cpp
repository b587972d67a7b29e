// SPDX-License-Identifier: Apache-2.0
// Motion and coverage as AOVs, on both APIs: beside their closed forms, and coverage beside the alpha of the frame.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/RenderAovs.h>

#include <array>
#include <cmath>
#include <set>

namespace filament_core {
namespace {

constexpr uint32_t kMotionSide = 32;

class MotionStage {
public:
    explicit MotionStage(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              scene(engine), renderer(engine), mesh(engine) {
        view.camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }, { .verticalFovDegrees = 90 });
        view.size = uint2(kMotionSide);
    }
    ~MotionStage() { test::expectNoErrors(engine); }

    MaterialInstance material(std::string const& properties, std::string const& code) {
        mMaterials.push_back(
                test::loadMaterial(engine, test::text("shadingModel : unlit" + properties, code), {}, test::kNoLights));
        mInstances.push_back(engine.own(engine.createInstance(mMaterials.back())));
        return mInstances.back();
    }
    Image draw(Aov aov) {
        Result<std::vector<Image>> images = renderAovs(renderer, scene, view, std::span(&aov, 1));
        if (images) return std::move(images->front());
        ADD_FAILURE() << images.error().message;
        return {};
    }

    Engine engine;
    Scene scene;
    Renderer renderer;
    View view;
    test::SquareMesh mesh;

private:
    std::vector<Owned<Material>> mMaterials;
    std::vector<Owned<MaterialInstance>> mInstances;
};

float4 fullPixel(Image const& image, uint32_t x, uint32_t y) {
    float4 pixel;
    std::memcpy(&pixel, image.pixels.data() + (size_t{ y } * image.width + x) * sizeof(pixel), sizeof(pixel));
    return pixel;
}

double4x4 placed(double3 at, double scale) {
    double4x4 world(scale);
    world[3] = double4(at, 1);
    return world;
}

// A wall 4 m away, and before it a square 2 m away that moves by itself; then the camera moves.
TEST(AovMotion, IsTheWayOnScreenSinceTheLastFrameOfItsRenderer) {
    const auto images = test::sameOnBothApis<MotionStage>([&](MotionStage& stage) {
        const MaterialInstance paint = stage.material("", "material.baseColor = vec4(0.5);");
        stage.mesh.add(stage.scene, paint, placed({ 0, 0, -4 }, 3));
        const Renderable square = stage.mesh.add(stage.scene, paint, placed({ 0, 0, -2 }, 0.6));
        std::vector<Image> all;
        all.push_back(stage.draw(Aov::Motion)); // the first
        (void)stage.draw(Aov::Depth);
        stage.scene.setTransform(square, placed({ 0.25, -0.125, -2 }, 0.6));
        (void)stage.draw(Aov::ObjectId);
        all.push_back(stage.draw(Aov::Motion));
        all.push_back(stage.draw(Aov::Motion)); // nothing moves
        stage.view.camera.worldFromView[3] += double4(0.5, 0, 0, 0);
        all.push_back(stage.draw(Aov::Motion));
        EXPECT_TRUE(stage.renderer.explain().find("a debug view shows no light") != std::string::npos);
        return all;
    });
    for (const size_t still : { size_t{ 0 }, size_t{ 2 } }) {
        EXPECT_EQ(fullPixel(images[still], 16, 16), float4(0, 0, 0, 1)) << still;
        EXPECT_EQ(fullPixel(images[still], 16, 4), float4(0, 0, 0, 1)) << still;
        EXPECT_EQ(fullPixel(images[still], 0, 0), float4(0)) << "no surface";
    }
    const auto near = [](float4 found, double2 pixels) {
        EXPECT_NEAR(found.x, pixels.x, 2e-5);
        EXPECT_NEAR(found.y, pixels.y, 2e-5);
        EXPECT_EQ(found.w, 1);
    };
    near(fullPixel(images[1], 18, 17), { 2, 1 }); // 16 pixels a metre, 1 m away
    near(fullPixel(images[1], 16, 4), { 0, 0 });
    near(fullPixel(images[3], 16, 16), { -4, 0 }); // the square
    near(fullPixel(images[3], 16, 5), { -2, 0 });  // the wall
}

TEST(AovMotion, OfWhatWasBehindTheCameraIsNowhere) {
    test::sameOnBothApis<MotionStage>([&](MotionStage& stage) {
        const MaterialInstance paint = stage.material("", "material.baseColor = vec4(0.5);");
        const Renderable square = stage.mesh.add(stage.scene, paint, placed({ 0, 0, 2 }, 0.6));
        (void)stage.draw(Aov::Motion);
        stage.scene.setTransform(square, placed({ 0, 0, -2 }, 0.6));
        std::vector<Image> images;
        images.push_back(stage.draw(Aov::Motion));
        EXPECT_EQ(fullPixel(images[0], 16, 16), float4(0, 0, 0, 0.5f));
        return images;
    });
}

// Frames with temporal anti-aliasing are the same with other AOVs of their renderer between them.
TEST(AovMotion, IsTheOnlyAovThatARendererRemembers) {
    test::sameOnBothApis<MotionStage>([&](MotionStage& stage) {
        const MaterialInstance paint = stage.material("", "material.baseColor = vec4(0.5);");
        const Renderable square = stage.mesh.add(stage.scene, paint, placed({ 0, 0, -2 }, 0.6));
        stage.view.quality.antiAliasing = AntiAliasing::Taa;
        std::vector<Image> frames;
        for (const bool hasNumbers : { false, true }) {
            Renderer other(stage.engine);
            for (int i = 0; i < 3; ++i) {
                stage.scene.setTransform(square, placed({ 0.1 * i, 0, -2 }, 0.6));
                Result<Image> frame = other.renderToImage(stage.scene, stage.view);
                constexpr std::array kOthers{ Aov::Depth, Aov::Coverage };
                if (hasNumbers && !renderAovs(other, stage.scene, stage.view, kOthers)) ADD_FAILURE();
                if (i == 2) frames.push_back(std::move(*frame));
            }
        }
        EXPECT_EQ(frames[0].pixels, frames[1].pixels);
        return frames;
    });
}

// The frame without a background leaves it in its alpha.
TEST(AovCoverage, IsTheAlphaOfTheFrameBeforeNothing) {
    for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
        test::sameOnBothApis<MotionStage>([&](MotionStage& stage) {
            const MaterialInstance paint = stage.material("", "material.baseColor = vec4(0.5, 0.5, 0.5, 1.0);");
            const MaterialInstance pane =
                    stage.material(", blending : transparent", "material.baseColor = vec4(0.25);");
            const MaterialInstance veil =
                    stage.material(", blending : fade", "material.baseColor = vec4(1.0, 1.0, 1.0, 0.5);");
            const MaterialInstance cut =
                    stage.material(", blending : masked, requires : [ uv0 ]",
                                   "material.baseColor = vec4(1.0 - abs(getUV0().x + 0.3 * getUV0().y - 0.6));");
            double4x4 turned = placed({ -0.5, 0.4, -1 }, 0.4);
            turned[0].y = 0.13, turned[1].x = -0.13;
            stage.mesh.add(stage.scene, paint, turned);
            stage.mesh.add(stage.scene, pane, placed({ 0.13, 0.31, -0.8 }, 0.41));
            stage.mesh.add(stage.scene, veil, placed({ 0.42, 0.11, -0.7 }, 0.3));
            stage.mesh.add(stage.scene, cut, placed({ -0.11, -0.52, -1 }, 0.43));
            stage.view.samples = samples;
            stage.view.clearColor = float4(0);
            const Image coverage = stage.draw(Aov::Coverage);
            const Image frame = test::renderLinear(stage.engine, stage.scene, stage.view);
            std::set<float> values;
            for (uint32_t y = 0; y < kMotionSide; ++y) {
                for (uint32_t x = 0; x < kMotionSide; ++x) {
                    const float4 found = fullPixel(coverage, x, y);
                    EXPECT_EQ(found, float4(found.x, 0, 0, found.x > 0 ? 1 : 0));
                    EXPECT_EQ(found.x, test::halfPixel(frame, x, y).w) << x << ' ' << y;
                    values.insert(found.x);
                }
            }
            EXPECT_TRUE(values.contains(0.25f) && values.contains(0.5f) && values.contains(0.625f));
            EXPECT_EQ(values.contains(0.75f), samples == 4) << "edges";
            return std::vector{ coverage };
        });
    }
}

} // namespace
} // namespace filament_core
