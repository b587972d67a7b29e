// SPDX-License-Identifier: Apache-2.0
/// FogStage: planes in fog before a camera of few pixels, and the closed form of what it sees.
#pragma once

#include "tests/filament_core/engine/SkyStage.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace filament_core::test {

inline constexpr float3 kPaintInFog{ 0.8f, 0.4f, 0.2f };
inline constexpr uint32_t kFogSide = 8;

inline std::string paintText(std::string_view properties, std::string_view color = "vec4(0.8, 0.4, 0.2, 1.0)") {
    return test::text(fmt::format("shadingModel : unlit, doubleSided : true, {}", properties),
                      fmt::format("material.baseColor = {};", color));
}

inline Fog fogOf(float density) { return { .enabled = true, .density = density, .color = { 0.1f, 0.5f, 0.9f } }; }

/// Straight through the formula of docs/fog.md, from the camera's height.
inline double opacityAlong(Fog const& fog, double height, double rise, double from, double to) {
    const double rate = static_cast<double>(fog.heightFalloff) * rise;
    const double density =
            fog.density * std::exp(-static_cast<double>(fog.heightFalloff) * (height - fog.heightMeters));
    const double depth = std::abs(rate) > 1e-9
                                 ? density * (std::exp(-rate * from) - std::exp(-rate * std::max(from, to))) / rate
                                 : density * std::max(to - from, 0.0);
    return std::min(1 - std::exp(-depth), static_cast<double>(fog.maximumOpacity));
}

inline float3 foggedPaint(float3 color, Fog const& fog, double opacity) {
    return float3(glm::mix(double3(color), double3(fog.color), opacity));
}

inline void addPlane(MaterialStage& stage, MaterialInstance material, double distance) {
    const double scale = std::max(1.0, distance / 15);
    const double4x4 world = glm::translate(double4x4(1), stage.view.camera.position() - double3(0, 0, distance)) *
                            glm::scale(double4x4(1), double3(scale));
    stage.add(material, { {} }, world);
}

/// Calls check(colour, direction of the view) for every pixel.
template <class Check>
void forFogPixels(Image const& image, Check const& check) {
    ASSERT_EQ(image.width, kFogSide);
    for (uint32_t y = 0; y < kFogSide; ++y)
        for (uint32_t x = 0; x < kFogSide; ++x)
            check(test::halfPixel(image, x, y), double3(test::directionThrough(x, y, kFogSide)));
}

/// Half floats are rounded down; `writes`: how often.
inline void expectHalf(float4 seen, float3 expected, std::string const& what, float writes = 1) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], expected[c], writes * 1e-3f * expected[c] + 1e-5f) << what << ' ' << c;
}

} // namespace filament_core::test
