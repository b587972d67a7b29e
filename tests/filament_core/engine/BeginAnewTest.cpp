// SPDX-License-Identifier: Apache-2.0
// The state that frames leave to the next one (histories, reflections, motion vectors, exposure, shadow atlas) belongs
// to a scene and a view: with another one, a renderer draws what one draws that has drawn nothing yet.
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <glm/ext/matrix_transform.hpp>

#include <functional>
#include <optional>

namespace filament_core {
namespace {

/// An effect that looks at the frame before.
struct BackwardLook {
    const char* name;
    void (*enable)(View&);
    bool showsCamera = true; ///< its image depends on where the camera was
};

constexpr BackwardLook kBackwardLooks[] = {
    { "motionBlur",
      [](View& view) {
          view.effects.motionBlur.enabled = true;
          view.effects.motionBlur.shutterDegrees = 360;
      } },
    { "taa", [](View& view) { view.quality.antiAliasing = AntiAliasing::Taa; } },
    { "ssr", [](View& view) { view.effects.screenSpaceReflections.enabled = true; } },
    { "autoExposure", [](View& view) { view.effects.autoExposure.enabled = true; } },
    { "shadows", [](View& view) { view.quality.shadows = ShadowFilter::Pcf3; }, false },
    { "motion", [](View& view) { view.debugView = DebugView::Motion; } },
};

/// A mirror, a wall that glows and a block between them, twice: under one sun, and under several lights.
struct TwoRooms {
    explicit TwoRooms(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              here(engine), there(engine), mSquare(engine) {
        mMirror = test::loadMaterial(engine, test::text("reflections : screenspace",
                                                        "material.baseColor.rgb = vec3(0.9); material.metallic = 1.0; "
                                                        "material.roughness = 0.1;"));
        mGlow = test::loadMaterial(engine, test::text("shadingModel : unlit, culling : none, requires : [ uv0 ]",
                                                      "material.baseColor = vec4(getUV0(), 0.25, 1.0);"));
        fill(here, 0);
        fill(there, 0.4);
        for (const float side : { -0.5f, 0.0f, 0.5f })
            there.add(SunLight{ .directionWorld = { side, -1, -0.3f }, .illuminance = Lux{ 30'000 } });
        there.add(SpotLight{ .positionWorld = { 0, 2, 0 }, .directionWorld = { 0, -1, 0 } });
    }
    ~TwoRooms() { test::expectNoErrors(engine); }

    /// As a frame of an animation: `steps` of the camera after the last one.
    static View view(BackwardLook const& look, double steps, uint2 size = { 64, 48 }) {
        View view{ .camera = Camera::lookAt({ 0.2 * steps, 0.3, 1.5 + 0.1 * steps }, { 0.1 * steps, -0.2, 0 },
                                            { .verticalFovDegrees = 50 }),
                   .size = size,
                   .timeSeconds = 10 + steps };
        view.quality.shadows = ShadowFilter::Off;
        view.quality.shadowMapSize = 256;
        view.effects.screenSpaceReflections = { .distanceMeters = 20, .thicknessMeters = 0.5f };
        look.enable(view);
        return view;
    }

    Image draw(Renderer& renderer, Scene const& scene, View const& view) {
        return test::renderLinear(engine, renderer, scene, view);
    }

    Engine engine;
    Scene here, there;

private:
    void fill(Scene& scene, double offset) {
        const double4x4 flat = glm::rotate(double4x4(1.0), glm::radians(-90.0), double3(1, 0, 0));
        mMirrored.push_back(engine.own(engine.createInstance(mMirror)));
        mGlowing.push_back(engine.own(engine.createInstance(mGlow)));
        mSquare.add(scene, mMirrored.back(),
                    glm::translate(double4x4(1.0), double3(0, -0.5, 0)) * flat *
                            glm::scale(double4x4(1.0), double3(2)));
        mSquare.add(scene, mGlowing.back(), double3(offset, 0, -1.5), 2);
        mSquare.add(scene, mGlowing.back(), double3(offset, -0.2, 0.2 + offset), 0.2);
        scene.add(SunLight{ .directionWorld = { 0.2f, -1, -0.5f } });
    }

    test::SquareMesh mSquare;
    Owned<Material> mMirror, mGlow;
    std::vector<Owned<MaterialInstance>> mMirrored, mGlowing;
};

/// Draws frames of `scene`, the last of them with the camera where the next one will not be.
void drawBefore(TwoRooms& rooms, Renderer& renderer, Scene const& scene, BackwardLook const& look, uint2 size) {
    for (const double steps : { -3.0, -2.0, 1.0 }) rooms.draw(renderer, scene, TwoRooms::view(look, steps, size));
}

constexpr uint2 kRoomSize{ 64, 48 }, kOtherSize{ 40, 56 };

TEST(BeginAnew, WithAnotherSceneAndWithAnotherSize) {
    for (const Backend backend : test::kBothApis) {
        TwoRooms rooms(backend);
        for (BackwardLook const& look : kBackwardLooks) {
            const View view = TwoRooms::view(look, 0);
            const auto after = [&](Scene const* scene, uint2 size) {
                Renderer renderer(rooms.engine);
                if (scene) drawBefore(rooms, renderer, *scene, look, size);
                return rooms.draw(renderer, rooms.here, view);
            };
            const Image first = after(nullptr, kRoomSize);
            EXPECT_EQ(test::differingPixels(first, after(&rooms.there, kRoomSize)), 0u)
                    << look.name << ": another scene";
            EXPECT_EQ(test::differingPixels(first, after(&rooms.here, kOtherSize)), 0u) << look.name << ": other size";
            if (look.showsCamera) {
                EXPECT_GT(test::differingPixels(first, after(&rooms.here, kRoomSize)), 0u) << look.name << ": goes on";
            }
        }
    }
}

// Between two frames of one scene and view.
TEST(BeginAnew, FramesThatAreOnlyExpectedLeaveNothing) {
    for (const Backend backend : test::kBothApis) {
        TwoRooms rooms(backend);
        const Owned<SwapChain> other =
                rooms.engine.own(rooms.engine.create(SwapChainDesc{ .size = kOtherSize, .imageCount = 1 }));
        for (BackwardLook const& look : kBackwardLooks) {
            const auto drawn = [&](bool expects) {
                Renderer renderer(rooms.engine);
                drawBefore(rooms, renderer, rooms.there, look, kRoomSize);
                if (expects) renderer.prewarm(rooms.here, TwoRooms::view(look, 2, kOtherSize), other);
                return rooms.draw(renderer, rooms.there, TwoRooms::view(look, 0));
            };
            EXPECT_EQ(test::differingPixels(drawn(false), drawn(true)), 0u) << look.name;
        }
    }
}

} // namespace
} // namespace filament_core
