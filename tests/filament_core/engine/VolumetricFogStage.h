// SPDX-License-Identifier: Apache-2.0
/// VolumetricFogStage: a plane six metres away in volumetric fog, whose columns of cells are eight pixels wide.
#pragma once

#include "tests/filament_core/engine/FogStage.h"

#include <numbers>

namespace filament_core::test {

inline constexpr uint32_t kCellsSide = 64;

inline Fog volumetricFog(float density, float anisotropy) {
    Fog fog = fogOf(density);
    fog.volumetric = true;
    fog.anisotropy = anisotropy;
    fog.volumetricMeters = 8;
    fog.volumetricPixels = 8;
    return fog;
}

inline double phase(double cosine, double g) {
    return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// So that its illuminance is 0.5 in the image.
inline SunLight sunFor(MaterialStage const& stage, float3 towards) {
    return { .directionWorld = -glm::normalize(towards),
             .illuminance = Lux{ 0.5f / stage.view.camera.exposure.factor() },
             .color = { 1, 0.5f, 0.25f } };
}

/// A lamp that is too dark to be seen: now the cells are needed.
inline void addDarkLamp(MaterialStage& stage) {
    stage.scene.add(PointLight{ .positionWorld = { 0, 0, 0 }, .intensity = Candela{ 1e-20f } });
}

/// A plane six metres away in this fog, under these lights.
template <class Light>
Image litFog(Fog const& fog, Light&& light) {
    return onBothApis([&](MaterialStage& stage) {
        stage.view.size = uint2(kCellsSide);
        stage.view.quality.shadows = ShadowFilter::Off;
        stage.view.effects.fog = fog;
        light(stage);
        addPlane(stage, stage.material(paintText("")), 6);
    });
}

/// check(colour, direction) in the middle of each column of cells.
template <class Check>
void forColumns(Image const& image, Check const& check) {
    ASSERT_EQ(image.width, kCellsSide);
    for (uint32_t y = 4; y < kCellsSide; y += 8)
        for (uint32_t x = 4; x < kCellsSide; x += 8)
            check(halfPixel(image, x, y), double3(directionThrough(x, y, kCellsSide)));
}

inline float3 withoutLight(Fog const& fog, double3 direction) {
    return foggedPaint(kPaintInFog, fog, opacityAlong(fog, 0, direction.y, fog.startMeters, 6 / -direction.z));
}

/// The light of an isotropic lamp in even fog along a ray from the camera, by a fine sum. `lost`: 1/m, of the
/// lamp's light on its way to the fog.
inline double lampAlong(double3 lamp, double3 direction, double density, double meters, double lost) {
    constexpr int kSteps = 20'000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double t = meters * (i + 0.5) / kSteps;
        const double3 toLamp = lamp - direction * t;
        sum += std::exp(-density * t - lost * glm::length(toLamp)) / std::max(glm::dot(toLamp, toLamp), 1e-4);
    }
    return sum * meters / kSteps * density / (4 * std::numbers::pi);
}

} // namespace filament_core::test
