// SPDX-License-Identifier: Apache-2.0
// The limits of the rules, by codes of sRGB.
#include "filament_core/assets/image/ChannelTransfer.h"
#include "shaders/lib/LibCpp.h"
#include "shaders/lib/LibCppDouble.h"

#include <gtest/gtest.h>

namespace filament_core::shader::test {
namespace {

/// Of a grey with this code of sRGB, in both precisions.
int ruleOfCode(int code, double metallic) {
    const double light = assets::linearFromSrgb(code / 255.0);
    const double rule = lib64::implausibleRule(lib64::vec3(light), metallic, 0.04, lib64::vec3(0.0));
    const float single = lib::implausibleRule(lib::vec3(static_cast<float>(light)), static_cast<float>(metallic), 0.04f,
                                              lib::vec3(0.0f));
    EXPECT_EQ(static_cast<double>(single), rule) << code;
    return static_cast<int>(rule);
}

TEST(Plausible, DielectricsAreFrom50To240) {
    for (int code = 0; code < 256; ++code) EXPECT_EQ(ruleOfCode(code, 0), code < 50 ? 2 : code > 240 ? 3 : 0) << code;
}

TEST(Plausible, MetalsAreFrom170) {
    for (int code = 0; code < 256; ++code) EXPECT_EQ(ruleOfCode(code, 1), code < 170 ? 4 : 0) << code;
}

TEST(Plausible, MetallicIsNearlyZeroOrOne) {
    for (int code = 0; code < 256; ++code)
        EXPECT_EQ(ruleOfCode(200, code / 255.0), code >= 26 && code <= 229 ? 1 : 0) << code;
}

TEST(Plausible, DielectricsReflectTwoPercentAndMetalsMay) {
    const auto rule = [](double reflectance, double metallic) {
        return lib64::implausibleRule(lib64::vec3(0.5), metallic, lib64::f0FromReflectance(reflectance),
                                      lib64::vec3(0.0));
    };
    EXPECT_EQ(rule(0.35, 0), 0);
    EXPECT_EQ(rule(0.34, 0), 5);
    EXPECT_EQ(rule(0.0, 1), 0) << "reflectance is that of dielectrics";
}

TEST(Plausible, TheFirstRuleCounts) {
    const auto rule = [](double light, double metallic, double f0, double emission) {
        return lib64::implausibleRule(lib64::vec3(light), metallic, f0, lib64::vec3(0.0, emission, 0.0));
    };
    EXPECT_EQ(rule(0.2, 0, 0.04, 1), 0);
    EXPECT_EQ(rule(0.2, 0, 0.04, 1.01), 6);
    EXPECT_EQ(rule(0.2, 0, 0.01, 1.01), 5);
    EXPECT_EQ(rule(0.01, 0, 0.01, 1.01), 2);
    EXPECT_EQ(rule(0.01, 0.5, 0.01, 1.01), 1);
}

} // namespace
} // namespace filament_core::shader::test
