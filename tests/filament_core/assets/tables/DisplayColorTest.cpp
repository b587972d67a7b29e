// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/tables/DisplayColor.h"

#include "shaders/lib/LibCpp.h"

#include <filament_core/Look.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace filament_core::assets {
namespace {

TEST(DisplayColor, RodsSeeWhatIsExposed) {
    const ColorGrading dark{ .enabled = true, .nightAdaptation = 1, .exposure = -6 };
    const ColorGrading night{ .enabled = true, .nightAdaptation = 1 };
    const DisplayTransform linear{ .toneMapper = ToneMapper::Linear };
    const float3 light(0.4f, 0.5f, 0.3f);
    EXPECT_LT(glm::distance(DisplayColor(linear, &dark)(light), DisplayColor(linear, &night)(light / 64.0f)), 1e-5f);
}

TEST(DisplayColor, ALookComesAfterTheToneMapperAndBeforeTheSpace) {
    auto inverse = std::make_shared<Look>(Look{ .isCube = false, .size = 2, .entries = { float3(1), float3(0) } });
    const float3 light(0.3f, 0.1f, 1);
    const float3 plain = DisplayColor({ .toneMapper = ToneMapper::Filmic })(light);
    const float3 inverted = DisplayColor({ .toneMapper = ToneMapper::Filmic, .look = inverse })(light);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(inverted[c], 1 - plain[c], 1e-6f);
    const float3 linear = DisplayColor(
            { .toneMapper = ToneMapper::Filmic, .outputSpace = OutputSpace::LinearRec709, .look = inverse })(light);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(linear[c], shader::lib::linearFromSrgb(inverted[c]), 1e-6f);
}

/// Hill's fit beside what it fits: the numbers of docs/finish.md.
TEST(DisplayColor, TheFitOfAcesIsNearTheTransforms) {
    const DisplayColor fit({ .toneMapper = ToneMapper::Aces }), exact({ .toneMapper = ToneMapper::AcesReference });
    double worstGrey = 0, squares = 0, worst = 0;
    size_t count = 0;
    for (double stops = -6; stops <= 6; stops += 0.25) {
        const auto light = static_cast<float>(0.18 * std::exp2(stops));
        worstGrey = std::max(worstGrey, std::abs(static_cast<double>(fit(float3(light)).y - exact(float3(light)).y)));
        for (float3 const& color : { float3(1), float3(1, 0.5f, 0.2f), float3(0.2f, 1, 0.4f), float3(0.2f, 0.4f, 1),
                                     float3(1, 0.05f, 0.05f), float3(0.9f, 0.9f, 0.1f) }) {
            const float3 error = fit(color * light) - exact(color * light);
            for (int c = 0; c < 3; ++c) {
                squares += static_cast<double>(error[c] * error[c]);
                worst = std::max(worst, static_cast<double>(std::abs(error[c])));
                ++count;
            }
        }
    }
    const double mean = std::sqrt(squares / static_cast<double>(count));
    RecordProperty("worstGrey", std::to_string(worstGrey));
    RecordProperty("mean", std::to_string(mean));
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(worstGrey, 0.02);
    EXPECT_LT(mean, 0.04);
    EXPECT_GT(worst, 0.02) << "a fit";
}

} // namespace
} // namespace filament_core::assets
