// SPDX-License-Identifier: Apache-2.0
// Masked materials (materials guide, 4.2.15 and 4.2.27): with several samples a pixel their edges are as smooth as
// those of geometry, with one they are as sharp as the threshold.
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <glm/ext/matrix_transform.hpp>

#include <cmath>
#include <set>
#include <vector>

namespace filament_core {
namespace {

using test::halfPixel;
using test::MaterialStage;
using test::onBothApis;

constexpr uint32_t kSide = 32; // the square covers the whole image

/// White, with an alpha that rises slowly across the image; the edge leans a little.
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

/// What ramp() has in the middle of a pixel, made as steep as one pixel: the share of it that is covered.
double shareOf(uint32_t x, uint32_t y) {
    const double seen = 8 * std::tan(glm::radians(22.5)) / 4; // of the square's side, which is 4 m, 4 m away
    const auto at = [&](uint32_t i) { return 0.5 + ((i + 0.5) / kSide - 0.5) * seen; };
    const double alpha = at(x) * 0.9 + at(y) * 0.1;                           // v goes down: flipUV
    constexpr double kThreshold = 0.4;                                        // of materials that name none
    return std::clamp((alpha - kThreshold) / (seen / kSide) + 0.5, 0.0, 1.0); // fwidth() of both slopes is one pixel
}

/// coveredSamples() of shaders/material/surface/output.glsl: the next higher of five levels.
TEST(AlphaToCoverage, CoversAsManyOfFourSamplesAsTheSharpenedAlphaSays) {
    const Image image = drawn("", 4);
    double away = 0;
    uint32_t edges = 0;
    for (uint32_t y = 0; y < kSide; ++y) {
        for (uint32_t x = 0; x < kSide; ++x) {
            const double share = shareOf(x, y), seen = static_cast<double>(halfPixel(image, x, y).x);
            if (std::abs(share * 4 - std::round(share * 4)) > 4e-3) {
                EXPECT_EQ(seen * 4, std::ceil(share * 4)) << x << " " << y;
            }
            if (share <= 0 || share >= 1) continue;
            away += seen - share;
            ++edges;
        }
    }
    EXPECT_GE(edges, kSide) << "one a row";
    EXPECT_NEAR(away / edges, 0.125, 0.04) << "in the mean";
}

/// Without a mask alpha is the coverage itself: materials of the blending opaque.
TEST(AlphaToCoverage, WorksForOpaqueMaterialsThatEnableIt) {
    for (const bool isOn : { false, true }) {
        for (int level = 0; level <= 4; ++level) {
            const float alpha = 0.25f * static_cast<float>(level);
            const Image image = onBothApis([&](MaterialStage& stage) {
                stage.view.samples = 4;
                stage.add(stage.material(fmt::format(R"(material {{ shadingModel : unlit, alphaToCoverage : {} }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = vec4(1.0, 1.0, 1.0, {});
}} }})",
                                                     isOn, alpha)),
                          { {} });
            });
            EXPECT_EQ(test::centerPixel(image).x, isOn ? alpha : 1.0f) << alpha;
        }
    }
}

/// A leaf: an alpha from a texture with mip levels, at grazing angles. The mean coverage is that of 8 x 8 single
/// samples cut out.
TEST(AlphaToCoverage, OfALeafCoversWhatManySamplesCutOut) {
    constexpr uint32_t kTexels = 64;
    std::vector<uint8_t> texels;
    for (uint32_t i = 0; i < kTexels * kTexels; ++i) {
        const float2 at = (float2(i % kTexels, i / kTexels) + 0.5f) / static_cast<float>(kTexels) * 2.0f - 1.0f;
        const float lobes = 0.62f + 0.2f * std::cos(5 * std::atan2(at.y, at.x));
        const float alpha = std::clamp(0.5f + (lobes - glm::length(at)) * 8, 0.0f, 1.0f);
        texels.insert(texels.end(), { 255, 255, 255, static_cast<uint8_t>(std::lround(alpha * 255)) });
    }
    const auto leaf = [&](uint32_t side, uint8_t samples, bool isOn) {
        return onBothApis([&](MaterialStage& stage) {
            stage.view.size = { side, side };
            stage.view.samples = samples;
            const MaterialInstance instance = stage.material(fmt::format(
                    R"(material {{ shadingModel : unlit, blending : masked, requires : [ uv0 ], culling : none,
    alphaToCoverage : {}, parameters : [ {{ type : sampler2d, name : leaf }} ] }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = texture(materialParams_leaf, getUV0());
}} }})",
                    isOn));
            const Texture texture =
                    stage.own(stage.engine.create(TextureDesc{ .format = Format::RGBA8,
                                                               .width = kTexels,
                                                               .height = kTexels,
                                                               .generateMips = true,
                                                               .pixels = std::as_bytes(std::span(texels)) }));
            EXPECT_TRUE(stage.engine
                                .set(instance, "leaf", texture,
                                     Sampler{ Filter::Linear, Filter::Linear, MipFilter::Linear, WrapMode::ClampToEdge,
                                              WrapMode::ClampToEdge })
                                .ok());
            stage.add(instance, { { .halfSide = 1.6f } },
                      glm::rotate(glm::rotate(double4x4(1.0), 0.4, double3(0, 0, 1)), 0.7, double3(1, 0, 0)));
        });
    };
    constexpr uint32_t kFine = 8;
    const Image fine = leaf(kSide * kFine, 1, true), covered = leaf(kSide, 4, true), cut = leaf(kSide, 4, false);
    EXPECT_EQ(levelsOf(cut), (std::set<float>{ 0, 1 })) << "alphaToCoverage : false";
    EXPECT_EQ(levelsOf(leaf(kSide, 1, true)), (std::set<float>{ 0, 1 })) << "one sample";
    EXPECT_NEAR(meanOf(covered), meanOf(fine), 0.02);
    const auto rms = [&](Image const& image) {
        double sum = 0;
        for (uint32_t y = 0; y < kSide; ++y) {
            for (uint32_t x = 0; x < kSide; ++x) {
                double share = 0;
                for (uint32_t i = 0; i < kFine * kFine; ++i)
                    share += static_cast<double>(halfPixel(fine, x * kFine + i % kFine, y * kFine + i / kFine).x /
                                                 (kFine * kFine));
                const double away = static_cast<double>(halfPixel(image, x, y).x) - share;
                sum += away * away;
            }
        }
        return std::sqrt(sum / (kSide * kSide));
    };
    RecordProperty("rms", fmt::format("covered {:.4f}, cut {:.4f}", rms(covered), rms(cut)));
    EXPECT_LT(rms(covered), 0.8 * rms(cut));
}

TEST(AlphaToCoverage, CoveredSamplesAreOpaque) {
    const Image image = drawn("", 4);
    for (uint32_t y = 0; y < kSide; ++y) {
        for (uint32_t x = 0; x < kSide; ++x) EXPECT_EQ(halfPixel(image, x, y).w, 1) << x << " " << y;
    }
}

} // namespace
} // namespace filament_core
