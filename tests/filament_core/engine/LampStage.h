// SPDX-License-Identifier: Apache-2.0
/// LampStage: a square of one light in front of black, seen by a camera whose image is 2 m high: what bloom and lens
/// flare scatter lies where closed forms say.
#pragma once

#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <functional>

namespace filament_core::test {

class LampStage {
public:
    /// The square is 2 * side m wide; none if that is 0.
    LampStage(Backend backend, float light, double side, double2 at = double2(0))
            : LampStage(backend, fmt::format("vec3({:.3f})", light), side, at) {}
    LampStage(Backend backend, std::string const& light, double side, double2 at = double2(0))
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              mSquare(engine), scene(engine) {
        mMaterial = loadMaterial(
                engine, text("shadingModel : unlit", fmt::format("material.baseColor = vec4({}, 1.0);", light)));
        mInstance = engine.own(engine.createInstance(mMaterial));
        if (side > 0) lamp = mSquare.add(scene, mInstance, double3(at, 0), side);
        view.camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, { .verticalFovDegrees = 90 });
        view.size = { 256, 256 };
    }
    ~LampStage() { expectNoErrors(engine); }

    Engine engine;

private:
    SquareMesh mSquare;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;

public:
    Scene scene;
    Renderable lamp;
    View view;
};

/// Linear images of a lamp from both APIs, which have the same bits.
inline Image pictureOfLamp(float light, double side, std::function<void(View&)> const& set, double2 at = double2(0)) {
    std::vector<Image> images;
    for (const Backend backend : kBothApis) {
        LampStage stage(backend, light, side, at);
        set(stage.view);
        images.push_back(renderLinear(stage.engine, stage.scene, stage.view));
    }
    EXPECT_EQ(differingPixels(images[0], images[1]), 0u);
    return std::move(images[0]);
}

/// Of red light.
inline double sumOf(Image const& image) {
    double sum = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) sum += static_cast<double>(halfPixel(image, x, y).x);
    return sum;
}

/// The frame of a view has the bits, passes and draws of one without its effects, and explain() says why.
inline void expectSameAsPlain(LampStage& stage, const char* reason) {
    Renderer renderer(stage.engine);
    const View plain{ .camera = stage.view.camera, .size = stage.view.size };
    (void)renderer.renderToImage(stage.scene, plain);
    const uint32_t passes = renderer.statistics().passesRun, draws = renderer.statistics().draws;
    const auto before = renderer.renderToImage(stage.scene, plain);
    const auto after = renderer.renderToImage(stage.scene, stage.view);
    EXPECT_EQ(renderer.statistics().passesRun, passes);
    EXPECT_EQ(renderer.statistics().draws, draws);
    ASSERT_TRUE(before && after);
    EXPECT_EQ(before->pixels, after->pixels);
    EXPECT_NE(renderer.explain().find(reason), std::string::npos) << renderer.explain();
}

} // namespace filament_core::test
