// SPDX-License-Identifier: Apache-2.0
#include "tests/numerics/scenes/Exact.h"

#include "filament_core/assets/tables/DfgTable.h"
#include "shaders/lib/LibCppDouble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace filament_core::hard {
namespace {

namespace lib = shader::lib64;

} // namespace

double3 directionThroughPixel(View const& view, uint32_t x, uint32_t y) {
    const double tangent = std::tan(glm::radians(static_cast<double>(view.camera.lens.verticalFovDegrees)) / 2);
    const double right = (x + 0.5) / view.size.x * 2 - 1, down = (y + 0.5) / view.size.y * 2 - 1;
    const double aspect = static_cast<double>(view.size.x) / view.size.y;
    const double3 inView(right * tangent * aspect, -down * tangent, -1);
    return glm::normalize(double3x3(view.camera.worldFromView) * inView);
}

double3 sunOnWall(View const& view, Look const& look, SunLight const& sun, double3 toViewer) {
    const double3 normal(0, 0, 1), light = -glm::normalize(double3(sun.directionWorld));
    const double3 base(look.baseColor), f0 = lib::f0FromBaseColor(base, look.metallic, 0.5);
    const double roughness = lib::clampPerceptualRoughness(look.roughness), alpha = lib::alphaFromPerceptual(roughness);
    const double3 halfway = glm::normalize(toViewer + light);
    const double nol = std::max(glm::dot(normal, light), 0.0), nov = std::max(glm::dot(normal, toViewer), 1e-4);
    const double2 dfg(assets::integrateDfg(static_cast<float>(nov), static_cast<float>(alpha)));
    const double f90 = lib::saturate(glm::dot(f0, double3(50 * 0.33)));
    const double lobe =
            lib::ndfGgxFromVectors(normal, halfway, alpha) * lib::visibilitySmithGgxCorrelated(nov, nol, alpha);
    const double3 specular =
            lobe * lib::fresnelSchlick(f0, f90, glm::dot(toViewer, halfway)) * lib::energyCompensation(f0, dfg);
    const double2 dfgOfLight(assets::integrateDfg(static_cast<float>(nol), static_cast<float>(alpha)));
    const auto albedo = [&](double2 at) { return lib::specularDfg(f0, f90, at) * lib::energyCompensation(f0, at); };
    const double3 coupling =
            lib::diffuseEntry(albedo(dfgOfLight)) * lib::diffuseExit(albedo(dfg), albedo(lib::dfgAverage(alpha)));
    const double3 diffuse = lib::diffuseColor(base, look.metallic) * lib::diffuseLambert() * coupling;
    const double illuminance = static_cast<double>(sun.illuminance.value) * view.camera.exposure.factor();
    return (diffuse + specular) * double3(sun.color) * illuminance * nol;
}

void expectSunOnWall(Picture const& picture, View const& view, Look const& look, SunLight const& sun, double relative,
                     double radius) {
    uint32_t asked = 0, wrong = 0;
    forEachCovered(picture, [&](uint32_t x, uint32_t y, float4 color) {
        const double3 eye = view.camera.position(), ray = directionThroughPixel(view, x, y);
        if (glm::length(eye - ray * (eye.z / ray.z)) > radius) return;
        ++asked;
        const double3 exact = sunOnWall(view, look, sun, -ray);
        for (int c = 0; c < 3; ++c) {
            const double expected = std::min<double>(exact[c], kLargestStored);
            if (std::abs(color[c] - expected) <= std::max(expected * relative, 0x1p-24)) continue;
            if (wrong++ == 0)
                ADD_FAILURE() << "(" << x << ", " << y << ")[" << c << "]: " << color[c] << ", exact " << exact[c];
        }
    });
    EXPECT_GT(asked, 0u);
    EXPECT_EQ(wrong, 0u) << "components of " << asked << " pixels";
}

} // namespace filament_core::hard
