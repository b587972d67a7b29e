// SPDX-License-Identifier: Apache-2.0
/// A plane, boxes and a chalk that shadows fall on, for tests of shadow maps in images.
#pragma once

#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <glm/gtc/matrix_transform.hpp>

namespace filament_core::test {

inline constexpr ShadowFilter kShadowFilters[] = { ShadowFilter::Hard,    ShadowFilter::Pcf2, ShadowFilter::Pcf3,
                                                   ShadowFilter::Pcf5,    ShadowFilter::Vsm,  ShadowFilter::Evsm,
                                                   ShadowFilter::Poisson, ShadowFilter::Pcss };

inline constexpr const char* kChalk = R"(material { name : chalk, shadingModel : lit, doubleSided : true }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.8);
    material.roughness = 1.0;
} })";

struct ShadowStage : SquareStage {
    const MaterialInstance white = instance;

    explicit ShadowStage(Backend backend) : SquareStage(backend, kChalk) {}

    /// Six squares around a point; `half` to each side.
    void addBox(Scene& scene, double3 at, double3 half, double turn = 0) const {
        for (int face = 0; face < 6; ++face) {
            double4x4 world = glm::translate(double4x4(1), at) * glm::rotate(double4x4(1), turn, double3(0, 0, 1)) *
                              glm::scale(double4x4(1), half);
            const double3 axis = face < 4 ? double3(0, 1, 0) : double3(1, 0, 0);
            const double quarter = glm::radians(90.0) * (face < 4 ? face : face == 4 ? 1 : -1);
            world = world * glm::rotate(double4x4(1), quarter, axis) * glm::translate(double4x4(1), double3(0, 0, 1));
            square.add(scene, white, world);
        }
    }
};

inline View shadowedView(double3 eye, double3 at, ShadowFilter filter, uint2 size = { 64, 64 }) {
    View view{ .camera = Camera::lookAt(eye, at, { .verticalFovDegrees = 50, .nearMeters = 1e-3f }, {}, { 0, 1, 0 }),
               .size = size };
    view.quality.shadows = filter;
    view.quality.shadowMapSize = 512;
    return view;
}

/// Boxes over a plane under lights of every kind.
inline void addCrowd(ShadowStage& stage, Scene& scene, prepare::Random& random, double scale) {
    stage.square.add(scene, stage.white, { 0, 0, 0 }, 4 * scale);
    for (int i = 0; i < 12; ++i) {
        const double3 half =
                double3(random.within(0.05, 0.5), random.within(0.05, 0.5), random.within(0.05, 0.8)) * scale;
        const double3 at(random.within(-3, 3) * scale, random.within(-3, 3) * scale, random.within(0, 2) * scale);
        stage.addBox(scene, at, half, random.within(0, 3));
    }
    const auto direction = [&] {
        return float3(static_cast<float>(random.within(-1, 1)), static_cast<float>(random.within(-1, 1)), -1);
    };
    scene.add(SunLight{ .directionWorld = direction(), .illuminance = Lux{ 20'000 } });
    const auto candela = Candela{ static_cast<float>(20'000 * scale * scale) };
    const auto range = static_cast<float>(8 * scale);
    for (int i = 0; i < 2; ++i) {
        const double3 at(random.within(-3, 3) * scale, random.within(-3, 3) * scale, random.within(0.5, 3) * scale);
        scene.add(PointLight{ .positionWorld = at,
                              .intensity = candela,
                              .rangeMeters = range,
                              .sourceRadiusMeters = static_cast<float>(random.within(0, 0.2) * scale) });
        scene.add(SpotLight{ .positionWorld = at + double3(0, 0, 2 * scale),
                             .directionWorld = direction(),
                             .intensity = candela,
                             .rangeMeters = range,
                             .outerConeRadians = static_cast<float>(random.within(0.1, 1.5)) });
    }
    scene.add(SunLight{ .directionWorld = direction(), .illuminance = Lux{ 10'000 } });
    const double3 overhead(random.within(-3, 3) * scale, random.within(-3, 3) * scale, 3 * scale);
    scene.add(RectLight{ .positionWorld = overhead,
                         .directionWorld = direction(),
                         .widthMeters = static_cast<float>(random.within(0.1, 1) * scale),
                         .heightMeters = static_cast<float>(0.3 * scale),
                         .luminance = Nits{ 100'000 },
                         .rangeMeters = range });
    scene.add(TubeLight{ .positionWorld = -overhead + double3(0, 0, 4 * scale),
                         .axisWorld = direction(),
                         .lengthMeters = static_cast<float>(scale),
                         .radiusMeters = static_cast<float>(0.1 * scale),
                         .luminance = Nits{ 100'000 },
                         .rangeMeters = range });
}

} // namespace filament_core::test
