// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/IblBaker.h"
#include "filament_core/assets/environment/Environment.h"

#include "base/math/Half.h"
#include "filament_core/assets/tables/DfgTable.h"
#include "shaders/lib/LibCpp.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"

#include <cstring>

namespace filament_core::assets {
namespace {

namespace lib = shader::lib;

class IblBakerTest : public ::testing::Test {
protected:
    jobs::JobSystem mJobs{ { .workers = 1 } };
};

const std::array<float3, 6> kNormals{ float3(1, 0, 0),
                                      float3(0, -1, 0),
                                      float3(0, 0, 1),
                                      float3(0.6f, 0.8f, 0),
                                      float3(-0.57735f, 0.57735f, -0.57735f),
                                      float3(0, -0.6f, 0.8f) };

// A sky with broad features on both sides of all axes.
float3 unevenSky(float3 d) {
    return float3(1.0f + d.x, std::exp(3.0f * d.y - 2.0f), d.z > 0 ? 2.0f * d.z * d.z : 0.1f);
}

TEST_F(IblBakerTest, LevelsEndAtSixteenTexels) {
    EXPECT_EQ(specularLevelCount(256), 5u);
    EXPECT_EQ(specularLevelCount(512), 6u);
    EXPECT_EQ(specularLevelCount(32), 2u);
    EXPECT_EQ(specularLevelCount(16), 2u) << "there is always a level for roughness 1";
}

TEST_F(IblBakerTest, InAFurnaceEveryRoughnessAndTheIrradianceAreOne) {
    const IblCube cube = cubeFromEquirect(pictureOf(32, [](float3) { return float3(1.0f); }), 64, mJobs);
    for (IblCubeLevel const& level : prefilterSpecular(cube, 64, 64, mJobs)) {
        for (uint32_t face = 0; face < 6; ++face) {
            for (int i = 0; i < static_cast<int>(level.size() * level.size()); ++i) {
                const int size = static_cast<int>(level.size());
                EXPECT_LT(glm::distance(level.radiance(face, i % size, i / size), float3(1.0f)), 1e-3f);
            }
        }
    }
    const std::array<float4, 9> sh = irradianceSh(cube[0], mJobs);
    for (const float3 n : kNormals) EXPECT_NEAR(lib::irradianceSh(sh.data(), n, 3).x, 1.0f, 1e-3f);
    EXPECT_NEAR(sh[0].x, 1.0f, 1e-4f);
    for (size_t i = 1; i < 9; ++i) EXPECT_NEAR(sh[i].x, 0.0f, 1e-4f);
}

// L = a + b.d + d.C.d: the cosine lobe scales its bands by 1, 2/3 and 1/4, so the coefficients are known in closed
// form.
TEST_F(IblBakerTest, CoefficientsOfAPolynomialSkyAreKnownInClosedForm) {
    const auto sky = [](float3 d) {
        return float3(2.0f + 0.3f * d.y + 0.6f * d.z - 0.9f * d.x, 1 + 0.8f * d.x * d.y - 0.4f * d.y * d.z,
                      1 + 0.4f * d.z * d.x);
    };
    const std::array<float4, 9> sh = irradianceSh(cubeFromEquirect(pictureOf(256, sky), 128, mJobs)[0], mJobs);
    constexpr float kTolerance = 1e-3f;
    EXPECT_NEAR(sh[0].x, 2.0f, kTolerance);
    EXPECT_NEAR(sh[1].x, 0.3f * 2 / 3, kTolerance);
    EXPECT_NEAR(sh[2].x, 0.6f * 2 / 3, kTolerance);
    EXPECT_NEAR(sh[3].x, -0.9f * 2 / 3, kTolerance);
    EXPECT_NEAR(sh[4].y, 0.8f / 4, kTolerance);
    EXPECT_NEAR(sh[5].y, -0.4f / 4, kTolerance);
    EXPECT_NEAR(sh[7].z, 0.4f / 4, kTolerance);
    EXPECT_NEAR(sh[6].x, 0.0f, kTolerance);
    EXPECT_NEAR(sh[8].x, 0.0f, kTolerance);
}

TEST_F(IblBakerTest, IrradianceFollowsTheHemisphericalIntegralOfASmoothSky) {
    const IblCube cube = cubeFromEquirect(pictureOf(128, unevenSky), 64, mJobs);
    const std::array<float4, 9> sh = irradianceSh(cube[0], mJobs);
    const std::vector<float> angles = texelSolidAngles(64);
    for (const float3 n : kNormals) {
        double3 reference(0.0);
        for (uint32_t face = 0; face < 6; ++face) {
            for (int i = 0; i < 64 * 64; ++i) {
                const float3 d = glm::normalize(
                        directionFromCube({ face, faceCoordinate(i % 64, 64), faceCoordinate(i / 64, 64) }));
                reference += double3(unevenSky(d)) *
                             double(std::max(0.0f, glm::dot(d, n)) * angles[static_cast<size_t>(i)] / kPi);
            }
        }
        EXPECT_LT(glm::distance(lib::irradianceSh(sh.data(), n, 3), float3(reference)),
                  0.04f * glm::length(float3(reference)));
    }
}

// Split sum with V = N, the slow way: every texel of the sphere, weighted by D from the half vector and by n.l.
float3 prefilterByBruteForce(float3 n, float alpha) {
    constexpr uint32_t kSize = 64;
    const std::vector<float> angles = texelSolidAngles(kSize);
    double3 sum(0.0);
    double weights = 0;
    for (uint32_t face = 0; face < 6; ++face) {
        for (int i = 0; i < int(kSize * kSize); ++i) {
            const float3 l = glm::normalize(directionFromCube(
                    { face, faceCoordinate(i % int(kSize), kSize), faceCoordinate(i / int(kSize), kSize) }));
            const float nol = glm::dot(n, l);
            if (nol <= 0) continue;
            const float noh = glm::dot(n, glm::normalize(n + l));
            const double weight = lib::ndfGgx(std::min(noh, 1.0f), alpha) * nol * angles[static_cast<size_t>(i)];
            sum += double3(unevenSky(l)) * weight;
            weights += weight;
        }
    }
    return float3(sum / weights);
}

TEST_F(IblBakerTest, EveryLevelIsTheLobeOfItsRoughnessOverTheSky) {
    const IblCube cube = cubeFromEquirect(pictureOf(128, unevenSky), 128, mJobs);
    const std::vector<IblCubeLevel> levels = prefilterSpecular(cube, 128, 256, mJobs);
    ASSERT_EQ(levels.size(), 4u);
    for (uint32_t i = 2; i < 4; ++i) { // at alpha 0.18 and 1; narrower lobes need a finer reference
        const float roughness = lib::perceptualRoughnessFromLevel(float(i), 3.0f);
        const float alpha = lib::alphaFromPerceptual(roughness);
        for (const float3 n : kNormals) {
            const Texel texel = levels[i].sample(cubeFromDirection(n));
            const float3 baked(texel[0], texel[1], texel[2]), reference = prefilterByBruteForce(n, alpha);
            EXPECT_LT(glm::distance(baked, reference), 0.01f * glm::length(reference)) << "level " << i;
        }
    }
}

TEST_F(IblBakerTest, EveryMappingPutsTheLobeOfItsRoughnessIntoEachLevel) {
    const IblCube cube = cubeFromEquirect(pictureOf(128, unevenSky), 128, mJobs);
    for (const RoughnessMapping mapping : { RoughnessMapping::Logarithmic, RoughnessMapping::Linear }) {
        const std::vector<IblCubeLevel> levels = prefilterSpecular(cube, 128, 256, mJobs, {}, mapping);
        for (uint32_t i = 2; i < 4; ++i) {
            // Of 4 levels: alpha 1/2 and 1, or perceptual roughness 2/3 and 1.
            const float alpha = i == 3 ? 1.0f : mapping == RoughnessMapping::Linear ? 4.0f / 9 : 0.5f;
            const Texel texel = levels[i].sample(cubeFromDirection(kNormals[1]));
            const float3 reference = prefilterByBruteForce(kNormals[1], alpha);
            EXPECT_LT(glm::distance(float3(texel[0], texel[1], texel[2]), reference), 0.01f * glm::length(reference))
                    << toString(mapping) << " level " << i;
        }
    }
}

// Against the coefficients, which are exact for a sky of three bands.
TEST_F(IblBakerTest, TheIrradianceCubeOfASmoothSkyAgreesWithTheCoefficients) {
    const HdrImage sky = pictureOf(64, [](float3 d) { return float3(1.0f + d.x, 1.0f + d.y * d.z, 1.5f - d.z); });
    const IblCube cube = cubeFromEquirect(sky, 64, mJobs);
    const std::array<float4, 9> sh = irradianceSh(cube[0], mJobs);
    const IblCubeLevel irradiance = irradianceCube(cube[0], kIrradianceFaceSize, mJobs);
    for (const float3 n : kNormals) {
        const Texel texel = irradiance.sample(cubeFromDirection(n));
        EXPECT_LT(glm::distance(float3(texel[0], texel[1], texel[2]), lib::irradianceSh(sh.data(), n, 3)), 0.01f);
    }
}

// A case that importance sampling gets wrong by half: lamps of a few texels in a dark room, at roughness 1 (only n.l
// weighs).
TEST_F(IblBakerTest, SmallBrightLampsLightTheRoughestLevelByTheCosine) {
    const std::array<float3, 2> lamps{ glm::normalize(float3(0.3f, 0.9f, 0.2f)),
                                       glm::normalize(float3(-0.7f, 0.1f, 0.6f)) };
    const HdrImage room = pictureOf(
            256,
            [&](float3 d) {
                const bool lit = glm::dot(d, lamps[0]) > 0.9995f || glm::dot(d, lamps[1]) > 0.9995f;
                return float3(lit ? 5000.0f : 0.01f);
            },
            2);
    const IblCube cube = cubeFromEquirect(room, 128, mJobs);
    const std::vector<IblCubeLevel> levels = prefilterSpecular(cube, 128, 512, mJobs);
    struct Lit {
        float3 direction;
        float energy;
    };
    std::vector<Lit> lit; // the texels of the lamps
    const std::vector<float> angles = texelSolidAngles(128);
    for (uint32_t i = 0; i < 6 * 128 * 128; ++i) {
        const CubePoint point{ i / (128 * 128), faceCoordinate(int(i % 128), 128),
                               faceCoordinate(int(i / 128 % 128), 128) };
        const float excess = cube[0].radiance(point.face, int(i % 128), int(i / 128 % 128)).x - 0.01f;
        if (excess > 1e-3f)
            lit.push_back({ glm::normalize(directionFromCube(point)), excess * angles[i % (128 * 128)] });
    }
    // A lamp on the horizon of a texel is half visible, which its node, judged by its centre, may miss. Allowance: the
    // mean height of half a disc of that radius, 2 r / (3 pi), relative to a lamp straight ahead.
    const double radius = std::acos(0.9995), facing = 5000 * 2 * (1 - 0.9995);
    const double atHorizon = 2 * radius / (3 * std::numbers::pi) * facing;
    const int size = static_cast<int>(levels.back().size());
    for (int i = 0; i < 6 * size * size; ++i) {
        const CubePoint point{ static_cast<uint32_t>(i / (size * size)), faceCoordinate(i % size, uint32_t(size)),
                               faceCoordinate(i / size % size, uint32_t(size)) };
        const float3 n = glm::normalize(directionFromCube(point));
        double expected = 0.01;
        for (Lit const& texel : lit)
            expected += texel.energy * std::max(0.0f, glm::dot(n, texel.direction)) / std::numbers::pi;
        EXPECT_NEAR(levels.back().radiance(point.face, i % size, i / size % size).x, expected,
                    0.01 * expected + atHorizon);
    }
}

TEST_F(IblBakerTest, TheFirstLevelIsTheSkyItself) {
    const IblCube cube = cubeFromEquirect(pictureOf(64, unevenSky), 64, mJobs);
    const std::vector<IblCubeLevel> levels = prefilterSpecular(cube, 32, 16, mJobs);
    EXPECT_EQ(levels[0].size(), 32u);
    EXPECT_EQ(std::memcmp(&levels[0].at(0, 0, 0), &cube[1].at(0, 0, 0), 32 * sizeof(Texel)), 0);
}

// A rough level must contain the sun's energy: blurring moves light, but neither creates nor loses any.
TEST_F(IblBakerTest, ABrightDiscKeepsItsEnergyThroughAllRoughnesses) {
    const float3 sun = glm::normalize(float3(0.4f, 0.5f, 0.8f));
    const float cosRadius = std::cos(0.03f);
    const HdrImage image = pictureOf(
            256, [&](float3 d) { return float3(glm::dot(d, sun) > cosRadius ? 1e4f : 0.0f); }, 2);
    const std::vector<IblCubeLevel> levels = prefilterSpecular(cubeFromEquirect(image, 128, mJobs), 128, 512, mJobs);
    std::vector<double> energies;
    for (IblCubeLevel const& level : levels) {
        const std::vector<float> angles = texelSolidAngles(level.size());
        double sum = 0;
        for (uint32_t face = 0; face < 6; ++face) {
            for (size_t i = 0; i < angles.size(); ++i) {
                sum += angles[i] * level.radiance(face, int(i % level.size()), int(i / level.size())).x;
            }
        }
        energies.push_back(sum);
    }
    for (size_t i = 1; i < energies.size(); ++i) EXPECT_NEAR(energies[i] / energies[0], 1.0, 0.02) << "level " << i;
}

TEST_F(IblBakerTest, ASunBeyondTheFormatIsClampedCountedAndNeverInfinite) {
    HdrImage image = pictureOf(64, [](float3) { return float3(0.5f); });
    image.at(64, 20) = float3(1e9f);
    const IblCube cube = cubeFromEquirect(image, 64, mJobs);
    const std::vector<IblCubeLevel> levels = prefilterSpecular(cube, 64, 64, mJobs);
    const EncodedCube half = encodeCube(levels, backend::Format::RGBA16F, mJobs);
    const EncodedCube packed = encodeCube(levels, backend::Format::R11G11B10F, mJobs);
    EXPECT_GT(half.loss.clippedTexels, 0u);
    EXPECT_GT(half.loss.lostEnergy, 0.5);
    EXPECT_LT(half.loss.lostEnergy, 1.0);
    EXPECT_GE(packed.loss.clippedTexels, half.loss.clippedTexels);
    float largest = 0;
    for (size_t i = 0; i < half.image.data.size(); i += 2) {
        uint16_t bits = 0;
        std::memcpy(&bits, half.image.data.data() + i, 2);
        largest = std::max(largest, floatFromHalf(bits));
        ASSERT_TRUE(std::isfinite(floatFromHalf(bits)));
    }
    EXPECT_EQ(largest, kMaxHalf);
    for (size_t i = 0; i < packed.image.data.size(); i += 4) {
        uint32_t bits = 0;
        std::memcpy(&bits, packed.image.data.data() + i, 4);
        const float3 value = unpackR11G11B10F(bits);
        ASSERT_TRUE(std::isfinite(value.x + value.y + value.z));
    }
}

TEST_F(IblBakerTest, WhatFitsTheFormatLosesNothing) {
    const IblCube cube = cubeFromEquirect(pictureOf(32, unevenSky), 32, mJobs);
    const EncodedCube encoded = encodeCube(std::span(cube).first(2), backend::Format::RGBA16F, mJobs);
    EXPECT_EQ(encoded.loss.clippedTexels, 0u);
    EXPECT_EQ(encoded.loss.lostEnergy, 0.0);
    EXPECT_EQ(encoded.image.data.size(), 6u * 8 * (32 * 32 + 16 * 16));
    uint16_t texel[4];
    std::memcpy(texel, encoded.image.data.data(), sizeof(texel));
    EXPECT_NEAR(floatFromHalf(texel[0]) / cube[0].radiance(0, 0, 0).x, 1.0f, 1e-3f);
    EXPECT_EQ(floatFromHalf(texel[3]), 1.0f);
}

TEST_F(IblBakerTest, ResultsAreTheSameBitsForAnyNumberOfWorkers) {
    const HdrImage image = pictureOf(64, unevenSky);
    std::vector<std::byte> expected;
    std::array<float4, 9> expectedSh{};
    for (const int workers : { 0, 1, 2, 3 }) {
        jobs::JobSystem jobs({ .workers = workers });
        const IblCube cube = cubeFromEquirect(image, 64, jobs);
        const EncodedCube encoded = encodeCube(prefilterSpecular(cube, 64, 64, jobs), backend::Format::RGBA16F, jobs);
        std::vector<std::byte> bytes = encoded.image.data;
        const Image dfg = bakeDfgTable(jobs, 16);
        bytes.insert(bytes.end(), dfg.data.begin(), dfg.data.end());
        const std::array<float4, 9> sh = irradianceSh(cube[0], jobs);
        if (workers == 0) expected = bytes, expectedSh = sh;
        EXPECT_EQ(bytes, expected) << workers << " workers";
        EXPECT_EQ(std::memcmp(&sh, &expectedSh, sizeof(sh)), 0) << workers << " workers";
    }
}

TEST_F(IblBakerTest, ProgressCountsTheLevels) {
    const IblCube cube = cubeFromEquirect(pictureOf(16, unevenSky), 32, mJobs);
    std::vector<size_t> steps;
    prefilterSpecular(cube, 32, 4, mJobs, [&](size_t done, size_t total) {
        EXPECT_EQ(total, 2u);
        steps.push_back(done);
    });
    EXPECT_EQ(steps, (std::vector<size_t>{ 1, 2 }));
}

} // namespace
} // namespace filament_core::assets
