// SPDX-License-Identifier: Apache-2.0
/// A scene that is mostly edges, and what it looks like with many samples a pixel.
#pragma once

#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "toolkit/pictures/Flip.h"

#include <filament_core/Renderer.h>

#include <glm/ext/matrix_transform.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace filament_core::test {

inline constexpr uint2 kFanSize(96, 80);

/// Bars at all angles before a grey wall: edges of every slope, some of them thinner than a pixel.
class Fan {
public:
    explicit Fan(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              scene(engine), renderer(engine), mSquare(engine), mBright(instanceOf("0.9")), mDark(instanceOf("0.05")),
              mWall(instanceOf("0.3")) {
        addBars();
        mSquare.add(scene, mWall.instance, double3(0, 0, -1), 3);
        view.size = kFanSize;
        turn(0);
    }
    ~Fan() { expectNoErrors(engine); }

    /// The camera to the right, in degrees.
    void turn(double degrees) {
        const double radians = glm::radians(degrees);
        view.camera = Camera::lookAt({ 0, 0, 2 }, { std::sin(radians), 0, 2 - std::cos(radians) },
                                     { .verticalFovDegrees = 50 });
    }
    void turnBars(double degrees) {
        for (size_t i = 0; i < mBars.size(); ++i) scene.setTransform(mBars[i], placeOf(i, degrees));
    }
    Image draw(Renderer& with) { return renderLinear(engine, with, scene, view); }
    Image draw() { return draw(renderer); }

    /// The mean of 8 x 8 samples a pixel.
    Image supersampled() {
        constexpr uint32_t kSide = 8;
        const View seen = view;
        view.size = seen.size * kSide;
        view.quality.antiAliasing = AntiAliasing::Off;
        view.effects.resolution = {};
        view.effects.sharpening = {};
        Renderer other(engine);
        const Image large = draw(other);
        view = seen;
        Image small{ .width = seen.size.x, .height = seen.size.y, .format = large.format, .pixels = {} };
        std::vector<uint16_t> halves;
        for (uint32_t y = 0; y < small.height; ++y) {
            for (uint32_t x = 0; x < small.width; ++x) {
                float4 sum(0);
                for (uint32_t i = 0; i < kSide * kSide; ++i)
                    sum += halfPixel(large, x * kSide + i % kSide, y * kSide + i / kSide);
                for (int c = 0; c < 4; ++c) halves.push_back(halfFromFloat(sum[c] / float(kSide * kSide)));
            }
        }
        small.pixels.resize(halves.size() * 2);
        std::memcpy(small.pixels.data(), halves.data(), small.pixels.size());
        return small;
    }

    Engine engine;
    Scene scene;
    Renderer renderer;
    View view;

private:
    struct Shade {
        Owned<Material> material;
        Owned<MaterialInstance> instance;
    };
    Shade instanceOf(std::string_view light) {
        Shade shade;
        shade.material =
                loadMaterial(engine, text("shadingModel : unlit, culling : none",
                                          "material.baseColor = vec4(vec3(" + std::string(light) + "), 1.0);"));
        shade.instance = engine.own(engine.createInstance(shade.material));
        return shade;
    }
    static double4x4 placeOf(size_t bar, double degrees) {
        const double angle = std::numbers::pi * static_cast<double>(bar) / 12 + glm::radians(degrees);
        double4x4 place = glm::rotate(double4x4(1.0), angle, double3(0, 0, 1));
        place = glm::translate(place, double3(0.5, 0, static_cast<double>(bar) * 0.01));
        return glm::scale(place, double3(0.4, bar % 3 == 0 ? 0.005 : 0.02, 1));
    }
    void addBars() {
        for (size_t i = 0; i < 24; ++i)
            mBars.push_back(mSquare.add(scene, i % 2 ? mBright.instance : mDark.instance, placeOf(i, 3)));
    }

    SquareMesh mSquare;
    Shade mBright, mDark, mWall;
    std::vector<Renderable> mBars;
};

/// Of all components.
inline double rmsBetween(Image const& a, Image const& b) {
    double sum = 0;
    for (uint32_t y = 0; y < a.height; ++y) {
        for (uint32_t x = 0; x < a.width; ++x) {
            const float3 away = float3(halfPixel(a, x, y)) - float3(halfPixel(b, x, y));
            sum += static_cast<double>(dot(away, away)) / 3;
        }
    }
    return std::sqrt(sum / (static_cast<double>(a.width) * a.height));
}

/// What moves, and what it does before a frame.
using FanMotion = void (*)(Fan& fan, int frame);
inline constexpr std::pair<const char*, FanMotion> kFanMotions[] = {
    { "the camera turns", [](Fan& fan, int frame) { fan.turn(0.37 * frame); } },
    { "the camera moves", [](Fan& fan, int frame) { fan.view.camera.worldFromView[3].x = 0.013 * frame; } },
    { "the bars turn", [](Fan& fan, int frame) { fan.turnBars(0.7 * frame); } },
};

/// FLIP beside supersampling, the mean over frames.
inline double flipInMotion(std::function<void(View&)> const& set, FanMotion move) {
    Fan fan(Backend::Vulkan);
    set(fan.view);
    double sum = 0;
    constexpr int kWarmUp = 8, kFrames = 16;
    for (int frame = 0; frame < kFrames; ++frame) {
        move(fan, frame);
        const Image drawn = fan.draw();
        if (frame >= kWarmUp) sum += tools::flip(fan.supersampled(), drawn).mean / (kFrames - kWarmUp);
    }
    return sum;
}

} // namespace filament_core::test
