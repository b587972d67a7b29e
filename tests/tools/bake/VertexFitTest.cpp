// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/VertexFit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace filament_core::bake {
namespace {

/// A square of 2 m in the plane z = 0, cut into `cells` x `cells` pairs of triangles; each triangle has vertices of its
/// own, as where texture coordinates are cut.
BakeSurface cutSquare(uint32_t cells) {
    BakeSurface surface;
    const auto corner = [&](uint32_t x, uint32_t y) {
        surface.indices.push_back(static_cast<uint32_t>(surface.positions.size()));
        surface.positions.push_back({ 2.0 * x / cells - 1, 2.0 * y / cells - 1, 0 });
        surface.normals.push_back({ 0, 0, 1 });
    };
    for (uint32_t y = 0; y < cells; ++y) {
        for (uint32_t x = 0; x < cells; ++x) {
            corner(x, y), corner(x + 1, y), corner(x + 1, y + 1);
            corner(x, y), corner(x + 1, y + 1), corner(x, y + 1);
        }
    }
    return surface;
}

class VertexFit : public ::testing::Test {
protected:
    /// Texels that say `visible` of their places.
    void fit(BakeSurface surface, std::function<double(double3)> const& visible) {
        mSurface = std::move(surface);
        jobs::JobSystem jobs({ .workers = 0 });
        Result<Atlas> atlas = makeAtlas({ &mSurface, 1 }, { .texelsPerMeter = 24 }, jobs);
        ASSERT_TRUE(atlas);
        mAtlas = std::move(*atlas);
        mTexels = findTexels(mAtlas);
        for (AtlasTexel const& texel : mTexels) {
            const double value = visible(pointOf(mSurface, texel).position);
            mLights.push_back({ .irradiance = double3(value), .open = value * double3(0, 0, 2.0 / 3), .samples = 32 });
        }
        mValues = fitVertices({ &mSurface, 1 }, mAtlas, mTexels, mLights);
        ASSERT_EQ(mValues.size(), 1u);
        ASSERT_EQ(mValues[0].size(), mSurface.positions.size());
    }
    double rms(std::function<double(size_t texel)> const& given) const {
        double squares = 0;
        for (size_t i = 0; i < mTexels.size(); ++i) {
            const double error = given(i) - mLights[i].irradiance.x;
            squares += error * error;
        }
        return std::sqrt(squares / double(mTexels.size()));
    }
    double interpolated(size_t i, std::function<double(uint32_t vertex)> const& value) const {
        const uint32_t* const corners = &mSurface.indices[size_t(mTexels[i].triangle) * 3];
        return value(corners[0]) * (1 - mTexels[i].u - mTexels[i].v) + value(corners[1]) * mTexels[i].u +
               value(corners[2]) * mTexels[i].v;
    }

    BakeSurface mSurface;
    Atlas mAtlas;
    std::vector<AtlasTexel> mTexels;
    std::vector<TexelLight> mLights;
    VertexOcclusion mValues;
};

TEST_F(VertexFit, FindsALinearFunctionAgain) {
    const auto plane = [](double3 at) { return 0.5 + 0.2 * at.x - 0.25 * at.y; };
    fit(cutSquare(3), plane);
    for (size_t i = 0; i < mSurface.positions.size(); ++i) {
        EXPECT_NEAR(mValues[0][i].x, plane(mSurface.positions[i]), 2e-3);
        EXPECT_NEAR(mValues[0][i].w, plane(mSurface.positions[i]) * 2 / 3, 2e-3);
    }
}

// A corner that sees nothing darkens its triangles to their middle if only vertices are traced.
TEST_F(VertexFit, IsNearerThanTheValuesAtTheVertices) {
    const auto corner = [](double3 at) { return 1 - std::exp(-8 * (at.x + 1)); };
    fit(cutSquare(2), corner);
    const double fitted = rms([&](size_t i) { return interpolated(i, [&](uint32_t v) { return mValues[0][v].x; }); });
    const double traced =
            rms([&](size_t i) { return interpolated(i, [&](uint32_t v) { return corner(mSurface.positions[v]); }); });
    EXPECT_LT(fitted * 1.5, traced) << fitted << " and " << traced;
}

TEST_F(VertexFit, GivesVerticesOfOnePlaceOneValue) {
    fit(cutSquare(2), [](double3 at) { return at.x > 0 ? 0.9 : 0.2; });
    for (size_t i = 0; i < mSurface.positions.size(); ++i) {
        for (size_t k = 0; k < i; ++k) {
            if (mSurface.positions[i] == mSurface.positions[k]) {
                EXPECT_EQ(mValues[0][i], mValues[0][k]);
            }
        }
    }
}

TEST_F(VertexFit, OfWhatSeesBacksAloneIsOpen) {
    fit(cutSquare(1), [](double3) { return 0.5; });
    for (TexelLight& light : mLights) light.backs = 1;
    for (auto const& values : fitVertices({ &mSurface, 1 }, mAtlas, mTexels, mLights)) {
        for (double4 const& value : values) EXPECT_EQ(value.x, 1);
    }
}

// The place in the ramp that a vertex has shows its value, interpolated between two texels.
TEST_F(VertexFit, RampsShowTheValues) {
    fit(cutSquare(1), [](double3 at) { return 0.5 + 0.4 * at.x; });
    const Atlas ramp = rampAtlas(mValues, { &mSurface, 1 });
    const std::vector<std::byte> texels = rampTexels();
    for (size_t i = 0; i < mSurface.positions.size(); ++i) {
        const double place = double(ramp.surfaces[0].uvs[i].x) * 256 - 0.5, low = std::floor(place);
        const auto code = [&](double at) { return std::to_integer<int>(texels[static_cast<size_t>(at) * 4]) / 255.0; };
        const double shown = code(low) + (code(low + 1) - code(low)) * (place - low);
        EXPECT_NEAR(shown, mValues[0][i].x, 1e-5);
        EXPECT_EQ(ramp.surfaces[0].uvs[i].y, 0.5f);
    }
}

} // namespace
} // namespace filament_core::bake
