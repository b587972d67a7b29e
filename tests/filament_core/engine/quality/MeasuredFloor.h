// SPDX-License-Identifier: Apache-2.0
/// A scene in which every choice of quality costs time, and what the time of a preset buys in it; for the test of cost
/// tables and for quality_bench.
#pragma once

#include "tests/filament_core/engine/quality/QualityFixture.h"

#include <filament_core/QualityBudget.h>

#include <cstdint>
#include <vector>

namespace filament_core::test {

/// A textured floor up to the horizon, lit by a sun and an environment: every choice affects every pixel.
class Floor {
public:
    explicit Floor(Engine& engine) : mTexture(checker(engine)), mPatch(engine, 80, textured()) {
        mPatch.setSurface({ 0.9f, 0.6f, 0.3f, 1 }, 0.5f, 0.5f);
        EXPECT_TRUE(engine.set(mPatch.instance(), "baseColorMap", mTexture,
                               Sampler{ Filter::Nearest, Filter::Linear, MipFilter::Linear, WrapMode::ClampToEdge,
                                        WrapMode::ClampToEdge }));
        mPatch.addSun({ 0, 0, 1 });
        mPatch.addEnvironment({ float4(0.5f), float4(0.1f), float4(0.3f), float4(0.2f), float4(0.1f) }, 5);
        mPatch.view.size = { 192, 192 };
    }
    Scene& scene() { return mPatch.scene; }
    View& view() { return mPatch.view; }

private:
    static MaterialDesc textured() {
        return { .package = shader::engineMaterial("gltf_lit_opaque"), .constants = { { "hasBaseColorMap", true } } };
    }
    static Owned<Texture> checker(Engine& engine) {
        std::vector<uint8_t> texels;
        for (uint32_t side = 512; side > 0; side /= 2) {
            for (uint32_t i = 0; i < side * side; ++i) {
                const bool isWhite = side > 1 && ((i / side + i) & 1) != 0;
                const auto value = static_cast<uint8_t>(side == 512 ? (isWhite ? 255 : 20) : 138);
                texels.insert(texels.end(), { value, value, value, uint8_t{ 255 } });
            }
        }
        return engine.own(engine.create(
                TextureDesc{ .width = 512, .height = 512, .levels = 10, .pixels = std::as_bytes(std::span(texels)) }));
    }

    Owned<Texture> mTexture;
    test::Patch mPatch;
};

/// The preset with the default's look-ups: on a slanted metal, one look-up gives too much light where missing
/// compensation gives too little, and a sum of squares does not know what cancels.
inline Quality presetOfFloor(QualityPreset preset) {
    Quality quality = qualityPreset(preset);
    quality.specularLookUps = Quality{}.specularLookUps;
    return quality;
}

/// The other choices in which presets differ.
inline CostMeasurement measurementOfPresets(uint32_t rounds) {
    return { .rounds = rounds,
             .choices = { "specularVisibility", "fresnel", "energyCompensation", "splitSum", "dfgTableSize",
                          "diffuseIrradiance", "shBands", "textureFilter" } };
}

struct Bought {
    double milliseconds = 0; ///< the predicted cost of the preset: the budget
    QualityDecision decision;
};

inline Bought buyForPreset(QualityPreset preset, Backend backend, QualityCosts const& costs) {
    QualityBudget budget{ .gpuMilliseconds = 1, .size = costs.size, .backend = backend };
    const Result<QualityPrediction> predicted = predictQuality(presetOfFloor(preset), budget, costs);
    EXPECT_TRUE(predicted) << predicted.error().message;
    budget.gpuMilliseconds = predicted->milliseconds;
    return { .milliseconds = predicted->milliseconds, .decision = *chooseQuality(budget, costs) };
}

} // namespace filament_core::test
