// SPDX-License-Identifier: Apache-2.0
// Masked materials (materials guide, 4.2.15 and 4.2.27): with several samples a pixel their edges are as smooth as those
// of geometry, with one they are as sharp as the threshold.
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <set>

namespace filament {
namespace {

using test::halfPixel;
using test::MaterialStage;
using test::onBothApis;

constexpr uint32_t kSide = 32; // the square covers the whole picture

/// White, with an alpha that rises slowly across the picture; the edge leans a little.
std::string ramp(std::string_view properties) {
    return fmt::format(R"(material {{ shadingModel : unlit, blending : masked, requires : [ uv0 ], {} }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = vec4(1.0, 1.0, 1.0, getUV0().x * 0.9 + getUV0().y * 0.1);
}} }})",
                       properties);
}

Image drawn(std::string_view properties, uint8_t samples) {
    return onBothApis([&](MaterialStage& stage) {
        stage.view.size = { kSide, kSide };
        stage.view.samples = samples;
        stage.add(stage.material(ramp(properties)), { { .halfSide = 2 } });
    });
}

std::set<float> levelsOf(Image const& image) {
    std::set<float> levels;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) levels.insert(halfPixel(image, x, y).x);
    }
    return levels;
}

double meanOf(Image const& image) {
    double sum = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) sum += halfPixel(image, x, y).x;
    }
    return sum / (static_cast<double>(image.width) * image.height);
}

TEST(AlphaToCoverage, OneSampleAPixelCutsAtTheThreshold) {
    EXPECT_EQ(levelsOf(drawn("", 1)), (std::set<float>{ 0, 1 }));
}

TEST(AlphaToCoverage, FourSamplesMakeEdgesSmooth) {
    const std::set<float> levels = levelsOf(drawn("", 4));
    EXPECT_GE(levels.size(), 4u) << "between nothing and all are shares of four samples";
    EXPECT_TRUE(levels.contains(0) && levels.contains(1));
}

TEST(AlphaToCoverage, MaterialsCanSwitchItOff) {
    EXPECT_EQ(levelsOf(drawn("alphaToCoverage : false", 4)), (std::set<float>{ 0, 1 }));
}

TEST(AlphaToCoverage, MovesTheEdgeByNoMoreThanAFractionOfAPixel) {
    EXPECT_NEAR(meanOf(drawn("", 1)), meanOf(drawn("", 4)), 0.25 / kSide);
    EXPECT_NEAR(meanOf(drawn("maskThreshold : 0.7", 1)), meanOf(drawn("maskThreshold : 0.7", 4)), 0.25 / kSide);
}

TEST(AlphaToCoverage, CoveredSamplesAreOpaque) {
    const Image image = drawn("", 4);
    for (uint32_t y = 0; y < kSide; ++y) {
        for (uint32_t x = 0; x < kSide; ++x) EXPECT_EQ(halfPixel(image, x, y).w, 1) << x << " " << y;
    }
}

} // namespace
} // namespace filament
